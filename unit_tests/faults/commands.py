"""The runs that faults are tried on: small, and with all that the commands can do."""
import os
import struct

HAVE = {what: os.environ.get(f"GALE_ENABLE_{what}", "1") == "1" for what in ("VTK", "KOKKOS_KERNELS")}


def volume():
    """A .mha of 5^3 voxels."""
    values = struct.pack("<125f", *((7 * i) % 125 for i in range(125)))
    return (b"ObjectType = Image\nNDims = 3\nDimSize = 5 5 5\nElementSpacing = 1 1 1\nElementType = MET_FLOAT\n"
            b"ElementByteOrderMSB = False\nElementDataFile = LOCAL\n" + values)


def mesh():
    """A .vtk of two tetrahedra."""
    points = struct.pack(">15f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1)
    cells = struct.pack(">10i", 4, 0, 1, 2, 3, 4, 1, 2, 3, 4)
    types = struct.pack(">2i", 10, 10)
    field = struct.pack(">5f", 0, 1, 2, 3, 4)
    return (b"# vtk DataFile Version 3.0\nby hand\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n" + points +
            b"\nCELLS 2 10\n" + cells + b"\nCELL_TYPES 2\n" + types +
            b"\nPOINT_DATA 5\nSCALARS field float 1\nLOOKUP_TABLE default\n" + field + b"\n")


INPUTS = {"volume.mha": volume(), "mesh.vtk": mesh()}
ONE = ["--quiet", "--threads", "1"]

# Command lines, and what they need.
COMMANDS = [(line.split() + ONE, needs) for line, needs in [
    ("info grid:4 --report report.json", None),
    ("info volume.mha", "VTK"),
    ("info mesh.vtk", "VTK"),
    ("critical-points grid:4 --structure gale --report report.json", None),
    ("critical-points grid:4 --structure inline -o points.vtp", None),
    ("critical-points grid:4 --structure explicit", "KOKKOS_KERNELS"),
    ("critical-points grid:4 --structure task-parallel", None),
    ("discrete-gradient grid:4 -o critical.vtp --arrows arrows.vtp --report report.json", None),
    ("discrete-gradient grid:4 --formulation cells", None),
    ("morse-smale grid:4 -o p --separatrices2 --persistence 2% --report report.json", None),
    ("persistence-diagram grid:4 -o diagram.vtu --curve curve.csv --report report.json", None),
    ("merge-tree grid:4 -o p --arc-samples 2 --report report.json", None),
    ("merge-tree plane:5 --type split --persistence 2% --report report.json", None),
    ("simplify-field grid:4 --persistence 9% -o field.vtu --report report.json", None),
    ("track grid:4 grid:4 -o tracks.vtp --table tracks.csv --persistence 2% --report report.json", None),
    ("relations grid:4 --relation VV --verify --dump rows.txt --report report.json", None),
    ("relations grid:4 --relation FF --structure gale", None),
    ("segment grid:4 --capacity 8 -o segments.vtu", None),
    ("generate grid:4 -o mesh.vtk", None),
]]


def commands():
    return [line for line, needs in COMMANDS if needs is None or HAVE[needs]]
