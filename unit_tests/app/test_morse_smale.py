"""gale morse-smale: the same complex whatever computed it; its switches; what it draws; what it refuses."""
import math
import unittest

import gale
from morse_smale import KINDS, ComplexTest

GRID_64 = [134, 356, 263, 40]


class Counts(ComplexTest):
    def test_of_a_grid(self):
        results = []
        for structure in [*gale.STRUCTURES, "task-parallel"]:
            with self.subTest(structure=structure):
                results.append(self.result("grid:64", "--structure", structure))
                self.assertEqual(results[-1]["critical"], GRID_64)
                self.assertEqual(results[-1]["separatrices"]["descending"], 2 * GRID_64[1])
                self.assertEqual([results[-1]["manifolds"][kind] for kind in ("descending", "ascending")], [GRID_64[0], GRID_64[3]])
        self.assertEqual(results, results[:1] * len(results))

    def test_are_printed(self):
        printed = self.succeed("morse-smale", "grid:64")
        for line in ("minima +134", "Euler number +1", "1-separatrices +712 descending, 280 ascending, 1,330 saddle connectors",
                     "manifolds +40 ascending, 134 descending, 419 Morse-Smale"):
            self.assertRegex(printed, rf"(?m)^{line}$")

    def test_of_what_is_switched_off_are_null(self):
        everything = self.result("grid:32")
        for switch, off in (("--no-descending-separatrices", [("separatrices", "descending")]), ("--no-ascending-separatrices", [("separatrices", "ascending")]),
                            ("--no-saddle-connectors", [("separatrices", "saddle_connectors")]),
                            ("--no-ascending-segmentation", [("manifolds", "ascending"), ("manifolds", "morse_smale")]),
                            ("--no-descending-segmentation", [("manifolds", "descending"), ("manifolds", "morse_smale")])):
            for more in ([], ["--separatrices2"]):
                with self.subTest(switch=switch, more=more):
                    expected = {key: dict(value) if isinstance(value, dict) else value for key, value in everything.items()}
                    for kind, part in off:
                        expected[kind][part] = None
                    self.assertEqual(self.result("grid:32", switch, *more), expected)


class Persistence(ComplexTest):
    def test_keeps_the_euler_number(self):
        before = self.result("grid:32")
        for threshold in ("0", "1e-2", "1%", "0.1", "5%", "20%", "200%"):
            with self.subTest(threshold=threshold):
                after = self.result("grid:32", "--persistence", threshold)
                self.assertEqual(after["euler"], before["euler"])
                self.assertTrue(all(a <= b for a, b in zip(after["critical"], before["critical"])))
                before = after
        self.assertEqual(before["critical"][0], 1)

    def test_cancels_nothing_below_zero(self):
        self.assertEqual(self.result("grid:32", "--persistence", "0"), self.result("grid:32"))

    def test_does_not_depend_on_what_is_written(self):
        everything = self.result("grid:32", "--persistence", "5%")
        for switch, key in (("--no-descending-separatrices", "descending"), ("--no-ascending-separatrices", "ascending"), ("--no-saddle-connectors", "saddle_connectors")):
            with self.subTest(switch=switch):
                result = self.result("grid:32", "--persistence", "5%", switch)
                self.assertEqual(result["critical"], everything["critical"])
                self.assertEqual(result["separatrices"], {**everything["separatrices"], key: None})

    @gale.needs_vtk
    def test_percents_are_of_the_range(self):
        self.write("mesh.vtk", gale.vtk_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)], [[1, 0, 2, 3], [4, 2, 3, 1]],
                                             {"height": ("float", [0, 20, 30, 40, 10])}))  # the minimum 4 joins the other at the edge 14, 10 above it
        for threshold, minima in (("9.9", 2), ("10.1", 1), ("24%", 2), ("26%", 1)):
            with self.subTest(threshold=threshold):
                self.assertEqual(self.result("mesh.vtk", "--persistence", threshold)["critical"], [minima, minima - 1, 0, 0])

    @gale.needs_vtk
    def test_there_are_no_percents_of_an_infinite_range(self):
        self.write("mesh.vtk", gale.vtk_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [[0, 1, 2, 3]], {"height": ("float", [0, 1, 2, math.inf])}))
        self.refuse(1, "morse-smale", "mesh.vtk", "--persistence", "5%", naming="--persistence")
        self.succeed("morse-smale", "mesh.vtk", "--persistence", "5")

    @gale.needs_vtk
    def test_needs_values_where_an_order_would_do(self):
        self.write("mesh.vtk", gale.vtk_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)], [[0, 1, 2, 3]],
                                             {"height": ("float", [0, 1, 2, 3, math.nan]), "height_Order": ("int", range(5))}))
        self.succeed("morse-smale", "mesh.vtk")
        self.refuse(1, "morse-smale", "mesh.vtk", "--persistence", "5", naming="vertex 4 ")

    def test_refuses_other_values(self):
        for value in ("", "%", "5x", "5 %", "-1", "-1%", "nan", "inf", "1e999", "0x10", "5%%", "five"):
            with self.subTest(value=value):
                self.refuse(2, "morse-smale", "grid:4", f"--persistence={value}", naming="--persistence")


