"""gale of surfaces under mpirun: all pieces together are the files of one rank."""
import unittest

import gale
import ranks
from meshes_in_pieces import MeshWithIds, pvtu, vtu


@ranks.needs_mpi
class SurfacesOnRanks(ranks.ComplexTest):
    def test_counts_are_those_of_one_rank(self):
        for command in ("critical-points", "discrete-gradient", "morse-smale"):
            expected = self.report(command, "plane:64")
            for count in ranks.RANKS:
                with self.subTest(command=command, ranks=count):
                    report = self.report_of(count, command, "plane:64")
                    self.assertEqual(report["result"], expected["result"])
                    self.assertEqual({**report["mesh"], "segments": None}, {**expected["mesh"], "segments": None})
                    self.assertGreater(report["ranks"]["triangles"]["least"], 2 * 63**2 / 2 / count)

    @gale.needs_vtk
    def test_pieces_are_the_files_of_one_rank(self):
        self.write_ties("plane:11")
        for command, count, source in (("critical-points", 3, "ties.vtk"), ("critical-points", 7, "plane:20"),
                                       ("discrete-gradient", 7, "ties.vtk"), ("discrete-gradient", 2, "plane:20")):
            with self.subTest(command=command, ranks=count, source=source):
                self.succeed(command, source, "-o", "one.vtp")
                self.report_of(count, command, source, "-o", "all.pvtp")
                found = [row for piece in self.pieces("all.pvtp") for row in self.rows(piece)]
                self.assertEqual(sorted(found), sorted(self.rows(gale.XmlFile(self.folder / "one.vtp"))))
        for count in ranks.RANKS:
            with self.subTest(ranks=count):
                self.expect_complex_of_one_rank(count, "ties.vtk" if count != 3 else "plane:30")
        self.report_of(3, "morse-smale", "ties.vtk", "-o", "wrote")  # what ranks write they read
        self.expect_complex_of_one_rank(2, "wrote_segmentation.pvtu")

    def rows(self, file):
        return [(point, *(values[i] for values in file.point_arrays.values())) for i, point in enumerate(file.points)]

    @gale.needs_vtk
    def test_cells_of_a_surface_are_split_alike(self):
        """Quads, pentagons and triangles in pieces with ids and without, and in one file."""
        n = 7
        points = [(x, y, x * y % 3) for y in range(n) for x in range(n)]
        cells = []
        for a in (y * n + x for y in range(n - 1) for x in range(n - 1)):
            quad = [a, a + 1, a + n + 1, a + n]
            cells += [[quad], [quad[:3], [*quad[2:], a]]][a % 3 == 0]
        last = n * n
        points += [(n, 0, 5), (n, 1, 5)]
        cells.append([n - 1, last, last + 1, 2 * n - 1, 3 * n - 1])
        mesh = MeshWithIds(points, cells, flat=True)
        for k, text in enumerate(mesh.pieces(4, 1)):
            self.write(f"part{k}.vtu", text)
        self.write("with_ids.pvtu", pvtu([f"part{k}.vtu" for k in range(4)], "ids", "cell ids"))
        self.write("without.pvtu", pvtu([f"part{k}.vtu" for k in range(4)]))
        self.write("one_file.vtu", vtu(points, cells, mesh.arrays(range(len(points))), flat=True))
        self.succeed("generate", "one_file.vtu", "-o", "surface.vtp")
        for count, source in ((2, "with_ids.pvtu"), (7, "with_ids.pvtu"), (3, "without.pvtu"), (2, "one_file.vtu"), (3, "surface.vtp")):
            with self.subTest(source=source, ranks=count):
                self.expect_complex_of_one_rank(count, source, "--height", "z")
        for count in (1, 3):
            notices = self.report_of(count, "critical-points", "with_ids.pvtu")["notices"]
            self.assertRegex(notices[0], "^split 1 polygons and [0-9]+ quads into [0-9]+ triangles$")
        self.expect_one_line(self.launch(2, "critical-points", "with_ids.pvtu", "--cells", "simplices"), 1, "and triangles alone are wanted")

    def test_what_tetrahedra_have_is_refused(self):
        self.expect_one_line(self.launch(2, "morse-smale", "plane:8", "--separatrices2", "--persistence", "1%"), 1, "triangles has no 2-separatrices")


if __name__ == "__main__":
    unittest.main()
