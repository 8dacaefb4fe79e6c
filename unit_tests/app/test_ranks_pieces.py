"""gale under mpirun of a .pvtu: its pieces are read by the ranks."""
import json
import unittest

import gale
import ranks

POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1), (2, 2, 2)]
CELLS = [[0, 1, 2, 3], [1, 2, 3, 4], [2, 3, 4, 5]]
HEIGHTS = [3, 5, 0, 4, 2, 1]


def array(kind, name, values):
    return f'<DataArray type="{kind}" Name="{name}" format="ascii">{" ".join(map(str, values))}</DataArray>'


def piece(vertices, cells, ghosts, names=None):
    """A .vtu by hand of some vertices, and of cells by their places in CELLS; `ghosts` are 1 for those of other pieces."""
    ids = array("Int64", "GlobalPointIds", [names[v] for v in vertices]) if names else ""
    coordinates = " ".join(str(x) for v in vertices for x in POINTS[v])
    corners = [vertices.index(v) for cell in cells for v in CELLS[cell]]
    return (f'<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid>'
            f'<Piece NumberOfPoints="{len(vertices)}" NumberOfCells="{len(cells)}">'
            f'<PointData>{array("Float32", "height", [HEIGHTS[v] for v in vertices])}{ids}</PointData>'
            f'<CellData>{array("UInt8", "vtkGhostType", ghosts)}</CellData>'
            f'<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{coordinates}</DataArray></Points>'
            f'<Cells>{array("Int32", "connectivity", corners)}'
            f'{array("Int32", "offsets", [4 * (i + 1) for i in range(len(cells))])}'
            f'{array("UInt8", "types", [10] * len(cells))}</Cells></Piece></UnstructuredGrid></VTKFile>')


@ranks.needs_mpi
@gale.needs_vtk
class PiecesOnRanks(ranks.RanksTest):
    def points(self, files):
        """{(vertex, type): (point, height, on the surface)} of critical points."""
        found = {}
        for file in files:
            arrays = file.point_arrays
            for i, vertex in enumerate(arrays["ttkVertexScalarField"]):
                self.assertNotIn(vertex, found)
                found[vertex] = (file.points[i], {name: arrays[name][i] for name in ("CriticalType", "IsOnBoundary")})
        return found

    def write_pieces(self, names=None):
        """Three pieces of the mesh: with ghosts before and behind, and an empty one."""
        self.write("small_0.vtu", piece([3, 1, 0, 2, 4], [0, 1], [0, 1], names))
        self.write("small_1.vtu", piece([], [], [], names))
        self.write("small_2.vtu", piece([0, 2, 1, 5, 3, 4], [0, 2, 1], [1, 0, 0], names))
        ids = ' GlobalIds="GlobalPointIds"' if names else ""
        sources = "".join(f'<Piece Source="small_{k}.vtu"/>' for k in range(3))
        self.write("small.pvtu", f'<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid GhostLevel="1"><PPointData{ids}/>'
                                 f'{sources}</PUnstructuredGrid></VTKFile>')

    def test_vertices_have_the_global_ids_of_the_file(self):
        names = [7 + (v << 33) for v in range(6)]
        self.write_pieces(names)
        self.write("small.vtk", gale.vtk_mesh(POINTS, CELLS, {"height": ("float", HEIGHTS)}))
        self.succeed("critical-points", "small.vtk", "-o", "one.vtp")
        expected = self.points([gale.XmlFile(self.folder / "one.vtp")])
        for count in ranks.RANKS:
            with self.subTest(ranks=count):
                report = self.report_of(count, "critical-points", "small.pvtu", "-o", "all.pvtp")
                self.assertEqual((report["mesh"]["vertices"], report["mesh"]["tetrahedra"]), (6, 3))
                self.assertFalse([notice for notice in report["notices"] if "coordinates" in notice])
                found = self.points(self.pieces("all.pvtp"))
                self.assertEqual(found, {names[v]: what for v, what in expected.items()})

    def test_points_of_equal_coordinates_are_one_without_global_ids(self):
        self.write_pieces()
        self.succeed("critical-points", "small.pvtu", "-o", "one.vtp")
        expected = self.points([gale.XmlFile(self.folder / "one.vtp")])
        for count in ranks.RANKS:
            with self.subTest(ranks=count):
                report = self.report_of(count, "critical-points", "small.pvtu", "-o", "all.pvtp")
                self.assertEqual((report["mesh"]["vertices"], report["mesh"]["tetrahedra"]), (6, 3))
                self.assertTrue([notice for notice in report["notices"] if "coordinates" in notice])
                self.assertEqual(self.points(self.pieces("all.pvtp")), expected)

    def test_what_ranks_wrote_they_read(self):
        expected = self.report("critical-points", "grid:12", "-o", "one.vtp")
        expected_points = self.points([gale.XmlFile(self.folder / "one.vtp")])
        self.report_of(3, "morse-smale", "grid:12", "--no-saddle-connectors", "-o", "wrote")
        for count in ranks.RANKS:
            with self.subTest(ranks=count):
                report = self.report_of(count, "critical-points", "wrote_segmentation.pvtu", "-o", "all.pvtp")
                self.assertEqual(report["result"], expected["result"])
                self.assertEqual(self.points(self.pieces("all.pvtp")), expected_points)

    def test_what_is_wrong_is_said_in_one_line(self):
        self.write_pieces()
        self.expect_one_line(self.launch(2, "critical-points", "small.pvtu", "--tetrahedralize"), 2, "--tetrahedralize")
        self.expect_one_line(self.launch(2, "critical-points", "small.pvtu", "--above", "1"), 1, "not an image")
        (self.folder / "small_2.vtu").unlink()
        self.expect_one_line(self.launch(3, "critical-points", "small.pvtu"), 1, "small_2.vtu")


if __name__ == "__main__":
    unittest.main()
