"""gale morse-smale and discrete-gradient under mpirun: all pieces together are the files of one rank."""
import unittest

import gale
import ranks


@ranks.needs_mpi
@gale.needs_vtk
class ComplexOnRanks(ranks.RanksTest):
    def simplices(self, files):
        """{(dimension, CellId): (point, values of arrays)} of critical simplices."""
        found = {}
        for file in files:
            arrays = file.point_arrays
            for i, key in enumerate(zip(arrays["CellDimension"], arrays["CellId"])):
                self.assertNotIn(key, found)
                found[key] = (file.points[i], {name: values[i] for name, values in arrays.items()})
        return found

    def lines(self, files):
        """{SeparatrixId: its points with their arrays, and the arrays of each of its lines}."""
        found = {}
        for file in files:
            arrays, cells = file.cell_arrays, file.cells("Lines")
            here = set(arrays["SeparatrixId"])
            self.assertFalse(here & set(found), "a separatrix in two pieces")
            for i, ends in enumerate(cells):
                points = [(file.points[k], *(values[k] for values in file.point_arrays.values())) for k in ends]
                found.setdefault(arrays["SeparatrixId"][i], []).append(
                    (points, {name: values[i] for name, values in arrays.items()}))
        return found

    def expect_segmentation(self, one, pieces):
        """Each vertex is no ghost in one piece, each tetrahedron is in one; in all, vertices have the values of one rank."""
        owned, cells = set(), {}
        for piece in pieces:
            arrays, ids = piece.point_arrays, piece.point_arrays["GlobalPointIds"]
            self.assertEqual(set(arrays) - set(one.point_arrays), {"vtkGhostType", "GlobalPointIds"})
            for i, vertex in enumerate(ids):
                self.assertEqual(piece.points[i], one.points[vertex])
                for name, values in one.point_arrays.items():
                    self.assertEqual(arrays[name][i], values[vertex], (name, vertex))
                if arrays["vtkGhostType"][i] == 0:
                    self.assertNotIn(vertex, owned)
                    owned.add(vertex)
            for cell, corners in zip(piece.cell_arrays["GlobalCellIds"], piece.cells("Cells")):
                self.assertNotIn(cell, cells)
                cells[cell] = [ids[k] for k in corners]
        self.assertEqual(owned, set(range(len(one.points))))
        self.assertEqual([cells[cell] for cell in sorted(cells)], one.cells("Cells"))

    def expect_files(self, pieces_named, *options):
        read = {kind: gale.XmlFile(self.folder / f"one_{kind}") for kind in
                ("critical_points.vtp", "separatrices1.vtp", "segmentation.vtu")}
        pieces = {kind: self.pieces(f"{pieces_named}_{kind.replace('.', '.p')}") for kind in read}
        self.assertEqual(self.simplices(pieces["critical_points.vtp"]), self.simplices([read["critical_points.vtp"]]))
        self.assertEqual(self.lines(pieces["separatrices1.vtp"]), self.lines([read["separatrices1.vtp"]]))
        self.expect_segmentation(read["segmentation.vtu"], pieces["segmentation.vtu"])

    def test_the_pieces_of_a_complex_are_the_files_of_one_rank(self):
        self.succeed("generate", "grid:14", "-o", "grid.vtu")
        for source in ("grid:14", "grid.vtu"):
            expected = self.report("morse-smale", source, "--no-saddle-connectors", "-o", "one")["result"]
            self.assertGreater(expected["separatrices"]["ascending"], 0)
            for count in ranks.RANKS:
                with self.subTest(source=source, ranks=count):
                    result = self.report_of(count, "morse-smale", source, "--no-saddle-connectors", "-o", "all")["result"]
                    self.assertEqual(result, expected)
                    self.expect_files("all")

    def test_what_is_switched_off_is_not_there(self):
        parts = ("--no-saddle-connectors", "--no-descending-separatrices", "--no-ascending-segmentation")
        expected = self.report("morse-smale", "grid:14", *parts, "-o", "one")["result"]
        self.assertEqual(self.report_of(3, "morse-smale", "grid:14", *parts, "-o", "all")["result"], expected)
        self.expect_files("all")
        types = self.pieces("all_segmentation.pvtu")[0].types("PointData")
        self.assertIn("DescendingManifold", types)
        self.assertNotIn("AscendingManifold", types)

    def test_the_pieces_of_a_gradient_are_the_file_of_one_rank(self):
        self.succeed("discrete-gradient", "grid:14", "-o", "one.vtp")
        for count in ranks.RANKS:
            with self.subTest(ranks=count):
                self.report_of(count, "discrete-gradient", "grid:14", "-o", "all.pvtp")
                self.assertEqual(self.simplices(self.pieces("all.pvtp")),
                                 self.simplices([gale.XmlFile(self.folder / "one.vtp")]))


if __name__ == "__main__":
    unittest.main()
