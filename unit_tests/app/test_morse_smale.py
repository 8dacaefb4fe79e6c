"""gale morse-smale: the same complex whatever computed it; its files against the mesh' simplices and the field; its switches; what it refuses."""
import math
import os
import shutil
import struct
import subprocess
import unittest
from collections import Counter, defaultdict

import gale

GRID_64 = [134, 356, 263, 40]
KINDS = ["critical_points.vtp", "separatrices1.vtp", "separatrices2.vtp", "segmentation.vtu"]
DESCENDING, CONNECTOR, ASCENDING = 0, 1, 2


class ComplexTest(gale.CommandTest):
    def result(self, *arguments):
        result = self.report("morse-smale", *arguments)["result"]
        kept = result.pop("kept_below", None)  # of a simplification
        self.assertEqual(kept is not None, "--persistence" in arguments)
        self.assertEqual(list(result), ["critical", "euler", "separatrices", "manifolds"])
        self.assertEqual(list(result["separatrices"]), ["descending", "ascending", "saddle_connectors"])
        self.assertEqual(list(result["manifolds"]), ["ascending", "descending", "morse_smale"])
        c0, c1, c2, c3 = result["critical"]
        self.assertEqual(result["euler"], c0 - c1 + c2 - c3)
        return result

    def files(self, *arguments):
        """What the command wrote, by kind."""
        self.succeed("morse-smale", *arguments, "-o", "out")
        return {kind: gale.XmlFile(self.folder / f"out_{kind}") for kind in KINDS if (self.folder / f"out_{kind}").exists()}

    def simplices(self, mesh):
        """Vertices of all simplices of a mesh, by dimension and id."""
        rows = [None]
        for relation in ("EV", "FV", "TV"):
            self.succeed("relations", mesh, "--relation", relation, "--dump", "rows.txt")
            lines = (self.folder / "rows.txt").read_text().splitlines()[1:]
            rows.append([sorted(map(int, line.split(":")[1].split())) for line in lines])
        return rows


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
class Separatrices1(ComplexTest):
    N = 32

    def separatrices(self, file):
        """The points of each, by SeparatrixId."""
        points = defaultdict(list)
        for (begin, end), separatrix in zip(file.cells("Lines"), file.cell_arrays["SeparatrixId"]):
            self.assertEqual(points[separatrix][-1:] or [begin], [begin])
            points[separatrix] = (points[separatrix] or [begin]) + [end]
        self.assertEqual(list(points), list(range(len(points))))
        return list(points.values())

    def check(self, *arguments):
        files = self.files(f"grid:{self.N}", *arguments)
        critical, lines = files["critical_points.vtp"], files["separatrices1.vtp"]
        simplices = self.simplices(f"grid:{self.N}")
        simplices[0] = [[v] for v in range(self.N ** 3)]
        field = files["segmentation.vtu"].point_arrays["field"]
        rank = {v: i for i, v in enumerate(sorted(range(len(field)), key=lambda v: (field[v], v)))}
        arrays = critical.point_arrays
        on_boundary = dict(zip(zip(arrays["CellDimension"], arrays["CellId"]), arrays["IsOnBoundary"]))
        dimensions, ids, mask = (lines.point_arrays[name] for name in ("CellDimension", "CellId", "ttkMaskScalarField"))
        first_line = 0
        for points in self.separatrices(lines):
            of = {name: values[first_line] for name, values in lines.cell_arrays.items()}
            for name, values in lines.cell_arrays.items():
                self.assertEqual(len(set(values[first_line:first_line + len(points) - 1])), 1, name)
            first_line += len(points) - 1
            kind = of["SeparatrixType"]
            odd, even = {DESCENDING: (1, 0), CONNECTOR: (1, 2), ASCENDING: (2, 3)}[kind]
            self.assertEqual([dimensions[p] for p in points], [odd, even] * (len(points) // 2))
            self.assertEqual([mask[p] for p in points], [0] + [1] * (len(points) - 2) + [0])
            self.assertEqual((ids[points[0]], ids[points[-1]]), (of["SourceId"], of["DestinationId"]))
            ends = [(dimensions[p], ids[p]) for p in (points[0], points[-1])]
            self.assertEqual(of["NumberOfCriticalPointsOnBoundary"], sum(on_boundary[end] for end in ends))
            path = [simplices[dimensions[p]][ids[p]] for p in points]
            for a, b in zip(path, path[1:]):
                self.assertTrue(set(a) < set(b) or set(b) < set(a))
            ranks = [rank[v] for v in path[0] + path[-1]]
            values = [field[next(v for v in path[0] + path[-1] if rank[v] == r)] for r in (max(ranks), min(ranks))]
            self.assertEqual([of[f"SeparatrixFunction{name}"] for name in ("Maximum", "Minimum", "Difference")], values + [gale.to_float(values[0] - values[1])])
            for p, simplex in zip(points, path):
                corners = [(v % self.N, v // self.N % self.N, v // self.N ** 2) for v in simplex]
                self.assertLess(math.dist(lines.points[p], gale.incentre(*corners) if len(corners) == 3 else gale.barycentre(corners)), 1e-4)
            yield kind, [[rank[v] for v in simplex] for simplex in path]

    def test_follow_the_gradient(self):
        counts = Counter()
        for kind, path in self.check():
            counts[kind] += 1
            if kind == DESCENDING:
                vertices = [simplex[0] for simplex in path[1::2]]
                self.assertEqual(vertices, sorted(set(vertices), reverse=True))
            else:
                heights = [max(simplex) for simplex in path]
                self.assertEqual(heights, sorted(heights))
        self.assertEqual(counts[DESCENDING], 2 * 59)
        self.assertGreater(min(counts[kind] for kind in (DESCENDING, CONNECTOR, ASCENDING)), 0)

    def test_go_on_where_pairs_are_cancelled(self):
        self.assertGreater(len(list(self.check("--persistence", "1e-3"))), 0)

    def test_are_in_order(self):
        lines = self.files("grid:32")["separatrices1.vtp"].cell_arrays
        keys = []
        for kind, source, destination, separatrix in zip(*(lines[name] for name in ("SeparatrixType", "SourceId", "DestinationId", "SeparatrixId"))):
            place = [DESCENDING, ASCENDING, CONNECTOR].index(kind)
            keys.append((place, destination if kind == CONNECTOR else source, source if kind == CONNECTOR else 0, separatrix))
        self.assertEqual(keys, sorted(keys))

    def test_types_are_those_of_ttk(self):
        lines = self.files("grid:32")["separatrices1.vtp"]
        self.assertEqual(lines.types("PointData"), {"ttkMaskScalarField": "Int8", "CellDimension": "Int8", "CellId": "Int32"})
        self.assertEqual(lines.types("CellData"), {"SourceId": "Int32", "DestinationId": "Int32", "SeparatrixId": "Int32", "SeparatrixType": "Int8",
                                                   "SeparatrixFunctionMaximum": "Float32", "SeparatrixFunctionMinimum": "Float32",
                                                   "SeparatrixFunctionDifference": "Float32", "NumberOfCriticalPointsOnBoundary": "Int32"})

    def test_without_some_kinds(self):
        def kinds(*arguments):
            return set(self.files("grid:32", *arguments)["separatrices1.vtp"].cell_arrays["SeparatrixType"])

        self.assertEqual(kinds("--no-descending-separatrices"), {CONNECTOR, ASCENDING})
        self.assertEqual(kinds("--no-ascending-separatrices", "--separatrices2"), {DESCENDING, CONNECTOR})
        self.assertEqual(kinds("--no-saddle-connectors", "--separatrices2", "--persistence", "1e-3"), {DESCENDING, ASCENDING})


@gale.needs_vtk
class Separatrices2(ComplexTest):
    N = 32

    def test_are_walls_of_saddles(self):
        files = self.files(f"grid:{self.N}", "--separatrices2")
        walls, arrays = files["separatrices2.vtp"], files["critical_points.vtp"].point_arrays
        saddles = {d: [cell for cell, of in zip(arrays["CellId"], arrays["CellDimension"]) if of == d] for d in (1, 2)}
        simplices = self.simplices(f"grid:{self.N}")
        triangles = set(map(tuple, simplices[2]))
        polygons, of = walls.cells("Polys"), walls.cell_arrays
        vertex = lambda point: round(point[0] + self.N * point[1] + self.N ** 2 * point[2])
        of_kind, sources, seen = {1: set(), 2: set()}, {1: [], 2: []}, set()
        for polygon, kind, source, wall in zip(polygons, of["SeparatrixType"], of["SourceId"], of["SeparatrixId"]):
            of_kind[kind].update(polygon)
            if kind == 2:
                self.assertIn(tuple(sorted(vertex(walls.points[p]) for p in polygon)), triangles)
                if wall not in seen:
                    self.assertEqual(sorted(vertex(walls.points[p]) for p in polygon), simplices[2][source])
            else:
                self.assertGreaterEqual(len(set(polygon)), 3)
            if wall not in seen:
                sources[kind].append(source)
            seen.add(wall)
        self.assertEqual(sources[2], saddles[2])
        self.assertEqual(sources[1], [edge for edge in saddles[1] if edge in set(sources[1])])
        self.assertFalse(of_kind[1] & of_kind[2])
        self.assertEqual(len(of_kind[1] | of_kind[2]), len(walls.points))
        for kind in (1, 2):
            self.assertEqual(len({walls.points[p] for p in of_kind[kind]}), len(of_kind[kind]))

    def test_say_between_which_values_they_are(self):
        files = self.files("grid:32", "--separatrices2")
        field, arrays, lines = files["segmentation.vtu"].point_arrays["field"], files["critical_points.vtp"].point_arrays, files["separatrices1.vtp"].cell_arrays
        highest = {(d, cell): field[v] for d, cell, v in zip(arrays["CellDimension"], arrays["CellId"], arrays["ttkVertexScalarField"])}
        on_boundary = dict(zip(zip(arrays["CellDimension"], arrays["CellId"]), arrays["IsOnBoundary"]))
        connected = defaultdict(set)
        for kind, source, destination in zip(lines["SeparatrixType"], lines["SourceId"], lines["DestinationId"]):
            if kind == CONNECTOR:
                connected[1, source].add((2, destination))
                connected[2, destination].add((1, source))
        walls = files["separatrices2.vtp"].cell_arrays
        names = ("SeparatrixType", "SourceId", "SeparatrixFunctionMaximum", "SeparatrixFunctionMinimum", "SeparatrixFunctionDifference",
                 "NumberOfCriticalPointsOnBoundary")
        some = 0
        for kind, source, maximum, minimum, difference, count in set(zip(*(walls[name] for name in names))):
            self.assertEqual(difference, gale.to_float(maximum - minimum))
            met = connected[kind, source]
            self.assertEqual(count, sum(on_boundary[saddle] for saddle in {(kind, source), *met}))
            if kind == 2:
                self.assertEqual(maximum, highest[2, source])
            elif met:
                self.assertEqual(maximum, max(highest[saddle] for saddle in met))
                some += 1
        self.assertGreater(some, 0)

    def test_are_written_on_request_alone(self):
        self.assertNotIn("separatrices2.vtp", self.files("grid:8"))


@gale.needs_vtk
class Segmentation(ComplexTest):
    def test_labels_each_vertex(self):
        for persistence in ([], ["--persistence", "3%"]):
            with self.subTest(persistence=persistence):
                files = self.files("grid:32", *persistence)
                labels, critical = files["segmentation.vtu"].point_arrays, files["critical_points.vtp"].point_arrays
                up, down, both = (labels[f"{kind}Manifold"] for kind in ("Ascending", "Descending", "MorseSmale"))
                dimensions, vertices, sizes = (critical[name] for name in ("CellDimension", "ttkVertexScalarField", "ManifoldSize"))
                minima = [v for v, d in zip(vertices, dimensions) if d == 0]
                self.assertEqual([down[v] for v in minima], list(range(len(minima))))
                self.assertEqual([size for size, d in zip(sizes, dimensions) if d == 0], [Counter(down)[i] for i in range(len(minima))])
                self.assertEqual([size for size, d in zip(sizes, dimensions) if d == 3], [Counter(up)[i] for i in range(dimensions.count(3))])
                self.assertEqual({size for size, d in zip(sizes, dimensions) if d in (1, 2)}, {0})
                self.assertEqual((min(up), min(down)), (-1, 0))
                pairs = set(zip(up, down, both))
                self.assertEqual({pair[2] for pair in pairs if pair[0] == -1}, {-1})
                inside = [pair for pair in pairs if pair[0] != -1]
                self.assertEqual(sorted(pair[2] for pair in inside), list(range(len({pair[:2] for pair in inside}))))

    def test_without_parts(self):
        names = lambda *arguments: [sorted(self.files("grid:16", *arguments)["segmentation.vtu"].point_arrays), self.sizes()]
        self.assertEqual(names("--no-ascending-segmentation")[0], ["DescendingManifold", "field"])
        self.assertEqual(names("--no-descending-segmentation")[0], ["AscendingManifold", "field"])

    def sizes(self):
        return gale.XmlFile(self.folder / "out_critical_points.vtp").point_arrays["ManifoldSize"]

    def test_has_the_mesh_as_it_was(self):
        self.succeed("generate", "grid:6", "-o", "mesh.vtu")
        mesh, with_labels = gale.XmlFile(self.folder / "mesh.vtu"), self.files("grid:6")["segmentation.vtu"]
        self.assertEqual((mesh.points, mesh.cells("Cells")), (with_labels.points, with_labels.cells("Cells")))
        self.assertEqual(mesh.point_arrays["field"], with_labels.point_arrays["field"])


@gale.needs_vtk
class Files(ComplexTest):
    def test_are_the_same_whatever_computed_them(self):
        structures = [*gale.STRUCTURES, "task-parallel"]
        ways = [["--structure", structure, "--threads", threads] for structure in structures for threads in (1, 2, 8)]
        ways += [["--structure", structure, *segments] for structure in structures
                 for segments in (["--capacity", 7], ["--capacity", 100], ["--segments", "random:50"])]
        for more in ([], ["--persistence", "1e-2"]):
            files = set()
            for way in ways:
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


class Pictures(ComplexTest):
    def draw(self, display, *arguments):
        """Runs the command with --render, with or without a display."""
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        return subprocess.run([*(["xvfb-run", "--auto-servernum"] if display else []), gale.GALE, "morse-smale", *arguments, "--render", "picture.png"],
                              cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300)

    @gale.needs_vtk
    @unittest.skipUnless(shutil.which("xvfb-run"), "there is no xvfb-run")
    def test_are_drawn_on_a_display_that_no_one_sees(self):
        for arguments in (["--persistence", "1%"], ["--no-descending-segmentation", "--no-descending-separatrices"],
                          ["--no-descending-segmentation", "--no-ascending-segmentation", "--no-descending-separatrices", "--no-ascending-separatrices", "--no-saddle-connectors"]):
            with self.subTest(arguments=arguments):
                run = self.draw(True, "grid:24", *arguments)
                if "rendering modules" in run.stderr:
                    self.skipTest("this VTK does not draw")
                self.assertEqual((run.returncode, run.stderr), (0, ""))
                self.assertEqual(self.names(), ["picture.png"])
                content = (self.folder / "picture.png").read_bytes()
                self.assertEqual((content[:8], struct.unpack(">II", content[16:24])), (b"\x89PNG\r\n\x1a\n", (1200, 800)))
                self.assertGreater(len(content), 20000)  # a white one takes less

    @gale.needs_vtk
    @unittest.skipUnless(shutil.which("xvfb-run"), "there is no xvfb-run")
    def test_of_a_mesh_too_small_to_be_cut(self):
        self.write("mesh.vtk", gale.vtk_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [[0, 1, 2, 3]], {"height": ("float", [0, 1, 2, math.inf])}))
        run = self.draw(True, "mesh.vtk")
        if "rendering modules" in run.stderr:
            self.skipTest("this VTK does not draw")
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_are_refused_where_they_cannot_be(self):
        run = self.draw(False, "missing.vtu")
        if "missing.vtu" not in run.stderr:  # this VTK draws without a display
            self.assertEqual(run.returncode, 1)
            self.assertRegex(run.stderr, r"\Agale: [^\n]*--render[^\n]*\n\Z")
        self.refuse(2, "morse-smale", "grid:4", "--render", "picture.jpg", naming="picture.jpg")
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
