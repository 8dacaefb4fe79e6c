"""gale discrete-gradient: the same critical simplices and arrows whatever computed them; numbers and places by hand; what it refuses."""
import itertools
import math
import unittest
from pathlib import Path

import gale

GRID_32 = [26, 59, 37, 3]
GRID_64 = [134, 356, 263, 40]
BRAIN = Path("/usr/share/mricron/templates/inia19-t1-brain.nii.gz")
BRAIN_COUNTS = [20444, 64978, 58514, 13979]

# Two tetrahedra on a triangle, with two minima: edges 01 02 03 12 13 14 23 24 34, triangles 012 013 023 123 124 134 234.
TWO_POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
TWO = gale.vtk_mesh(TWO_POINTS, [[1, 0, 2, 3], [4, 2, 3, 1]], {"height": ("float", [0, 2, 3, 4, 1]), "label": ("int", [9, 8, 7, 6, 5])})

# Eight tetrahedra round a maximum, 6. Its link rises from two minima, 0 and 1, through 2 and 3, which make a circle of them, to 4 and 5, which close it on either
# side. Edges: 02 03 04 05 06 12 13 ...; triangles: the eight of 0, then 124 125 126 134 135 ...
BALL_POINTS = [(1, 0, 0), (-4, 0, 0), (0, 2, 0), (0, -3, 0), (0, 0, 1), (0, 0, -5), (0, 0, 0)]
BALL_CELLS = [[6, x, y, z] for x in (0, 1) for y in (2, 3) for z in (4, 5)]


class GradientTest(gale.CommandTest):
    def critical(self, *arguments):
        """Numbers of critical simplices by dimension."""
        result = self.report("discrete-gradient", *arguments)["result"]
        self.assertEqual(list(result), ["critical", "euler"])
        c0, c1, c2, c3 = result["critical"]
        self.assertEqual(result["euler"], c0 - c1 + c2 - c3)
        return result["critical"]

    def read(self, option, *arguments):
        """Points and arrays of the file that an option names."""
        self.succeed("discrete-gradient", *arguments, option, "file.vtp")
        return gale.read_vtp(self.folder / "file.vtp")

    def assertNear(self, points, expected):
        self.assertEqual(len(points), len(expected))
        for point, wanted in zip(points, expected):
            for x, y in zip(point, wanted):
                self.assertAlmostEqual(x, y, places=5)


class Counts(GradientTest):
    def test_of_a_small_grid(self):
        for structure in [*gale.STRUCTURES, "task-parallel"]:
            for capacity, threads in ((1, 2), (7, 8), (100, 1), (1000000, 2)):
                with self.subTest(structure=structure, capacity=capacity, threads=threads):
                    self.assertEqual(self.critical("grid:32", "--structure", structure, "--capacity", capacity, "--threads", threads), GRID_32)

    def test_of_consumers_on_either_side(self):
        self.assertEqual(self.critical("grid:32", "--consumers", "host"), GRID_32)
        self.succeed("discrete-gradient", "grid:16", "--consumers", "host", "-o", "host.vtp", "--arrows", "host_arrows.vtp")
        self.succeed("discrete-gradient", "grid:16", "-o", "any.vtp", "--arrows", "any_arrows.vtp")
        for name in ("%s.vtp", "%s_arrows.vtp"):
            self.assertEqual((self.folder / (name % "any")).read_bytes(), (self.folder / (name % "host")).read_bytes())
        self.refuse(2, "discrete-gradient", "grid:8", "--consumers", "device", "--formulation", "cells", naming="device")

    def test_of_a_larger_grid(self):
        for structure in [*gale.STRUCTURES, "task-parallel"]:
            with self.subTest(structure=structure):
                self.assertEqual(self.critical("grid:64", "--structure", structure), GRID_64)

    @gale.needs_vtk
    @unittest.skipUnless(BRAIN.exists(), f"there is no {BRAIN}")
    def test_of_a_brain(self):
        for structure in gale.STRUCTURES:
            with self.subTest(structure=structure):
                self.assertEqual(self.critical(BRAIN, "--above", "0", "--structure", structure), BRAIN_COUNTS)

    def test_are_printed(self):
        printed = self.succeed("discrete-gradient", "grid:32")
        for name, count in zip(("minima", "1-saddles", "2-saddles", "maxima", "Euler number"), [*GRID_32, 1]):
            self.assertRegex(printed, rf"(?m)^{name} +{count}$")

    def test_report(self):
        report = self.report("discrete-gradient", "grid:16", "--threads", "2")
        self.assertEqual((report["mesh"]["edges"], report["mesh"]["triangles"]), (None, None))
        self.assertGreater(report["seconds"]["run"], 0)
        self.assertEqual(report["seconds"]["write"], 0)
        self.assertEqual(self.names(), ["report.json"])


