"""gale morse-smale: its lines, walls and labels against the mesh's simplices and the field."""
import math
import unittest
from collections import Counter, defaultdict

import gale
from morse_smale import ComplexTest

DESCENDING, CONNECTOR, ASCENDING = 0, 1, 2


class GeometryTest(ComplexTest):
    def simplices(self, mesh):
        """Vertices of all simplices of a mesh, by dimension and id."""
        rows = [None]
        for relation in ("EV", "FV", "TV"):
            self.succeed("relations", mesh, "--relation", relation, "--dump", "rows.txt")
            lines = (self.folder / "rows.txt").read_text().splitlines()[1:]
            rows.append([sorted(map(int, line.split(":")[1].split())) for line in lines])
        return rows


@gale.needs_vtk
class Separatrices1(GeometryTest):
    N = 32

    def separatrices(self, file):
        """The points of each, by SeparatrixId, as far as they are told."""
        points = file.cells("Lines")
        self.assertEqual(list(file.cell_arrays["SeparatrixId"]), list(range(len(points))))
        return [list(line) for line in points]

    def rest(self, told, kind, destination, simplex):
        """What follows a simplex on an earlier separatrix of the same kind and destination."""
        self.assertIn((kind, destination, simplex), told)
        points, place = told[kind, destination, simplex]
        return points[place:]

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
        told = {}  # where else a separatrix goes on that is told as far as it meets an earlier one
        for separatrix, points in enumerate(self.separatrices(lines)):
            of = {name: values[separatrix] for name, values in lines.cell_arrays.items()}
            kind, destination = of["SeparatrixType"], of["DestinationId"]
            if mask[points[-1]] != 0:
                points[-1:] = self.rest(told, kind, destination, ids[points[-1]])
            for place in range(1, len(points), 2):
                told.setdefault((kind, destination, ids[points[place]]), (points, place))
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
        self.assertGreater(len(list(self.check("--persistence", "10%", "--extrema-only"))), 0)

    def test_have_points_in_common(self):
        lines = self.files("grid:32")["separatrices1.vtp"]
        dimensions, ids = (lines.point_arrays[name] for name in ("CellDimension", "CellId"))
        by_kind = defaultdict(set)
        for kind, points in zip(lines.cell_arrays["SeparatrixType"], self.separatrices(lines)):
            by_kind[kind].update(points)
        self.assertEqual(sum(map(len, by_kind.values())), len(lines.points), "a point is of one kind")
        for points in by_kind.values():
            self.assertEqual(len({(dimensions[p], ids[p]) for p in points}), len(points), "a simplex has one point")

    def test_are_told_once_where_pairs_are_cancelled(self):
        lines = self.files("grid:32", "--persistence", "10%", "--extrema-only")["separatrices1.vtp"]
        dimensions, ids, mask = (lines.point_arrays[name] for name in ("CellDimension", "CellId", "ttkMaskScalarField"))
        separatrices = self.separatrices(lines)
        inside = Counter((dimensions[p], ids[p]) for points in separatrices for p in points if mask[p] != 0)
        joints = Counter((dimensions[points[-1]], ids[points[-1]]) for points in separatrices if mask[points[-1]] != 0)
        self.assertGreater(len(joints), 0)
        for simplex in inside:
            if simplex[0] in (0, 3):  # of extrema: connectors pass the same triangles as ascending ones
                self.assertLessEqual(inside[simplex] - joints[simplex], 1, simplex)

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
class Separatrices2(GeometryTest):
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
class Segmentation(GeometryTest):
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


if __name__ == "__main__":
    unittest.main()
