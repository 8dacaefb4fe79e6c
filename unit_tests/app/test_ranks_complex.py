"""gale morse-smale and discrete-gradient under mpirun: all pieces together are the files of one rank."""
import unittest

import gale
import ranks


@ranks.needs_mpi
@gale.needs_vtk
class ComplexOnRanks(ranks.ComplexTest):
    def test_the_pieces_of_a_complex_are_the_files_of_one_rank(self):
        self.write_ties("grid:10")
        for source, *walls in (("grid:14",), ("ties.vtk", "--separatrices2")):
            for count in ranks.RANKS:
                with self.subTest(source=source, ranks=count):
                    self.expect_complex_of_one_rank(count, source, *walls)

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
