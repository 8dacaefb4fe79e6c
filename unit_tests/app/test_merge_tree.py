"""gale merge-tree and gale simplify-field: counts that other programs find too; their files against each other."""
import math
import unittest

import gale


class MergeTree(gale.CommandTest):
    def test_has_as_many_nodes_as_others_find(self):
        for kind, nodes in {"join": 122, "split": 118, "contour": 238}.items():
            for structure in gale.STRUCTURES:
                with self.subTest(type=kind, structure=structure):
                    result = self.report("merge-tree", "grid:48", "--type", kind, "--structure", structure)["result"]
                    self.assertEqual((result["nodes"], result["arcs"]), (nodes, nodes - 1))

    def test_without_branches_has_the_pairs_that_persist(self):
        for threshold in ("0.5%", "3%", "10%"):
            with self.subTest(threshold=threshold):
                pairs = self.report("persistence-diagram", "grid:48", "--persistence", threshold)["result"]["pairs"]
                join = self.report("merge-tree", "grid:48", "--type", "join", "--persistence", threshold)["result"]
                self.assertEqual(join["minima"], pairs[0] + 1)
                contour = self.report("merge-tree", "grid:48", "--persistence", threshold)["result"]
                left = self.report("simplify-field", "grid:48", "--persistence", threshold)["result"]
                self.assertEqual([contour[name] for name in ("minima", "maxima")], [left[name] for name in ("minima", "maxima")])

    def test_is_printed(self):
        printed = self.succeed("merge-tree", "grid:48")
        for line in ("nodes +238", "arcs +237"):
            self.assertRegex(printed, rf"(?m)^{line}$")

    def test_refuses_what_it_does_not_know(self):
        self.refuse(2, "merge-tree", "grid:8", "--type", "oak", naming="--type")
        self.refuse(2, "merge-tree", "grid:8", "--arc-samples", "-1", naming="--arc-samples")
        self.refuse(2, "simplify-field", "grid:8", "-o", "points.vtp", naming="gale simplify-field writes .vtu or .vtk")

    @gale.needs_vtk
    def test_files_agree(self):
        for samples in (0, 4):
            with self.subTest(samples=samples):
                self.succeed("merge-tree", "grid:24", "--arc-samples", str(samples), "-o", "tree")
                nodes, arcs, mesh = (gale.XmlFile(self.folder / f"tree_{name}") for name in ("nodes.vtp", "arcs.vtp", "segmentation.vtu"))
                of_nodes, of_arcs, of_mesh = nodes.point_arrays, arcs.cell_arrays, mesh.point_arrays
                count = len(nodes.points)
                self.assertEqual(of_nodes["NodeId"], list(range(count)))
                self.assertEqual(of_nodes["Scalar"], sorted(of_nodes["Scalar"]))
                for vertex, place in zip(of_nodes["VertexId"], nodes.points):
                    self.assertEqual(place, (vertex % 24, vertex // 24 % 24, vertex // 24 ** 2))
                self.assertEqual(arcs.points[:count], nodes.points)
                self.assertEqual(arcs.point_arrays["RegularMask"], [0] * count + [1] * (len(arcs.points) - count))
                lines = arcs.cells("Lines")
                self.assertEqual(len(lines), count - 1)
                for arc, (line, lower, upper) in enumerate(zip(lines, of_arcs["downNodeId"], of_arcs["upNodeId"])):
                    self.assertEqual((line[0], line[-1]), (lower, upper))
                    self.assertLessEqual(len(line), samples + 2)
                    heights = [arcs.point_arrays["Scalar"][point] for point in line]
                    self.assertEqual(heights, sorted(heights))
                    self.assertEqual(of_arcs["SegmentationId"][arc], arc)
                inside = [0] * len(lines)
                for vertex, arc in enumerate(of_mesh["SegmentationId"]):
                    inside[arc] += vertex not in of_nodes["VertexId"]
                    self.assertEqual(of_mesh["RegionSize"][vertex], of_arcs["RegionSize"][arc])
                self.assertEqual(inside, of_arcs["RegionSize"])


class Pictures(gale.DrawingTest):
    @gale.needs_vtk
    def test_are_drawn_on_a_display_that_no_one_sees(self):
        self.write("mesh.vtk", gale.vtk_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [[0, 1, 2, 3]], {"height": ("float", [0, 1, 2, math.inf])}))
        self.write("alike.vtk", gale.vtk_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (9, 9, 0)], [[0, 1, 2]], {"height": ("float", [1, 1, 1, 1])}))
        for arguments in (["grid:24"], ["plane:32", "--type", "join"], ["grid:24", "--type", "split", "--persistence", "20%"], ["mesh.vtk"], ["alike.vtk"]):
            with self.subTest(arguments=arguments):
                self.expect_drawn((1400, 800), "merge-tree", *arguments)

    def test_are_refused_where_they_cannot_be(self):
        self.expect_refused("merge-tree")


class SimplifiedField(gale.CommandTest):
    def test_has_as_many_extrema_as_others_leave(self):
        result = self.report("simplify-field", "grid:48", "--persistence", "5%")["result"]
        self.assertEqual([result[name] for name in ("minima", "maxima", "kept_below")], [7, 6, 0])
        self.assertEqual(self.report("simplify-field", "grid:48")["result"]["moved"], 0)

    @gale.needs_vtk
    def test_is_read_again_as_it_was_written(self):
        self.succeed("simplify-field", "grid:48", "--persistence", "5%", "-o", "left.vtu")
        points = self.report("critical-points", "left.vtu")["result"]
        self.assertEqual((points["minima"], points["maxima"]), (7, 6))
        self.assertEqual(self.report("discrete-gradient", "left.vtu")["result"]["critical"][0], 7)
        again = self.report("simplify-field", "left.vtu", "--persistence", "5%")["result"]
        self.assertEqual(again["moved"], 0)


if __name__ == "__main__":
    unittest.main()
