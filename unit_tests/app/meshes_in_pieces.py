"""Meshes in pieces by hand: .vtu with arrays as text, and the .pvtu that names them."""
import itertools
import random


def xml_array(kind, name, values, components=1):
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
            f'{" ".join(map(str, values))}</DataArray>\n')


def vtu(points, cells, arrays="", cell_arrays="", coordinates="Float64", global_ids="", flat=False):
    """Tetrahedra, or the cells that the numbers of their points say, `flat` ones of dimension 2; `arrays` are text that
    xml_array made, `global_ids` the name of one of them."""
    types = {3: 5, 4: 9, 5: 7} if flat else {4: 10, 5: 14, 6: 13, 8: 12}
    ids = f' GlobalIds="{global_ids}"' if global_ids else ""
    return ('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<UnstructuredGrid>\n'
            f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">\n<PointData{ids}>\n{arrays}</PointData>\n'
            f"<CellData>\n{cell_arrays}</CellData>\n<Points>\n" +
            xml_array(coordinates, "Points", [x for point in points for x in point], 3) + "</Points>\n<Cells>\n" +
            xml_array("Int64", "connectivity", [corner for cell in cells for corner in cell]) +
            xml_array("Int64", "offsets", itertools.accumulate(map(len, cells))) +
            xml_array("UInt8", "types", [types[len(cell)] for cell in cells]) +
            "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")


def pvtu(sources, point_ids="", cell_ids=""):
    """`point_ids` and `cell_ids` are the names of the arrays that have global ids."""
    def data(kind, ids):
        return f'<P{kind}Data{f""" GlobalIds="{ids}" """ if ids else ""}/>\n'

    return ('<VTKFile type="PUnstructuredGrid" version="1.0" byte_order="LittleEndian">\n<PUnstructuredGrid GhostLevel="1">\n' +
            data("Point", point_ids) + data("Cell", cell_ids) + "".join(f'<Piece Source="{source}"/>\n' for source in sources) +
            "</PUnstructuredGrid>\n</VTKFile>\n")


class MeshWithIds:
    """A mesh whose points and cells have ids in no order of the mesh, with gaps, and a field of few values, so that most
    neighbours have equal ones."""

    def __init__(self, points, cells, flat=False):
        self.points, self.cells, self.flat = points, cells, flat
        shuffled = random.Random(5)
        self.point_ids = [3 * i + 1 for i in shuffled.sample(range(len(points)), len(points))]
        self.cell_ids = [2 * i + 9 for i in shuffled.sample(range(len(cells)), len(cells))]
        self.heights = [shuffled.randrange(3) for _ in points]
        self.order = shuffled.sample(range(len(points)), len(points))  # another one of the vertices

    def in_order_of_ids(self):
        """(points, cells, heights, ids of points), both points and cells by ascending ids."""
        order = sorted(range(len(self.points)), key=lambda v: self.point_ids[v])
        place = {v: i for i, v in enumerate(order)}
        cells = [[place[v] for v in self.cells[c]] for c in sorted(range(len(self.cells)), key=lambda c: self.cell_ids[c])]
        return ([self.points[v] for v in order], cells, [self.heights[v] for v in order], [self.point_ids[v] for v in order])

    def arrays(self, vertices, with_order=False):
        """Ids come first: they are no field nevertheless."""
        order = xml_array("Int32", "height_Order", [self.order[v] for v in vertices]) if with_order else ""
        return (xml_array("Int32", "ids", [self.point_ids[v] for v in vertices]) +
                xml_array("Float32", "height", [self.heights[v] for v in vertices]) + order)

    def pieces(self, count, seed, with_order=False):
        """Makes `count` .vtu, in which cells are by chance, beside some that are ghosts of another piece's."""
        chance = random.Random(seed)
        owners = [chance.randrange(count) for _ in self.cells]
        for piece in range(count):
            kept = [c for c, owner in enumerate(owners) if owner == piece or chance.random() < 0.1]
            chance.shuffle(kept)
            vertices = sorted({v for c in kept for v in self.cells[c]})
            chance.shuffle(vertices)
            place = {v: i for i, v in enumerate(vertices)}
            yield vtu([self.points[v] for v in vertices], [[place[v] for v in self.cells[c]] for c in kept],
                      self.arrays(vertices, with_order), xml_array("UInt8", "vtkGhostType", [int(owners[c] != piece) for c in kept]) +
                      xml_array("Int64", "cell ids", [self.cell_ids[c] for c in kept]), flat=self.flat)
