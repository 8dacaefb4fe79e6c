"""What the tests of the command share: running it, and small inputs written by hand."""
import json
import math
import os
import re
import shutil
import struct
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree
import zlib
from pathlib import Path

GALE = os.environ["GALE"]
VERSION = os.environ["GALE_VERSION"]
HAVE_VTK = os.environ["GALE_ENABLE_VTK"] == "1"
STRUCTURES = ["gale", "inline"] + ["explicit"] * (os.environ["GALE_ENABLE_KOKKOS_KERNELS"] == "1")
KINDS = ["minima", "saddles1", "saddles2", "maxima", "degenerate"]

needs_vtk = unittest.skipUnless(HAVE_VTK, "this gale was built without VTK")


def to_float(value):
    """The float nearest to a number."""
    return struct.unpack("f", struct.pack("f", value))[0]


def barycentre(points):
    """The barycentre of points with three coordinates."""
    return tuple(sum(coordinates) / len(points) for coordinates in zip(*points))


def incentre(a, b, c):
    """The centre of the circle inscribed in a triangle."""
    sides = [math.dist(b, c), math.dist(c, a), math.dist(a, b)]
    return tuple(sum(side * x for side, x in zip(sides, corners)) / sum(sides) for corners in zip(a, b, c))


class CommandTest(unittest.TestCase):
    """A test with an empty folder of its own, in which the command runs."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="gale_app_")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def gale(self, *arguments):
        return subprocess.run([GALE, *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, errors="surrogateescape", timeout=300)

    def succeed(self, *arguments):
        """Runs the command, which must succeed without complaint; returns what it printed."""
        run = self.gale(*arguments)
        self.assertEqual((run.returncode, run.stderr), (0, ""), run.args)
        self.assertNotRegex(run.stdout, "[\r\x1b]", "control characters, and this is no terminal")
        return run.stdout

    def report(self, *arguments):
        """Runs the command with --report and returns that."""
        self.succeed(*arguments, "--report", "report.json")
        return json.loads((self.folder / "report.json").read_text())

    def counts(self, *arguments):
        """Numbers of critical points, in the order of their codes."""
        result = self.report("critical-points", *arguments)["result"]
        self.assertEqual(list(result), KINDS)
        return list(result.values())

    def refuse(self, code, *arguments, naming=""):
        """Runs the command, which must exit with `code` and one line that has `naming`."""
        run = self.gale(*arguments)
        self.assertEqual(run.returncode, code, (run.args, run.stderr))
        self.assertRegex(run.stderr, r"\Agale: [^\n]+\n\Z")
        self.assertIn(str(naming), run.stderr)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return name

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def has_unnamed_files(self):
        """Whether the file system can have a file without a name, of which nothing is left however its process ends."""
        try:
            os.close(os.open(self.folder, os.O_TMPFILE | os.O_WRONLY))
        except OSError:
            return False
        return True

    def copy_of_command(self):
        """The command alone in the test's folder; skips the test where it needs libraries beside it."""
        copy = shutil.copy(GALE, self.folder)
        if subprocess.run([copy, "--version"], capture_output=True, timeout=60).returncode != 0:
            self.skipTest("the command doesn't run without what is beside it")
        return copy


class DrawingTest(CommandTest):
    """A test of pictures."""

    def draw(self, display, *arguments):
        """Runs the command with --render, with or without a display."""
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        return subprocess.run([*(["xvfb-run", "--auto-servernum"] if display else []), GALE, *arguments, "--render", "picture.png"],
                              cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300)

    def expect_drawn(self, size, *arguments):
        """Has a picture of this size drawn, on a display that no one sees; skips the test where nothing is drawn."""
        if not shutil.which("xvfb-run"):
            self.skipTest("there is no xvfb-run")
        if os.environ["GALE_DRAWS"] == "0":
            self.skipTest("this VTK does not draw")
        run = self.draw(True, *arguments)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        content = (self.folder / "picture.png").read_bytes()
        self.assertEqual((content[:8], struct.unpack(">II", content[16:24])), (b"\x89PNG\r\n\x1a\n", size))
        self.assertGreater(len(content), 20000)  # a white one takes less

    def expect_refused(self, command):
        """Has pictures refused that can't be drawn, before anything is read, and those of another extension."""
        run = self.draw(False, command, "missing.vtu")
        if "missing.vtu" not in run.stderr:  # this VTK draws without a display
            self.assertEqual(run.returncode, 1)
            self.assertRegex(run.stderr, r"\Agale: [^\n]*--render[^\n]*\n\Z")
        self.refuse(2, command, "grid:4", "--render", "picture.jpg", naming="picture.jpg")
        self.assertEqual(self.names(), [])


