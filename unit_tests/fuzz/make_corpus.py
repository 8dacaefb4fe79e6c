"""Writes small files of all formats and encodings that gale reads: what the fuzzer mutates.

usage: make_corpus.py FOLDER

Detached data is FILE.raw, which the header calls input.raw: under that name the fuzzer puts it beside the file.
"""
import base64
import gzip
import lzma
import struct
import sys
import zlib
from pathlib import Path

from exodus_files import exodus, exodus_shells

POINTS = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 2, 0, 1]
TETRAHEDRA = [0, 1, 2, 3, 1, 2, 3, 4, 1, 4, 3, 5]
FIELD = [0.5, 3, 1, 4, -1, 5]
CODES = {"Int8": "b", "UInt8": "B", "Int16": "h", "UInt16": "H", "Int32": "i", "UInt32": "I", "Int64": "q", "UInt64": "Q",
         "Float32": "f", "Float64": "d"}
VOXELS = [(7 * i) % 61 for i in range(4 * 5 * 3)]
SIZE = (4, 5, 3)


def pack(kind, values, order="<"):
    return struct.pack(f"{order}{len(values)}{CODES[kind]}", *values)


def lz4_literals(data):
    """An LZ4 block that only has literals."""
    rest = len(data) - 15
    if rest < 0:
        return bytes([len(data) << 4]) + data
    return b"\xf0" + b"\xff" * (rest // 255) + bytes([rest % 255]) + data


COMPRESS = {"vtkZLibDataCompressor": zlib.compress, "vtkLZ4DataCompressor": lz4_literals,
            "vtkLZMADataCompressor": lambda data: lzma.compress(data, format=lzma.FORMAT_XZ)}


class Xml:
    """A VTK XML file in one of its encodings."""

    def __init__(self, kind, mode, compressor="", header="UInt32", order="<", block=64):
        self.kind, self.mode, self.compressor, self.header, self.order, self.block = kind, mode, compressor, header, order, block
        self.appended = b""

    def words(self, *values):
        return pack(self.header, values, self.order)

    def encoded(self, data):
        """(what can be base64 on its own, the rest)"""
        if not self.compressor:
            return b"", self.words(len(data)) + data
        blocks = [data[i:i + self.block] for i in range(0, len(data), self.block)]
        packed = [COMPRESS[self.compressor](block) for block in blocks]
        last = len(data) % self.block
        return self.words(len(blocks), self.block, last, *map(len, packed)), b"".join(packed)

    def array(self, name, kind, values, components=1):
        attributes = f'type="{kind}" Name="{name}"' + (f' NumberOfComponents="{components}"' if components > 1 else "")
        if self.mode == "ascii":
            return f'<DataArray {attributes} format="ascii">{" ".join(map(str, values))}</DataArray>\n'
        parts = self.encoded(pack(kind, values, self.order))
        if self.mode == "binary" or self.mode == "appended base64":
            text = b"".join(base64.b64encode(part) for part in parts if part)
        else:
            text = b"".join(parts)
        if self.mode == "binary":
            return f'<DataArray {attributes} format="binary">\n{text.decode()}\n</DataArray>\n'
        offset = len(self.appended)
        self.appended += text
        return f'<DataArray {attributes} format="appended" offset="{offset}"/>\n'

    def file(self, body):
        compressor = f' compressor="{self.compressor}"' if self.compressor else ""
        order = "LittleEndian" if self.order == "<" else "BigEndian"
        start = (f'<?xml version="1.0"?>\n<VTKFile type="{self.kind}" version="1.0" byte_order="{order}" '
                 f'header_type="{self.header}"{compressor}>\n{body}')
        if self.appended:
            encoding = "base64" if "base64" in self.mode else "raw"
            return f'{start}<AppendedData encoding="{encoding}">\n_'.encode() + self.appended + b"\n</AppendedData>\n</VTKFile>\n"
        return (start + "</VTKFile>\n").encode()


def vtu(*encoding, kind="Float32", pieces=1, more_cells=False, polyhedra=False, **options):
    xml = Xml("UnstructuredGrid", *encoding, **options)
    body = "<UnstructuredGrid>\n"
    for _ in range(pieces):
        cells, types = [TETRAHEDRA[i:i + 4] for i in range(0, 12, 4)], [10] * 3
        if more_cells:
            cells, types = cells + [[0, 1, 2], [0, 1, 2, 3, 4], [2]], types + [5, 14, 1]
        faces = ""
        if polyhedra:
            cells, types = cells + [[0, 1, 2, 3, 4, 5], [2, 3, 4, 5]], types + [13, 42]
            stream = [4, 3, 2, 3, 4, 3, 2, 3, 5, 3, 2, 4, 5, 3, 3, 4, 5]
            faces = xml.array("faces", "Int64", stream) + xml.array("faceoffsets", "Int64", [-1] * 4 + [len(stream)])
            if pieces == 2:  # as VTK 9.4 and later write them
                corners = [2, 3, 4, 2, 3, 5, 2, 4, 5, 3, 4, 5]
                faces = (xml.array("face_connectivity", "Int64", corners) + xml.array("face_offsets", "Int64", [3, 6, 9, 12]) +
                         xml.array("polyhedron_to_faces", "Int64", [0, 1, 2, 3]) +
                         xml.array("polyhedron_offsets", "Int64", [0] * 4 + [4]))
        offsets = [sum(map(len, cells[:i + 1])) for i in range(len(cells))]
        body += (f'<Piece NumberOfPoints="6" NumberOfCells="{len(cells)}">\n<PointData Scalars="field">\n' +
                 xml.array("field", kind, list(map(int, FIELD)) if "Int" in kind else FIELD) + xml.array("pairs", "Int16", list(range(12)), 2) + "</PointData>\n<CellData>\n" +
                 xml.array("part", "UInt8", [1] * len(cells)) + "</CellData>\n<Points>\n" + xml.array("Points", kind, POINTS, 3) +
                 "</Points>\n<Cells>\n" + xml.array("connectivity", "Int64", sum(cells, [])) + xml.array("offsets", "Int64", offsets) +
                 xml.array("types", "UInt8", types) + faces + "</Cells>\n</Piece>\n")
    return xml.file(body + "</UnstructuredGrid>\n")


def vti(*encoding, kind="Float32", pieces=1, **options):
    xml = Xml("ImageData", *encoding, **options)
    x, y, z = SIZE
    body = f'<ImageData WholeExtent="0 {x - 1} 0 {y - 1} 0 {z - 1}" Origin="0 0 0" Spacing="1 1.5 2">\n'
    for piece in range(pieces):
        low, high = (0, z - 1) if pieces == 1 else ((0, 1), (1, 2))[piece]
        values = VOXELS[low * x * y:(high + 1) * x * y]
        body += (f'<Piece Extent="0 {x - 1} 0 {y - 1} {low} {high}">\n<PointData Scalars="values">\n' +
                 xml.array("values", kind, values) + "</PointData>\n</Piece>\n")
    return xml.file(body + "</ImageData>\n")


def xml_grid(kind, *encoding, pieces=1):
    """A structured or rectilinear grid."""
    xml = Xml(kind, *encoding)
    x, y, z = SIZE
    body = f'<{kind} WholeExtent="0 {x - 1} 0 {y - 1} 0 {z - 1}">\n'
    for piece in range(pieces):
        low, high = (0, z - 1) if pieces == 1 else ((0, 1), (1, 2))[piece]
        axes = range(x), range(y), range(low, high + 1)
        if kind == "RectilinearGrid":
            places = "<Coordinates>" + "".join(xml.array("xyz"[d], "Float32", axes[d]) for d in range(3)) + "</Coordinates>\n"
        else:
            points = [c for k in axes[2] for j in axes[1] for i in axes[0] for c in (i, j, k)]
            places = "<Points>" + xml.array("Points", "Float64", points, 3) + "</Points>\n"
        body += (f'<Piece Extent="0 {x - 1} 0 {y - 1} {low} {high}">\n<PointData Scalars="values">\n' +
                 xml.array("values", "UInt8", VOXELS[low * x * y:(high + 1) * x * y]) + f"</PointData>\n{places}</Piece>\n")
    return xml.file(body + f"</{kind}>\n")


def pvtu(**global_ids):
    """Names twice the same piece, which lies beside it."""
    attributes = "".join(f' {key}="{value}"' for key, value in global_ids.items())
    return ('<VTKFile type="PUnstructuredGrid" version="1.0" byte_order="LittleEndian">\n<PUnstructuredGrid GhostLevel="0">\n'
            f'<PPointData{attributes}></PPointData>\n<Piece Source="input.raw"/>\n<Piece Source="input.raw"/>\n'
            "</PUnstructuredGrid>\n</VTKFile>\n").encode()


def vtp(*encoding, pieces=1, **options):
    """A surface of a triangle, a quad, a pentagon and a strip, with a vertex and a line."""
    xml = Xml("PolyData", *encoding, **options)
    body = "<PolyData>\n"
    for _ in range(pieces):
        body += ('<Piece NumberOfPoints="6" NumberOfVerts="1" NumberOfLines="1" NumberOfStrips="1" NumberOfPolys="3">\n'
                 '<PointData Scalars="field">\n' + xml.array("field", "Float32", FIELD) + "</PointData>\n<CellData>\n" +
                 xml.array("part", "UInt8", [1] * 6) + "</CellData>\n<Points>\n" + xml.array("Points", "Float32", POINTS, 3) + "</Points>\n")
        for section, cells in (("Verts", [[4]]), ("Lines", [[0, 5]]), ("Strips", [[0, 1, 2, 3, 5]]), ("Polys", [[0, 1, 2], [1, 2, 4, 5], [5, 4, 3, 2, 1]])):
            ends = [sum(map(len, cells[:i + 1])) for i in range(len(cells))]
            body += f"<{section}>\n" + xml.array("connectivity", "Int64", sum(cells, [])) + xml.array("offsets", "Int64", ends) + f"</{section}>\n"
        body += "</Piece>\n"
    return xml.file(body + "</PolyData>\n")


def vtk_surface(version, binary):
    file = Legacy(version, binary, "POLYDATA").put("POINTS 6 float", "Float32", POINTS)
    kinds = {"VERTICES": [[4]], "LINES": [[0, 5]], "POLYGONS": [[0, 1, 2], [1, 2, 4, 5], [5, 4, 3, 2, 1]], "TRIANGLE_STRIPS": [[0, 1, 2, 3, 5]]}
    for name, cells in kinds.items():
        corners = sum(cells, [])
        if version == "5.1":
            ends = [sum(map(len, cells[:i])) for i in range(len(cells) + 1)]
            file.line(f"{name} {len(ends)} {len(corners)}").put("OFFSETS vtktypeint64", "Int64", ends)
            file.put("CONNECTIVITY vtktypeint64", "Int64", corners)
        else:
            file.put(f"{name} {len(cells)} {len(corners) + len(cells)}", "Int32", [number for cell in cells for number in (len(cell), *cell)])
    return file.point_data(6).data


FACETS = [[0, 1, 2], [1, 2, 4], [1, 4, 5]]


def stl(binary):
    corners = [[POINTS[3 * p:3 * p + 3] for p in facet] for facet in FACETS]
    if binary:
        return b"solid of bytes".ljust(80) + struct.pack("<I", 3) + b"".join(struct.pack("<12fH", 0, 0, 1, *sum(facet, []), 0) for facet in corners)
    text = "solid seed\n"
    for facet in corners:
        text += "facet normal 0 0 1\n outer loop\n" + "".join(f"  vertex {x} {y} {z}\n" for x, y, z in facet) + " endloop\nendfacet\n"
    return (text + "endsolid seed\n").encode()


def ply(form, coordinate="float"):
    header = (f"ply\nformat {form} 1.0\ncomment seed\nelement vertex 6\n" + "".join(f"property {coordinate} {axis}\n" for axis in "xyz") +
              "property uchar red\nproperty short level\nelement face 2\nproperty list uchar int vertex_indices\nproperty uchar flag\n"
              "element edge 1\nproperty int vertex1\nproperty list ushort double weights\nelement tristrips 1\n"
              "property list int int vertex_indices\nend_header\n")
    order = "<" if "little" in form else ">"
    points = [(*POINTS[3 * p:3 * p + 3], 10 * p, -p) for p in range(6)]
    faces, strip = [[0, 1, 2], [5, 4, 2, 1]], [0, 1, 2, -1, 2, 3, 4, 5]
    if form == "ascii":
        rows = [*points, *((len(face), *face, 1) for face in faces), (7, 2, 0.5, 1.5), (len(strip), *strip)]
        return (header + "".join(" ".join(map(str, row)) + "\n" for row in rows)).encode()
    code = "fff" if coordinate == "float" else "ddd"
    data = b"".join(struct.pack(f"{order}{code}Bh", *point) for point in points)
    data += b"".join(struct.pack(f"{order}B{len(face)}iB", len(face), *face, 1) for face in faces)
    data += struct.pack(f"{order}iH2d", 7, 2, 0.5, 1.5) + struct.pack(f"{order}i{len(strip)}i", len(strip), *strip)
    return header.encode() + data


def lines_of(points, start=""):
    return "".join(f"{start}{points[3 * p]} {points[3 * p + 1]} {points[3 * p + 2]}\n" for p in range(len(points) // 3))


def obj():
    return ("# seed\nmtllib none.mtl\no name\n" + lines_of(POINTS, "v ") + "vn 0 0 1\nvt 0 0\nusemtl none\ns off\n"
            "f 1 2 3\nf 2/1 3/1 5/1 6/1\nf -6//1 -5//1 -3//1\nf 1/1/1 \\\n 2/1/1 4/1/1\nl 1 2\n").encode()


def off(keyword="OFF"):
    more = " 1 0 0 1\n" if keyword == "COFF" else "\n"
    return (f"{keyword}\n# seed\n6 3 0\n" + lines_of(POINTS).replace("\n", more) + "3 0 1 2\n4 1 2 4 5 0.5 0.5 0.5\n5 5 4 3 2 1\n").encode()


class Legacy:
    """A legacy VTK file, ASCII or BINARY."""

    def __init__(self, version, binary, dataset):
        self.binary = binary
        self.data = f"# vtk DataFile Version {version}\nseed\n{'BINARY' if binary else 'ASCII'}\nDATASET {dataset}\n".encode()

    def line(self, text):
        self.data += text.encode() + b"\n"
        return self

    def put(self, header, kind, values):
        self.line(header)
        self.data += pack(kind, values, ">") if self.binary else " ".join(map(str, values)).encode()
        self.data += b"\n"
        return self

    def point_data(self, count):
        return (self.line(f"POINT_DATA {count}").put("SCALARS field float 1\nLOOKUP_TABLE default", "Float32", VOXELS[:count])
                .line("FIELD FieldData 1").put(f"ids 1 {count} int", "Int32", list(range(count))))


def vtk_mesh(version, binary):
    file = Legacy(version, binary, "UNSTRUCTURED_GRID").put("POINTS 6 float", "Float32", POINTS)
    if version == "5.1":
        file.line("CELLS 4 12").put("OFFSETS vtktypeint64", "Int64", [0, 4, 8, 12])
        file.put("CONNECTIVITY vtktypeint64", "Int64", TETRAHEDRA)
    else:
        file.put("CELLS 3 15", "Int32", [number for i in range(0, 12, 4) for number in (4, *TETRAHEDRA[i:i + 4])])
    return file.put("CELL_TYPES 3", "Int32", [10] * 3).point_data(6).data


def vtk_points(version, binary):
    x, y, z = SIZE
    return (Legacy(version, binary, "STRUCTURED_POINTS").line(f"DIMENSIONS {x} {y} {z}").line("ORIGIN 0 0 0").line("SPACING 1 1 2")
            .point_data(x * y * z).data)


def vtk_others(binary):
    grid = Legacy("3.0", binary, "STRUCTURED_GRID").line("DIMENSIONS 2 3 1").put("POINTS 6 float", "Float32", POINTS).point_data(6)
    rectilinear = Legacy("3.0", binary, "RECTILINEAR_GRID").line("DIMENSIONS 2 3 1")
    for name, count in (("X", 2), ("Y", 3), ("Z", 1)):
        rectilinear.put(f"{name}_COORDINATES {count} float", "Float32", POINTS[:count])
    return grid.data, rectilinear.point_data(6).data


def nii(kind, code, order="<", slope=0.0):
    header = bytearray(352)
    struct.pack_into(order + "i", header, 0, 348)
    struct.pack_into(order + "8h", header, 40, 3, *SIZE, 1, 1, 1, 1)
    struct.pack_into(order + "2h", header, 70, code, 8 * struct.calcsize(CODES[kind]))
    struct.pack_into(order + "8f", header, 76, 1, 1, 1, 2, 0, 0, 0, 0)
    struct.pack_into(order + "3f", header, 108, 352, slope, 1)
    struct.pack_into(order + "2h", header, 252, 1, 1)
    struct.pack_into(order + "12f", header, 280, -1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 2, 0)
    struct.pack_into("4s", header, 344, b"n+1\0")
    return bytes(header) + pack(kind, VOXELS, order)


def meta(kind, element, data_file="LOCAL", mode="raw", order="<"):
    data = pack(kind, VOXELS, order)
    more = ""
    if mode == "compressed":
        data = zlib.compress(data)
        more = f"CompressedData = True\nCompressedDataSize = {len(data)}\n"
    elif mode == "ascii":
        data = " ".join(map(str, VOXELS)).encode() + b"\n"
    header = (f"ObjectType = Image\nNDims = 3\nBinaryData = {mode != 'ascii'}\nBinaryDataByteOrderMSB = {order == '>'}\n{more}"
              "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nElementSpacing = 1 1 2\n"
              f"DimSize = {' '.join(map(str, SIZE))}\nElementType = {element}\nElementDataFile = {data_file}\n").encode()
    return header, data


def nrrd(kind, name, encoding, detached=False, order="little"):
    data = pack(kind, VOXELS, "<" if order == "little" else ">")
    if encoding == "gzip":
        data = gzip.compress(data, mtime=0)
    elif encoding == "ascii":
        data = " ".join(map(str, VOXELS)).encode() + b"\n"
    header = (f"NRRD0004\n# seed\ntype: {name}\ndimension: 3\nspace: left-posterior-superior\nsizes: {' '.join(map(str, SIZE))}\n"
              "space directions: (1,0,0) (0,1,0) (0,0,2)\nkinds: domain domain domain\n"
              f"endian: {order}\nencoding: {encoding}\nspace origin: (0,0,0)\n" +
              ("data file: input.raw\n" if detached else "") + "\n").encode()
    return header, data


def seeds():
    """(name, content, content of the detached data)"""
    zlib_, lz4, xz = COMPRESS
    for name, content in {
            "ascii": vtu("ascii"), "doubles": vtu("ascii", kind="Float64", more_cells=True), "binary": vtu("binary"),
            "binary_zlib": vtu("binary", zlib_), "binary_64": vtu("binary", zlib_, "UInt64"), "raw": vtu("appended raw"),
            "raw_zlib": vtu("appended raw", zlib_), "raw_zlib_64": vtu("appended raw", zlib_, "UInt64", kind="Float64"),
            "raw_lz4": vtu("appended raw", lz4), "raw_lzma": vtu("appended raw", xz), "big_endian": vtu("appended raw", order=">"),
            "base64": vtu("appended base64"), "base64_zlib": vtu("appended base64", zlib_), "pieces": vtu("ascii", pieces=2),
            "more_cells": vtu("appended raw", zlib_, more_cells=True), "polyhedra": vtu("ascii", polyhedra=True),
            "polyhedra_pieces": vtu("appended raw", polyhedra=True, pieces=2)}.items():
        yield f"{name}.vtu", content, None
    for name, encoding, pieces in (("ascii", ["ascii"], 2), ("raw", ["appended raw", zlib_], 1)):
        yield f"{name}.vts", xml_grid("StructuredGrid", *encoding, pieces=pieces), None
        yield f"{name}.vtr", xml_grid("RectilinearGrid", *encoding, pieces=pieces), None
    for name, content in {"ascii": vtp("ascii"), "pieces": vtp("ascii", pieces=2), "raw_zlib": vtp("appended raw", zlib_),
                          "base64": vtp("binary", "", "UInt64"), "big_endian": vtp("appended raw", order=">")}.items():
        yield f"{name}.vtp", content, None
    for binary in (False, True):
        yield f"{'binary' if binary else 'ascii'}.stl", stl(binary), None
        for version in ("3.0", "5.1"):
            yield f"surface_{version}_{'b' if binary else 'a'}.vtk", vtk_surface(version, binary), None
    for name, content in {"ascii": ply("ascii"), "little": ply("binary_little_endian"), "big": ply("binary_big_endian", "double")}.items():
        yield f"{name}.ply", content, None
    yield "seed.obj", obj(), None
    yield "plain.off", off(), None
    yield "colours.off", off("COFF"), None
    yield "coordinates.pvtu", pvtu(), vtu("ascii", more_cells=True)
    yield "ids.pvtu", pvtu(GlobalIds="field"), vtu("appended raw", "", "UInt64", kind="Int32")
    for name, content in {
            "ascii": vti("ascii"), "binary": vti("binary"), "raw": vti("appended raw", "", "UInt64"), "raw_zlib": vti("appended raw", zlib_),
            "bytes": vti("appended raw", kind="UInt8"), "base64_lz4": vti("appended base64", lz4), "raw_lzma": vti("appended raw", xz),
            "pieces": vti("ascii", pieces=2), "doubles": vti("appended raw", "", "UInt32", ">", kind="Float64")}.items():
        yield f"{name}.vti", content, None
    for binary in (False, True):
        letter = "b" if binary else "a"
        for version in ("2.0", "3.0", "4.2", "5.1"):
            yield f"mesh_{version}_{letter}.vtk", vtk_mesh(version, binary), None
        for version in ("2.0", "3.0", "5.1"):
            yield f"points_{version}_{letter}.vtk", vtk_points(version, binary), None
        grid, rectilinear = vtk_others(binary)
        yield f"grid_{letter}.vtk", grid, None
        yield f"rectilinear_{letter}.vtk", rectilinear, None
    for name, content in {"bytes": nii("UInt8", 2), "shorts": nii("Int16", 4, slope=2.0), "floats": nii("Float32", 16),
                          "doubles": nii("Float64", 64, ">"), "words": nii("UInt16", 512, ">")}.items():
        yield f"{name}.nii", content, None
        yield f"{name}.nii.gz", gzip.compress(content, mtime=0), None
    for name, file in {"classic": exodus(1, "f"), "large": exodus(2, names=("v_x", "v_y", "v_z", "p")), "cdf5": exodus(5), "old": exodus(1, large=False), "shells": exodus_shells(),
                       "once": exodus(2, times=1, names=("field",))}.items():
        yield f"{name}.e", file.content(), None
    for mode in ("raw", "compressed", "ascii"):
        yield f"{mode}.mha", b"".join(meta("Float32", "MET_FLOAT", mode=mode)), None
    yield "shorts.mha", b"".join(meta("Int16", "MET_SHORT", order=">")), None
    yield "detached.mhd", *meta("UInt8", "MET_UCHAR", "input.raw")
    yield "compressed.mhd", *meta("Float64", "MET_DOUBLE", "input.raw", "compressed")
    for encoding in ("raw", "gzip", "ascii"):
        yield f"{encoding}.nrrd", b"".join(nrrd("Float32", "float", encoding)), None
    yield "shorts.nrrd", b"".join(nrrd("Int16", "short", "raw", order="big")), None
    yield "detached.nrrd", *nrrd("UInt8", "unsigned char", "raw", detached=True)
    yield "detached_gzip.nrrd", *nrrd("Float64", "double", "gzip", detached=True)


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, content, data in seeds():
        (folder / name).write_bytes(content)
        if data is not None:
            (folder / f"{name}.raw").write_bytes(data)


if __name__ == "__main__":
    main()
