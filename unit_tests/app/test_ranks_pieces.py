"""gale under mpirun of a .pvtu: its pieces are read by the ranks."""
import unittest

import gale
import ranks
from meshes_in_pieces import MeshWithIds, pvtu, vtu, xml_array

POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1), (2, 2, 2)]
CELLS = [[0, 1, 2, 3], [1, 2, 3, 4], [2, 3, 4, 5]]
HEIGHTS = [3, 5, 0, 4, 2, 1]


def piece(vertices, cells, ghosts, names=None):
    """A .vtu by hand of some vertices, and of cells by their places in CELLS; `ghosts` are 1 for those of other pieces."""
    arrays = xml_array("Float32", "height", [HEIGHTS[v] for v in vertices])
    if names:
        arrays += xml_array("Int64", "GlobalPointIds", [names[v] for v in vertices])
    return vtu([POINTS[v] for v in vertices], [[vertices.index(v) for v in CELLS[cell]] for cell in cells], arrays,
               xml_array("UInt8", "vtkGhostType", ghosts))


@ranks.needs_mpi
@gale.needs_vtk
class PiecesOnRanks(ranks.ComplexTest):
    def points(self, files, more=()):
        """{vertex: (point, values of arrays)} of critical points."""
        found = {}
        for file in files:
            arrays = file.point_arrays
            for i, vertex in enumerate(arrays["ttkVertexScalarField"]):
                self.assertNotIn(vertex, found)
                found[vertex] = (file.points[i], {name: arrays[name][i] for name in ("CriticalType", "IsOnBoundary", *more)})
        return found

    def write_pieces(self, names=None):
        """Three pieces of the mesh: with ghosts before and behind, and an empty one."""
        self.write("small_0.vtu", piece([3, 1, 0, 2, 4], [0, 1], [0, 1], names))
        self.write("small_1.vtu", piece([], [], [], names))
        self.write("small_2.vtu", piece([0, 2, 1, 5, 3, 4], [0, 2, 1], [1, 0, 0], names))
        self.write("small.pvtu", pvtu([f"small_{k}.vtu" for k in range(3)], "GlobalPointIds" if names else ""))

    def test_vertices_are_numbered_by_the_global_ids_of_the_file(self):
        names = [7 + (v << 33) for v in (3, 1, 4, 0, 5, 2)]
        self.write_pieces(names)
        self.succeed("critical-points", "small.pvtu", "-o", "one.vtp")
        expected = self.points([gale.XmlFile(self.folder / "one.vtp")], ["GlobalPointIds"])
        self.assertTrue(expected)
        for vertex, (point, arrays) in expected.items():
            self.assertEqual(arrays["GlobalPointIds"], names[POINTS.index(point)])
            self.assertEqual(vertex, sorted(names).index(arrays["GlobalPointIds"]))
        for count in ranks.RANKS:
            with self.subTest(ranks=count):
                report = self.report_of(count, "critical-points", "small.pvtu", "-o", "all.pvtp")
                self.assertEqual((report["mesh"]["vertices"], report["mesh"]["tetrahedra"]), (6, 3))
                self.assertFalse([notice for notice in report["notices"] if "coordinates" in notice])
                self.assertEqual(self.points(self.pieces("all.pvtp"), ["GlobalPointIds"]), expected)

    def test_arrays_that_some_piece_lacks_are_noted(self):
        note = "left out the point array 'more': not all pieces have it"
        for lacking in range(4):
            for others in (0, 3):  # all of the others lack it, or have it
                with self.subTest(lacking=lacking, others=others):
                    for k in range(4):
                        has_more = (k == lacking) == (others == 0)
                        arrays = xml_array("Float32", "height", HEIGHTS[:4]) + (xml_array("Float32", "more", HEIGHTS[:4]) if has_more else "")
                        self.write(f"part{k}.vtu", vtu([(x + k, y, z) for x, y, z in POINTS[:4]], CELLS[:1], arrays))
                    self.write("parts.pvtu", pvtu([f"part{k}.vtu" for k in range(4)]))
                    for report in (self.report("critical-points", "parts.pvtu"), *(self.report_of(count, "critical-points", "parts.pvtu") for count in (2, 4))):
                        self.assertEqual([notice for notice in report["notices"] if "left out" in notice], [note])

    def test_arrays_of_one_name_and_two_types(self):
        """The second piece has the later one alone: it is what all have, whatever its name has before."""
        for k, types in enumerate((("Int8", "Float64"), ("Float64",))):
            arrays = "".join(xml_array(kind, "height", HEIGHTS[:4] if kind == "Float64" else [0, 0, 0, 0]) for kind in types)
            self.write(f"part{k}.vtu", vtu([(x + k, y, z) for x, y, z in POINTS[:4]], CELLS[:1], arrays))
        self.write("parts.pvtu", pvtu(["part0.vtu", "part1.vtu"]))
        one = self.report("merge-tree", "parts.pvtu", "--array", "height")["result"]
        for count in (2, 3):
            self.assertEqual(self.report_of(count, "merge-tree", "parts.pvtu", "--array", "height")["result"], one)

    def test_whole_numbers_that_are_rounded_are_noted(self):
        for k in range(2):
            self.write(f"part{k}.vtu", vtu([(x + k, y, z) for x, y, z in POINTS[:4]], CELLS[:1],
                                           xml_array("Int64", "height", [2**60 * k + height for height in HEIGHTS[:4]])))
        self.write("parts.pvtu", pvtu(["part0.vtu", "part1.vtu"]))
        for report in (self.report("critical-points", "parts.pvtu"), *(self.report_of(count, "critical-points", "parts.pvtu") for count in (2, 3))):
            self.assertEqual([notice for notice in report["notices"] if "2^53" in notice],
                             ["'height' has whole numbers beyond 2^53: they are ordered exactly, but differences are of rounded values"])

    def test_ties_go_by_ids_on_any_number_of_ranks_and_pieces(self):
        self.succeed("generate", "grid:7", "-o", "whole.vtu")
        whole = gale.XmlFile(self.folder / "whole.vtu")
        mesh = MeshWithIds(whole.points, whole.cells("Cells"))
        for count, pieces, with_order in ((2, 5, False), (3, 1, True)):
            with self.subTest(ranks=count, pieces=pieces):
                for k, text in enumerate(mesh.pieces(pieces, count, with_order)):
                    self.write(f"part{k}.vtu", text)
                self.write("parts.pvtu", pvtu([f"part{k}.vtu" for k in range(pieces)], "ids", "cell ids"))
                self.expect_complex_of_one_rank(count, "parts.pvtu", "--no-saddle-connectors")
                notes = [[note for note in report["notices"] if "contradicts" in note] for report in
                         (self.report("critical-points", "parts.pvtu"), self.report_of(count, "critical-points", "parts.pvtu"))]
                self.assertEqual(notes[0], notes[1])
                self.assertEqual(len(notes[0]), int(with_order))

    def test_pieces_of_other_cells_fit(self):
        """Hexahedra, some of them two wedges, with ids and without, and dealt out by the first rank."""
        n = 6
        points = [(x, y, z) for z in range(n) for y in range(n) for x in range(n)]
        cells = []
        for first in ((z * n + y) * n + x for z in range(n - 1) for y in range(n - 1) for x in range(n - 1)):
            low = [first, first + 1, first + n + 1, first + n]
            high = [v + n * n for v in low]
            if first % n < 3:
                cells.append(low + high)
            else:
                cells += [low[:3] + high[:3], [low[0], *low[2:], high[0], *high[2:]]]
        mesh = MeshWithIds(points, cells)
        for k, text in enumerate(mesh.pieces(5, 1)):
            self.write(f"part{k}.vtu", text)
        self.write("with_ids.pvtu", pvtu([f"part{k}.vtu" for k in range(5)], "ids", "cell ids"))
        self.write("without.pvtu", pvtu([f"part{k}.vtu" for k in range(5)]))
        self.write("one_file.vtu", vtu(points, cells, mesh.arrays(range(len(points)))))
        for source in ("with_ids.pvtu", "without.pvtu", "one_file.vtu"):
            for count in ranks.RANKS:
                with self.subTest(source=source, ranks=count):
                    self.expect_complex_of_one_rank(count, source, "--no-saddle-connectors")
        for report in (self.report("info", "with_ids.pvtu"), self.report_of(3, "critical-points", "with_ids.pvtu")):
            self.assertEqual(report["notices"][0], "split 75 hexahedra and 100 wedges into 750 tetrahedra")
        run = self.launch(2, "critical-points", "with_ids.pvtu", "--cells", "tetrahedra")
        self.expect_one_line(run, 1, "and tetrahedra alone are wanted")

    def test_ids_of_one_file_are_no_order(self):
        """Points of a file have one, which counts on any number of ranks."""
        self.succeed("generate", "grid:7", "-o", "whole.vtu")
        whole = gale.XmlFile(self.folder / "whole.vtu")
        mesh = MeshWithIds(whole.points, whole.cells("Cells"))
        arrays = mesh.arrays(range(len(mesh.points)))
        self.write("ids.vtu", vtu(mesh.points, mesh.cells, arrays, global_ids="ids"))
        self.write("no_ids.vtu", vtu(mesh.points, mesh.cells, arrays))
        expected = self.report("critical-points", "no_ids.vtu", "--array", "height")["result"]
        self.assertEqual(self.report("critical-points", "ids.vtu", "--array", "height")["result"], expected)
        self.assertEqual(self.report_of(2, "critical-points", "ids.vtu", "--array", "height")["result"], expected)

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
        self.write_ties("grid:8")
        expected = self.report("critical-points", "ties.vtk", "-o", "one.vtp")
        expected_points = self.points([gale.XmlFile(self.folder / "one.vtp")])
        self.report_of(3, "morse-smale", "ties.vtk", "--no-saddle-connectors", "-o", "wrote")
        for count in ranks.RANKS:
            with self.subTest(ranks=count):
                report = self.report_of(count, "critical-points", "wrote_segmentation.pvtu", "-o", "all.pvtp")
                self.assertEqual(report["result"], expected["result"])
                self.assertEqual(self.points(self.pieces("all.pvtp")), expected_points)
        self.expect_complex_of_one_rank(2, "wrote_segmentation.pvtu", "--no-saddle-connectors")

    def test_what_is_wrong_is_said_in_one_line(self):
        self.write_pieces([0, 1, 2, 2**62, 4, 5])
        line = f"its piece 'small_0.vtu': the array 'GlobalPointIds' gives point 0 the id {2**62}, which is none"
        self.refuse(1, "critical-points", "small.pvtu", naming=line)
        self.expect_one_line(self.launch(2, "critical-points", "small.pvtu"), 1, line)
        self.write_pieces()
        self.expect_one_line(self.launch(2, "critical-points", "small.pvtu", "--above", "1"), 1, "not an image")
        (self.folder / "small_2.vtu").unlink()
        self.expect_one_line(self.launch(3, "critical-points", "small.pvtu"), 1, "small_2.vtu")


if __name__ == "__main__":
    unittest.main()
