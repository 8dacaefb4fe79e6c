"""gale's analyses that gather what they need on the first rank, under mpirun: their files are those of one rank."""
import unittest

import gale
import ranks


@ranks.needs_mpi
@gale.needs_vtk
class GatheredOnRanks(ranks.ComplexTest):
    def expect_file(self, kind, one, all_):
        """Two files have the same points and cells, and arrays of the same values."""
        expected, found = gale.XmlFile(self.folder / one), gale.XmlFile(self.folder / all_)
        self.assertEqual(list(found.points), list(expected.points))
        self.assertEqual(found.cells(kind), expected.cells(kind))
        for arrays in ("point_arrays", "cell_arrays"):
            there, here = getattr(expected, arrays), getattr(found, arrays)
            self.assertEqual({name: list(values) for name, values in here.items()},
                             {name: list(values) for name, values in there.items()})

    def test_a_diagram_is_that_of_one_rank(self):
        self.write_ties("grid:10")
        for source, *options in (("grid:14",), ("ties.vtk",), ("grid:14", "--persistence", "5%"), ("plane:40",)):
            expected = self.report("persistence-diagram", source, *options, "-o", "one.vtu", "--curve", "one.csv")["result"]
            for count in ranks.RANKS:
                with self.subTest(source=source, options=options, ranks=count):
                    report = self.report_of(count, "persistence-diagram", source, *options, "-o", "all.vtu", "--curve", "all.csv")
                    self.assertEqual(report["result"], expected)
                    self.expect_file("Cells", "one.vtu", "all.vtu")
                    self.assertEqual((self.folder / "one.csv").read_text(), (self.folder / "all.csv").read_text())
                    self.assertGreater(report["ranks"]["gathered_bytes"]["most"], 0)

    def test_a_simplified_complex_is_that_of_one_rank(self):
        self.write_ties("grid:8", 12)
        self.write_ties("grid:9", 1000, "noise.vtk")
        for source, *options in (("noise.vtk", "--persistence", "5%"), ("ties.vtk", "--persistence", "0.5", "--separatrices2"),
                                 ("noise.vtk", "--persistence", "100", "--extrema-only")):
            for count in ranks.RANKS:
                with self.subTest(source=source, options=options, ranks=count):
                    self.expect_complex_of_one_rank(count, source, *options)

    def test_a_tree_is_that_of_one_rank(self):
        self.write_ties("grid:10")
        for source, *options in (("grid:14", "--type", "join"), ("ties.vtk", "--type", "split", "--arc-samples", "3"), ("grid:14", "--type", "contour", "--arc-samples", "3"),
                                 ("grid:14", "--type", "split", "--persistence", "10%"), ("plane:40", "--type", "contour", "--persistence", "10%")):
            expected = self.report("merge-tree", source, *options, "-o", "one")["result"]
            for count in ranks.RANKS:
                with self.subTest(source=source, options=options, ranks=count):
                    self.assertEqual(self.report_of(count, "merge-tree", source, *options, "-o", "all")["result"], expected)
                    self.expect_file("Verts", "one_nodes.vtp", "all_nodes.vtp")
                    self.expect_file("Lines", "one_arcs.vtp", "all_arcs.vtp")
                    self.expect_segmentation(gale.XmlFile(self.folder / "one_segmentation.vtu"), self.pieces("all_segmentation.pvtu"))

    def test_a_tree_of_64_bits_is_that_of_one_rank_also_where_some_have_nothing(self):
        for grid, count in (("grid:9", 3), ("grid:2", 7)):
            self.write_ties(grid, 20, "doubles.vtk", "double")
            for type in ("join", "contour"):
                with self.subTest(grid=grid, type=type):
                    expected = self.report("merge-tree", "doubles.vtk", "--type", type, "-o", "one")["result"]
                    self.assertEqual(self.report_of(count, "merge-tree", "doubles.vtk", "--type", type, "-o", "all")["result"], expected)
                    self.expect_file("Lines", "one_arcs.vtp", "all_arcs.vtp")
                    self.expect_segmentation(gale.XmlFile(self.folder / "one_segmentation.vtu"), self.pieces("all_segmentation.pvtu"))

    def test_a_simplified_field_is_that_of_one_rank(self):
        self.write_ties("grid:9", 40)
        for source, counts in (("grid:14", (3,)), ("ties.vtk", ranks.RANKS), ("plane:40", (2,))):
            options = ("simplify-field", source, "--persistence", "20%", "-o")
            expected = self.report(*options, "one.vtu")["result"]
            self.assertGreater(expected["moved"], 0)
            for count in counts:
                with self.subTest(source=source, ranks=count):
                    report = self.report_of(count, *options, "all.pvtu")
                    self.assertEqual(report["result"], expected)
                    self.expect_segmentation(gale.XmlFile(self.folder / "one.vtu"), self.pieces("all.pvtu"))
                    self.assertGreater(report["ranks"]["gathered_bytes"]["most"], 0)

    def test_arrows_are_those_of_one_rank(self):
        for source in ("grid:7", "plane:9"):
            self.succeed("discrete-gradient", source, "--arrows", "one.vtp")
            self.report_of(3, "discrete-gradient", source, "--arrows", "all.pvtp")

            def arrows(files):
                return sorted(arrow for file in files for arrow in zip(file.points, file.point_arrays["CellDimension"],
                                                                       file.point_arrays["Vector"]))
            self.assertEqual(arrows(self.pieces("all.pvtp")), arrows([gale.XmlFile(self.folder / "one.vtp")]))


@ranks.needs_mpi
class DrawnOnRanks(ranks.RanksTest, gale.DrawingTest):
    def test_pictures_are_those_of_one_rank(self):
        for width, *arguments in ((1200, "morse-smale", "plane:16", "--persistence", "5%"), (1400, "merge-tree", "grid:8")):
            with self.subTest(arguments=arguments):
                self.expect_drawn((width, 800), *arguments)
                one = (self.folder / "picture.png").read_bytes()
                self.launcher = ["xvfb-run", "--auto-servernum", *ranks.RanksTest.launcher]
                self.assertEqual(self.launch(2, *arguments, "--render", "picture.png").returncode, 0)
                self.assertEqual((self.folder / "picture.png").read_bytes(), one)


if __name__ == "__main__":
    unittest.main()
