"""The runs that faults are tried on: small, and with all that the commands can do."""
import os
import struct

HAVE_VTK = os.environ.get("GALE_ENABLE_VTK", "1") == "1"


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
REPORT = ["--report", "report.json"]

# Command lines, and which of them need VTK.
COMMANDS = [(line.split() + ONE, needs_vtk) for line, needs_vtk in [
    ("info grid:4 --report report.json", False),
    ("info volume.mha", True),
    ("info mesh.vtk", True),
    ("critical-points grid:4 --structure gale --report report.json", False),
    ("critical-points grid:4 --structure inline -o points.vtp", True),
    ("critical-points grid:4 --structure explicit", False),
    ("critical-points grid:4 --structure task-parallel", False),
    ("discrete-gradient grid:4 -o critical.vtp --arrows arrows.vtp --report report.json", True),
    ("discrete-gradient grid:4 --formulation cells", False),
    ("morse-smale grid:4 -o p --separatrices2 --persistence 2% --report report.json", True),
    ("relations grid:4 --relation VV --verify --dump rows.txt --report report.json", False),
    ("relations grid:4 --relation FF --structure gale", False),
    ("segment grid:4 --capacity 8 -o segments.vtu", True),
    ("generate grid:4 -o mesh.vtk", True),
]]


def commands():
    return [line for line, needs_vtk in COMMANDS if HAVE_VTK or not needs_vtk]