@gale.needs_vtk
class CriticalSimplices(GradientTest):
    def test_of_two_tetrahedra(self):
        points, arrays = self.read("-o", self.write("two.vtk", TWO))
        self.assertEqual(arrays, {"height": [0, 1, 2], "label": [9, 5, 8], "CellDimension": [0, 0, 1], "CellId": [0, 4, 5],
                                  "IsOnBoundary": [1, 1, 1], "ttkVertexScalarField": [0, 4, 1]})
        self.assertNear(points, [(0, 0, 0), (1, 1, 1), (1, 0.5, 0.5)])

    def test_of_a_ball_round_its_maximum(self):
        self.write("ball.vtk", gale.vtk_mesh(BALL_POINTS, BALL_CELLS, {"height": ("double", range(7))}))
        points, arrays = self.read("-o", "ball.vtk")
        self.assertEqual(arrays, {"height": list(range(7)), "CellDimension": [0, 0, 1, 1, 2, 2, 3], "CellId": [0, 1, 5, 6, 11, 12, 7],
                                  "IsOnBoundary": [1] * 6 + [0], "ttkVertexScalarField": list(range(7))})
        p = BALL_POINTS
        self.assertNear(points, [p[0], p[1], gale.barycentre([p[1], p[2]]), gale.barycentre([p[1], p[3]]), gale.incentre(p[1], p[3], p[4]), gale.incentre(p[1], p[3], p[5]),
                                 gale.barycentre([p[1], p[3], p[5], p[6]])])

    def test_of_a_grid_are_in_order(self):
        points, arrays = self.read("-o", "grid:32")
        dimensions, ids = arrays["CellDimension"], arrays["CellId"]
        self.assertEqual([dimensions.count(dimension) for dimension in range(4)], GRID_32)
        self.assertEqual(list(zip(dimensions, ids)), sorted(set(zip(dimensions, ids))))
        for point, vertex, dimension in zip(points, arrays["ttkVertexScalarField"], dimensions):
            corner = (vertex % 32, vertex // 32 % 32, vertex // 1024)
            self.assertLessEqual(max(abs(x - y) for x, y in zip(point, corner)), 0 if dimension == 0 else 1)
        for point, flag in zip(points, arrays["IsOnBoundary"]):
            self.assertTrue(flag or all(0 < x < 31 for x in point))

    def test_ids_are_those_of_relations(self):
        _, arrays = self.read("-o", "grid:12")
        for dimension, relation in ((1, "EV"), (2, "FV")):
            self.succeed("relations", "grid:12", "--relation", relation, "--dump", "rows.txt")
            rows = [list(map(int, line.split(":")[1].split())) for line in (self.folder / "rows.txt").read_text().splitlines()[1:]]
            for cell, vertex, of in zip(arrays["CellId"], arrays["ttkVertexScalarField"], arrays["CellDimension"]):
                if of == dimension:
                    self.assertIn(vertex, rows[cell])

    def test_without_any_of_a_dimension(self):
        _, arrays = self.read("-o", "grid:2")
        self.assertEqual(arrays["CellDimension"], [0])


@gale.needs_vtk
class Arrows(GradientTest):
    def test_of_two_tetrahedra(self):
        points, arrays = self.read("--arrows", self.write("two.vtk", TWO))
        self.assertEqual(sorted(arrays), ["CellDimension", "Vector"])
        self.assertEqual(arrays["CellDimension"], [0] * 3 + [1] * 5 + [2] * 2)
        # 1, 2 and 3 are paired with their edges to 0; 12 and 24 with 012 and 124.
        pairs = [([1], [0, 1]), ([2], [0, 2]), ([3], [0, 3]), ([1, 2], [0, 1, 2]), ([2, 4], [1, 2, 4])]
        for (tail, head), point, vector in zip(pairs, points, arrays["Vector"]):
            start, end = (gale.barycentre([TWO_POINTS[vertex] for vertex in simplex]) for simplex in (tail, head))
            self.assertNear([point, [x + y for x, y in zip(point, vector)]], [start, end])

    def test_of_a_grid_pair_each_simplex_once(self):
        n = 5
        points, arrays = self.read("--arrows", f"grid:{n}")
        critical = self.critical(f"grid:{n}")
        self.succeed("relations", f"grid:{n}", "--relation", "TV", "--dump", "rows.txt")
        tetrahedra = [sorted(map(int, line.split(":")[1].split())) for line in (self.folder / "rows.txt").read_text().splitlines()[1:]]
        key = lambda point: tuple(round(12 * x) for x in point)  # barycentres of up to four whole numbers
        at = [{}, {}, {}, {}]
        for dimension in range(4):
            for simplex in {face for t in tetrahedra for face in itertools.combinations(t, dimension + 1)}:
                at[dimension][key(gale.barycentre([(v % n, v // n % n, v // n ** 2) for v in simplex]))] = simplex
        sizes = [len(simplices) for simplices in at]
        self.assertEqual((sizes[0], sizes[3]), (n ** 3, len(tetrahedra)))
        paired = []
        for point, vector, dimension in zip(points, arrays["Vector"], arrays["CellDimension"]):
            tail = at[dimension][key(point)]
            head = at[dimension + 1][key(x + y for x, y in zip(point, vector))]
            self.assertLess(set(tail), set(head))
            paired += [tail, head]
        self.assertEqual(len(paired), len(set(paired)))
        self.assertEqual([size - sum(len(p) == d + 1 for p in paired) for d, size in enumerate(sizes)], critical)


@gale.needs_vtk
class Files(GradientTest):
    def test_are_the_same_whatever_computed_them(self):
        files = set()
        for structure in [*gale.STRUCTURES, "task-parallel"]:
            for segments in (["--capacity", 1], ["--capacity", 7], ["--capacity", 1000000], ["--segments", "random:9"]):
                for threads in (1, 8):
                    self.succeed("discrete-gradient", "grid:16", "-o", "points.vtp", "--arrows", "arrows.vtp", "--structure", structure,
                                 *segments, "--threads", threads)
                    files.add(tuple((self.folder / name).read_bytes() for name in ("points.vtp", "arrows.vtp")))
            self.succeed("discrete-gradient", "grid:16", "-o", "points.vtp", "--arrows", "arrows.vtp", "--structure", structure, "--formulation", "cells")
            files.add(tuple((self.folder / name).read_bytes() for name in ("points.vtp", "arrows.vtp")))
        self.assertEqual(len(files), 1)
        self.assertEqual(self.names(), ["arrows.vtp", "points.vtp"])

    def test_refuses_what_it_cannot_write(self):
        command = ["discrete-gradient", "grid:4"]
        self.refuse(2, *command, "--arrows", "arrows.vtk", naming="--arrows arrows.vtk")
        self.refuse(2, *command, "-o", "one.vtp", "--arrows", "./one.vtp", naming="one.vtp")
        self.refuse(1, *command, "--arrows", "nowhere/arrows.vtp", naming="nowhere")
        self.refuse(1, "discrete-gradient", "missing.vtu", "-o", "nowhere/points.vtp", naming="nowhere")  # before the input is looked at
        self.assertEqual(self.names(), [])


@gale.needs_vtk
class Fields(GradientTest):
    def test_are_named(self):
        self.write("mesh.vtk", gale.vtk_mesh(TWO_POINTS, [[0, 1, 2, 3], [1, 2, 3, 4]], {"slope": ("float", range(5)), "hills": ("float", [0, 2, 3, 4, 1])}))
        self.assertEqual(self.critical("mesh.vtk"), [1, 0, 0, 0])
        self.assertEqual(self.critical("mesh.vtk", "--array", "hills"), [2, 1, 0, 0])
        self.refuse(1, "discrete-gradient", "mesh.vtk", "--array", "valleys", naming="valleys")

    def test_have_no_nan(self):
        self.write("mesh.vtk", gale.vtk_mesh(TWO_POINTS, [[0, 1, 2, 3]], {"height": ("float", [0, 1, math.nan, 3, 4])}))
        self.refuse(1, "discrete-gradient", "mesh.vtk", naming="vertex 2 ")


if __name__ == "__main__":
    unittest.main()