class Volume:
    """Values of nx * ny * nz voxels, x fastest, that can be written in every volume format; those of another kind than float as .mha."""

    def __init__(self, size, value, kind="float"):
        self.size, self.kind = size, kind
        self.values = [value(x, y, z) for z in range(size[2]) for y in range(size[1]) for x in range(size[0])]
        self.data = struct.pack(f"<{len(self.values)}{dict(float='f', double='d', uchar='B', short='h')[kind]}", *self.values)

    def nrrd(self):
        sizes = " ".join(map(str, self.size))
        return (f"NRRD0004\ntype: float\ndimension: 3\nsizes: {sizes}\nspacings: 1 1 1\nendian: little\n"
                "encoding: raw\n\n").encode() + self.data

    def mha(self, data_file="LOCAL"):
        sizes = " ".join(map(str, self.size))
        header = (f"ObjectType = Image\nNDims = 3\nDimSize = {sizes}\nElementSpacing = 1 1 1\nElementType = MET_{self.kind.upper()}\n"
                  f"ElementByteOrderMSB = False\nElementDataFile = {data_file}\n").encode()
        return header + self.data if data_file == "LOCAL" else header

    def nii(self):
        header = bytearray(352)
        struct.pack_into("<i", header, 0, 348)
        struct.pack_into("<8h", header, 40, 3, *self.size, 1, 1, 1, 1)
        struct.pack_into("<2h", header, 70, 16, 32)  # float, bits
        struct.pack_into("<8f", header, 76, 1, 1, 1, 1, 0, 0, 0, 0)
        struct.pack_into("<f", header, 108, 352)
        struct.pack_into("4s", header, 344, b"n+1\0")
        return bytes(header) + self.data

    def vti(self):
        extent = " ".join(f"0 {n - 1}" for n in self.size)
        values = " ".join(map(str, self.values))
        return (f'<VTKFile type="ImageData" version="0.1" byte_order="LittleEndian"><ImageData WholeExtent="{extent}" '
                f'Origin="0 0 0" Spacing="1 1 1"><Piece Extent="{extent}"><PointData Scalars="values"><DataArray type="Float32" '
                f'Name="values" format="ascii">{values}</DataArray></PointData></Piece></ImageData></VTKFile>').encode()


def vtk_mesh(points, cells, arrays):
    """A legacy VTK file. `cells`: lists of vertices, of the type that their length says; `arrays`: name -> (type, values)."""
    types = {1: 1, 2: 3, 3: 5, 4: 10, 8: 12}
    lines = []

    def put(header, kind, values):
        values = [float(value) if kind != "int" else value for value in values]
        lines.append(f"{header}\n".encode() + struct.pack(f">{len(values)}{kind[0]}", *values))

    put(f"POINTS {len(points)} double", "double", [x for point in points for x in point])
    put(f"CELLS {len(cells)} {sum(len(cell) + 1 for cell in cells)}", "int",
        [number for cell in cells for number in (len(cell), *cell)])
    put(f"CELL_TYPES {len(cells)}", "int", [types[len(cell)] for cell in cells])
    lines.append(f"POINT_DATA {len(points)}".encode())
    for name, (kind, values) in arrays.items():
        put(f"SCALARS {name} {kind} 1\nLOOKUP_TABLE default", kind, values)
    header = b"# vtk DataFile Version 3.0\nby hand\nBINARY\nDATASET UNSTRUCTURED_GRID\n"
    return header + b"\n".join(lines) + b"\n"


def vtk_xml_header(path):
    """(number of points, names of the point arrays) of a .vtp or .vtu."""
    text = path.read_bytes().decode("latin-1")
    arrays = text[text.index("<PointData"):text.index("</PointData>")]
    return int(re.search(r'NumberOfPoints="(\d+)"', text).group(1)), re.findall(r'<DataArray[^>]* Name="([^"]+)"', arrays)


class XmlFile:
    """What is in a .vtp or .vtu as the command writes it. Arrays of several components are lists of tuples."""

    CODES = {"Int8": "b", "UInt8": "B", "Int32": "i", "Int64": "q", "Float32": "f", "Float64": "d"}

    def __init__(self, path):
        header, data = path.read_bytes().split(b'<AppendedData encoding="raw">', 1)
        self.data = data[data.index(b"_") + 1:]
        file = xml.etree.ElementTree.fromstring(header + b"</VTKFile>")
        assert (file.get("header_type"), file.get("compressor")) == ("UInt64", "vtkZLibDataCompressor")
        self.piece = file.find("*/Piece")
        self.points = self.values(self.piece.find("Points/DataArray"))
        self.point_arrays = self.arrays("PointData")
        self.cell_arrays = self.arrays("CellData")

    def arrays(self, kind):
        return {array.get("Name"): self.values(array) for array in self.piece.find(kind)}

    def types(self, kind):
        """The types of its arrays, as VTK names them."""
        return {array.get("Name"): array.get("type") for array in self.piece.find(kind)}

    def cells(self, kind):
        """Each a list of points. `kind`: Verts, Lines, Polys or Cells."""
        arrays = self.arrays(kind)
        begins = [0, *arrays["offsets"]]
        return [arrays["connectivity"][begin:end] for begin, end in zip(begins, begins[1:])]

    def values(self, array):
        at = int(array.get("offset"))
        blocks, = struct.unpack_from("<Q", self.data, at)
        sizes = struct.unpack_from(f"<{blocks}Q", self.data, at + 24)
        at += 8 * (3 + blocks)
        content = b""
        for size in sizes:
            content += zlib.decompress(self.data[at:at + size])
            at += size
        code = self.CODES[array.get("type")]
        flat = list(struct.unpack(f"<{len(content) // struct.calcsize(code)}{code}", content))
        width = int(array.get("NumberOfComponents") or 1)
        return flat if width == 1 else [tuple(flat[i:i + width]) for i in range(0, len(flat), width)]


def read_vtp(path):
    """(points, {name: values}) of a .vtp."""
    file = XmlFile(path)
    return file.points, file.point_arrays
