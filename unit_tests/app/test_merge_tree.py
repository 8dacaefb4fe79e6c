"""gale merge-tree and gale simplify-field: counts that other programs find too; their files against each other."""
import math
import unittest

import gale


def nodes_of_union_find(cells, values, sign):
    """How many nodes the join (sign 1) or split (-1) tree of a connected mesh has."""
    neighbours, component = {}, {}
    for cell in cells:
        for vertex in cell:
            neighbours.setdefault(vertex, set()).update(cell)

    def find(vertex):
        while component[vertex] != vertex:
            component[vertex] = vertex = component[component[vertex]]
        return vertex

    nodes = 1  # where it ends
    for vertex in sorted(neighbours, key=lambda vertex: (sign * values[vertex], sign * vertex)):
        met = {find(other) for other in neighbours[vertex] if other in component}
        nodes += len(met) != 1
        component[vertex] = vertex
        component.update(dict.fromkeys(met, vertex))
    return nodes


class MergeTree(gale.CommandTest):
    def test_has_as_many_nodes_as_others_find(self):
        for mesh, counts in (("grid:48", {"join": 122, "split": 118, "contour": 238}), ("plane:600", {"contour": 7062})):
            for kind, nodes in counts.items():
                for structure in gale.STRUCTURES:
                    with self.subTest(mesh=mesh, type=kind, structure=structure):
                        result = self.report("merge-tree", mesh, "--type", kind, "--structure", structure)["result"]
                        self.assertEqual((result["nodes"], result["arcs"]), (nodes, nodes - 1))

    @gale.needs_vtk
    def test_of_triangles_has_as_many_nodes_as_union_find_says(self):
        self.succeed("generate", "plane:64", "-o", "plane.vtu")
        file = gale.XmlFile(self.folder / "plane.vtu")
        for kind, sign in (("join", 1), ("split", -1)):
            nodes = self.report("merge-tree", "plane:64", "--type", kind)["result"]["nodes"]
            self.assertEqual(nodes, nodes_of_union_find(file.cells("Cells"), file.point_arrays["field"], sign))

    def test_without_branches_has_the_pairs_that_persist(self):
        for mesh, threshold in ((mesh, threshold) for mesh in ("grid:48", "plane:64") for threshold in ("0.5%", "3%", "10%")):
            with self.subTest(mesh=mesh, threshold=threshold):
                pairs = self.report("persistence-diagram", mesh, "--persistence", threshold)["result"]["pairs"]
                join = self.report("merge-tree", mesh, "--type", "join", "--persistence", threshold)["result"]
                self.assertEqual(join["minima"], pairs[0] + 1)
                contour = self.report("merge-tree", mesh, "--persistence", threshold)["result"]
                left = self.report("simplify-field", mesh, "--persistence", threshold)["result"]
                self.assertEqual([contour[name] for name in ("minima", "maxima")], [left[name] for name in ("minima", "maxima")])

    def test_is_printed(self):
        printed = self.succeed("merge-tree", "grid:48")
        for line in ("nodes +238", "arcs +237"):
            self.assertRegex(printed, rf"(?m)^{line}$")

    def test_refuses_what_it_does_not_know(self):
        self.refuse(2, "merge-tree", "grid:8", "--type", "oak", naming="--type")
        for samples in ("-1", "1001", "x", "1.5"):
            self.refuse(2, "merge-tree", "grid:8", "--arc-samples", samples, naming="--arc-samples")
        for command in ("merge-tree", "simplify-field"):
            for value in ("-1", "x", "1%%", "nan"):
                self.refuse(2, command, "grid:8", f"--persistence={value}", naming="--persistence")
            self.refuse(1, command, "grid:8", "--array", "height", naming="height")
        self.refuse(2, "simplify-field", "grid:8", "-o", "points.vtp", naming="gale simplify-field writes .vtu or .vtk")
        if self.report("merge-tree", "grid:4")["device"] is None:
            self.refuse(2, "merge-tree", "grid:4", "--consumers", "device", naming="has no device")

    @gale.needs_vtk
    def test_refuses_values_that_are_no_numbers_where_it_needs_them(self):
        self.write("mesh.vtk", gale.vtk_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], [[0, 1, 2], [1, 2, 3]],
                                             {"height": ("float", [0, math.nan, 2, 1])}))
        for command in (["merge-tree"], ["merge-tree", "--type", "split"], ["simplify-field"]):
            self.refuse(1, *command, "mesh.vtk", "--persistence", "0.1", naming="vertex 1 has no field value: it is NaN")

    @gale.needs_vtk
    def test_refuses_what_it_cannot_write(self):
        self.refuse(1, "merge-tree", "missing.vtu", "-o", "nowhere/out", naming="nowhere/out_nodes.vtp")  # before the input is looked at
        self.refuse(2, "merge-tree", "out_segmentation.vtu", "-o", "out", naming="out_segmentation.vtu")
        self.refuse(2, "merge-tree", "grid:4", "-o", "out", "--report", "./out_arcs.vtp", naming="out_arcs.vtp")
        self.refuse(2, "simplify-field", "grid:4", "-o", "out.vtk", "--report", "out.vtk", naming="out.vtk")
        (self.folder / "out_segmentation.vtu").mkdir()
        self.refuse(1, "merge-tree", "grid:4", "-o", "out", naming="out_segmentation.vtu")
        self.assertEqual(self.names(), ["out_segmentation.vtu"])

    @gale.needs_vtk
    def test_files_agree(self):
        for mesh, samples in (("grid:24", 0), ("grid:24", 4), ("plane:24", 3)):
            with self.subTest(mesh=mesh, samples=samples):
                self.succeed("merge-tree", mesh, "--arc-samples", str(samples), "-o", "tree")
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
        for mesh in ("grid:48", "plane:64"):
            with self.subTest(mesh=mesh):
                left = self.report("simplify-field", mesh, "--persistence", "5%", "-o", "left.vtu")["result"]
                points = self.report("critical-points", "left.vtu")["result"]
                self.assertEqual((points["minima"], points["maxima"]), (left["minima"], left["maxima"]))
                self.assertEqual(self.report("discrete-gradient", "left.vtu")["result"]["critical"][0], left["minima"])
                again = self.report("simplify-field", "left.vtu", "--persistence", "5%")["result"]
                self.assertEqual(again["moved"], 0)


if __name__ == "__main__":
    unittest.main()