@gale.needs_vtk
class Files(ComplexTest):
    def test_are_the_same_whatever_computed_them(self):
        structures = [*gale.STRUCTURES, "task-parallel"]
        ways = [["--structure", structure, "--threads", threads] for structure in structures for threads in (1, 2, 8)]
        ways += [["--structure", structure, *segments] for structure in structures
                 for segments in (["--capacity", 7], ["--capacity", 100], ["--segments", "random:50"])]
        for more, tried in (([], ways), (["--persistence", "1e-2"], ways[::3])):
            files = set()
            for way in tried:
                self.succeed("morse-smale", "grid:20", "--separatrices2", "-o", "out", *more, *way)
                files.add(tuple((self.folder / f"out_{kind}").read_bytes() for kind in KINDS))
            self.assertEqual(len(files), 1, more)
        self.assertEqual(self.names(), sorted(f"out_{kind}" for kind in KINDS))

    def test_are_those_of_what_is_switched_on(self):
        no_lines = ["--no-descending-separatrices", "--no-ascending-separatrices", "--no-saddle-connectors"]
        no_labels = ["--no-ascending-segmentation", "--no-descending-segmentation"]
        for arguments, kinds in (([], [0, 1, 3]), (["--separatrices2"], [0, 1, 2, 3]), (no_lines, [0, 3]), (no_labels, [0, 1]), (no_lines + no_labels, [0])):
            with self.subTest(arguments=arguments):
                self.files("grid:16", *arguments)
                self.assertEqual(self.names(), sorted(f"out_{KINDS[kind]}" for kind in kinds))
                for name in self.names():
                    (self.folder / name).unlink()

    def test_of_a_field_that_is_infinite_everywhere(self):
        self.write("mesh.vtk", gale.vtk_mesh([(0, 0, 0), (1, 1, 1), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [[2, 0, 3, 4], [1, 3, 4, 2]],
                                             {"height": ("float", [math.inf] * 5)}))  # by id: minima 0 and 1, and the edge 12 between them
        arrays = self.files("mesh.vtk", "--separatrices2")["separatrices1.vtp"].cell_arrays
        self.assertEqual(set(arrays["SeparatrixFunctionMaximum"]), {math.inf})
        self.assertEqual(set(arrays["SeparatrixFunctionDifference"]), {0})

    def test_of_a_field_without_saddles(self):
        self.write("mesh.vtk", gale.vtk_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [[0, 1, 2, 3]], {"height": ("double", range(4))}))
        files = self.files("mesh.vtk", "--separatrices2")
        self.assertEqual([len(files[kind].points) for kind in KINDS], [1, 0, 0, 4])
        self.assertEqual(files["segmentation.vtu"].point_arrays["DescendingManifold"], [0] * 4)
        self.assertEqual(files["segmentation.vtu"].point_arrays["AscendingManifold"], [-1] * 4)

    def test_refuses_what_it_cannot_write(self):
        self.refuse(1, "morse-smale", "missing.vtu", "-o", "nowhere/out", naming="nowhere/out_critical_points.vtp")  # before the input is looked at
        self.refuse(2, "morse-smale", "out_segmentation.vtu", "-o", "out", naming="out_segmentation.vtu")
        self.refuse(2, "morse-smale", "grid:4", "-o", "out", "--report", "./out_separatrices1.vtp", naming="out_separatrices1.vtp")
        (self.folder / "out_segmentation.vtu").mkdir()
        self.refuse(1, "morse-smale", "grid:4", "-o", "out", naming="out_segmentation.vtu")
        self.assertEqual(self.names(), ["out_segmentation.vtu"])


class Pictures(gale.DrawingTest):
    @gale.needs_vtk
    def test_are_drawn_on_a_display_that_no_one_sees(self):
        for arguments in (["grid:24", "--persistence", "1%"], ["plane:24"], ["grid:24", "--no-descending-segmentation", "--no-descending-separatrices"],
                          ["grid:24", "--no-descending-segmentation", "--no-ascending-segmentation", "--no-descending-separatrices", "--no-ascending-separatrices", "--no-saddle-connectors"]):
            with self.subTest(arguments=arguments):
                self.expect_drawn((1200, 800), "morse-smale", *arguments)

    @gale.needs_vtk
    def test_of_a_mesh_too_small_to_be_cut(self):
        self.write("mesh.vtk", gale.vtk_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [[0, 1, 2, 3]], {"height": ("float", [0, 1, 2, math.inf])}))
        self.expect_drawn((1200, 800), "morse-smale", "mesh.vtk")

    def test_are_refused_where_they_cannot_be(self):
        self.expect_refused("morse-smale")


if __name__ == "__main__":
    unittest.main()
