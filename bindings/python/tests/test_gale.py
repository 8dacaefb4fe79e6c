"""The module as its users have it. Oracles: numpy on the input, and what topology says."""
import inspect
import itertools
import multiprocessing
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

import gale
import numpy as np
from meshes import random_mesh


def rows_of(indptr, indices):
    return [indices[a:b].tolist() for a, b in zip(indptr, indptr[1:])]


class Meshes(unittest.TestCase):
    def setUp(self):
        self.points, self.tetrahedra, self.field = random_mesh(1)
        self.mesh = gale.Mesh(self.points, self.tetrahedra)

    def test_sizes(self):
        self.assertEqual((self.mesh.vertices, self.mesh.tetrahedra), (len(self.points), len(self.tetrahedra)))
        np.testing.assert_array_equal(self.mesh.points, self.points)
        self.assertIn(f"{len(self.points)} vertices", repr(self.mesh))

    def test_any_types_and_layouts(self):
        expected = self.mesh.critical_points(self.field)
        for points, tetrahedra in ((self.points.astype(np.float32), self.tetrahedra.astype(np.int32)),
                                   (np.asfortranarray(self.points), self.tetrahedra.astype(np.uint16)),
                                   (self.points.tolist(), self.tetrahedra[::-1][::-1].astype(">i8"))):
            found = gale.Mesh(points, tetrahedra).critical_points(self.field)
            np.testing.assert_array_equal(found["ttkVertexScalarField"], expected["ttkVertexScalarField"])

    def test_input_may_change_afterwards(self):
        points, tetrahedra = self.points.copy(), self.tetrahedra.copy()
        mesh = gale.Mesh(points, tetrahedra)
        expected = mesh.critical_points(self.field)
        points[:], tetrahedra[:] = np.nan, -1
        np.testing.assert_array_equal(mesh.points, self.points)
        self.assertEqual(mesh.critical_points(self.field), expected)

    def test_bad_input(self):
        for points, tetrahedra, words in ((self.points[:, :2], self.tetrahedra, r"points has the shape \(64, 2\)"),
                                          (self.points, self.tetrahedra[:, :2], r"tetrahedra has the shape"),
                                          (self.points, self.tetrahedra + 64, "vertex"),
                                          (self.points, np.zeros((0, 4), int), "no tetrahedra|none"),
                                          (self.points * np.nan, self.tetrahedra, "nan|finite"),
                                          (self.points, self.tetrahedra.astype(str), "numbers"),
                                          (self.points, self.tetrahedra * 1j, "numbers")):
            with self.assertRaisesRegex(gale.Error, words):
                gale.Mesh(points, tetrahedra)
        for field, words in ((self.field[1:], "63"), (self.field.reshape(8, 8), "dimensions"),
                             (self.field * np.nan, "(?i)nan"), (self.field.astype(complex), "complex128"),
                             (self.field.astype(str), "<U")):
            with self.assertRaisesRegex(gale.Error, words):
                self.mesh.critical_points(field)
        for threads in (-1, 1025):
            with self.assertRaisesRegex(gale.Error, f"threads is {threads}, not 0 to 1024"):
                self.mesh.critical_points(self.field, threads=threads)
        with self.assertRaisesRegex(gale.Error, "'XY'"):
            self.mesh.relation("XY")
        with self.assertRaisesRegex(gale.Error, "the persistence 'x%' is neither a number nor a percentage"):
            self.mesh.morse_smale(self.field, persistence="x%")
        with self.assertRaisesRegex(gale.Error, "tetrahedra of float64 are not integers"):
            gale.Mesh(self.points, self.tetrahedra.astype(float))


class Relations(unittest.TestCase):
    def test_are_those_of_sets(self):
        points, tetrahedra, _ = random_mesh(2)
        self.check(points, tetrahedra)

    def test_of_vertices_with_many_neighbours(self):
        """A ring of 80 vertices around an edge: rows of 80, and more neighbours than a word has bits."""
        rng = np.random.default_rng(5)
        ids = rng.permutation(82)
        ring, hubs = ids[:80], np.broadcast_to(ids[80:], (80, 2))
        self.check(rng.random((82, 3)), np.column_stack([ring, np.roll(ring, 1), hubs]))

    def test_of_few_long_rows_among_short_ones(self):
        """A ring of 40 vertices around an edge, whose rows come first, in the middle or last; and vertices of no cell."""
        points = np.random.default_rng(6).random((48, 3))
        for hubs in ((0, 1), (20, 30), (46, 47)):
            ring = np.setdiff1d(np.arange(3, 48), hubs)[:40]
            pairs = np.column_stack([ring, np.roll(ring, 1), np.broadcast_to(hubs, (40, 2))])
            self.check(points, pairs, every=1)

    def check(self, points, tetrahedra, every=5):
        simplices = [
            sorted({tuple(sorted(c)) for cell in tetrahedra.tolist() for c in itertools.combinations(cell, d + 1)})
            for d in range(4)]
        simplices[0] = [(v,) for v in range(len(points))]
        simplices[3] = [tuple(sorted(cell)) for cell in tetrahedra.tolist()]
        for (a, x), (b, y) in itertools.product(enumerate("VEFT"), repeat=2):
            mesh = gale.Mesh(points, tetrahedra, capacity=7)  # which has enumerated nothing for another relation
            found = rows_of(*mesh.relation(x + y, threads=3))
            self.assertEqual(len(found), len(simplices[a]))
            for i in range(0, len(found), every):
                one = set(simplices[a][i])
                if a != b:
                    right = [j for j, other in enumerate(simplices[b]) if one <= set(other) or one >= set(other)]
                elif a == 0:
                    right = sorted({v for cell in tetrahedra.tolist() if i in cell for v in cell} - {i})
                else:
                    right = [j for j, other in enumerate(simplices[b]) if len(one & set(other)) == a]
                self.assertEqual(found[i], right, (x + y, i))


class Analyses(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh, arrays = gale.read("grid:20")
        cls.field = arrays["field"]

    def test_critical_points_by_numpy(self):
        found = self.mesh.critical_points(self.field)
        indptr, indices = self.mesh.relation("VV")
        order = np.lexsort((np.arange(len(self.field)), self.field)).argsort()
        neighbours = [order[indices[a:b]] for a, b in zip(indptr, indptr[1:])]
        types, vertices = found["CriticalType"], found["ttkVertexScalarField"]
        minima = [v for v, others in enumerate(neighbours) if np.all(others > order[v])]
        maxima = [v for v, others in enumerate(neighbours) if np.all(others < order[v])]
        self.assertEqual(vertices[types == 0].tolist(), minima)
        self.assertEqual(vertices[types == 3].tolist(), maxima)
        np.testing.assert_array_equal(found.points, self.mesh.points[vertices])
        np.testing.assert_array_equal(found["field"], self.field[vertices])

    def test_simplices_and_pairs_agree(self):
        critical = self.mesh.critical_simplices(self.field)
        counts = np.bincount(critical["CellDimension"], minlength=4)
        self.assertEqual(counts @ [1, -1, 1, -1], 1)  # a cube's Euler characteristic
        diagram = self.mesh.persistence_diagram(self.field)
        finite = diagram.is_finite
        self.assertEqual(2 * finite.sum() + (~finite).sum(), counts.sum())
        pairs = np.bincount(diagram.type[finite], minlength=3)
        self.assertEqual(counts.tolist(), [pairs[0] + 1, pairs[0] + pairs[1], pairs[1] + pairs[2], pairs[2]])
        self.assertTrue(np.all(diagram.persistence >= 0))
        np.testing.assert_array_equal(diagram.birth, self.field[diagram.birth_vertex])
        few = self.mesh.persistence_diagram(self.field, persistence="10%")
        self.assertEqual(len(few), np.count_nonzero(~finite | (diagram.persistence >= 0.1 * np.ptp(self.field))))

    def test_trees(self):
        critical = self.mesh.critical_points(self.field)
        for kind, extremum in ("join", 0), ("split", 3):
            tree = self.mesh.merge_tree(self.field, type=kind)
            leaves = tree.nodes["VertexId"][tree.nodes["CriticalType"] == extremum]
            self.assertTrue(np.all(np.isin(critical["ttkVertexScalarField"][critical["CriticalType"] == extremum], leaves)))
        tree = self.mesh.merge_tree(self.field, arc_samples=2)
        self.assertEqual(len(tree.arcs), len(tree.nodes) - 1)
        np.testing.assert_array_equal(tree.nodes["Scalar"], self.field[tree.nodes["VertexId"]])
        inside = np.bincount(np.delete(tree.segmentation["SegmentationId"], tree.nodes["VertexId"]), minlength=len(tree.arcs))
        np.testing.assert_array_equal(inside, tree.arcs["RegionSize"])
        with self.assertRaisesRegex(gale.Error, "oak"):
            self.mesh.merge_tree(self.field, type="oak")

    def test_trees_for_networkx(self):
        try:
            import networkx
        except ImportError:
            self.skipTest("needs networkx")
        tree = self.mesh.merge_tree(self.field)
        graph = tree.to_networkx()
        self.assertTrue(networkx.is_tree(graph))
        self.assertEqual(graph.number_of_nodes(), len(tree.nodes))

    def test_simplified_field(self):
        found = self.mesh.simplify_field(self.field, persistence="10%")
        self.assertEqual(sorted(found.order), list(range(self.mesh.vertices)))
        self.assertTrue(np.all(np.diff(found.values[np.argsort(found.order)]) >= 0))
        for field, order in ((found.order, None), (found.values, found.order)):
            left = self.mesh.merge_tree(field, type="join", order=order)
            self.assertEqual(np.count_nonzero(left.nodes["CriticalType"] == 0), found.minima)
            self.assertTrue(np.array_equal(left.nodes["Scalar"], field[left.nodes["VertexId"]]))
        by_numbers = self.mesh.persistence_diagram(found.values)
        self.assertGreater(len(by_numbers.birth), len(self.mesh.persistence_diagram(found.values, order=found.order).birth))

    def test_orders_that_contradict_the_values_count(self):
        back = np.argsort(np.argsort(-self.field, kind="stable"), kind="stable")
        with self.assertWarnsRegex(UserWarning, "'field_Order' orders the vertices, though it contradicts 'field'"):
            found = self.mesh.critical_points(self.field, order=back)
        self.assertTrue(np.array_equal(found["CriticalType"], self.mesh.critical_points(back)["CriticalType"]))

    def test_complex(self):
        whole = self.mesh.morse_smale(self.field)
        simple = self.mesh.morse_smale(self.field, persistence="10%")
        self.assertLess(len(simple.critical_points), len(whole.critical_points))
        for found in (whole, simple):
            dimension = found.critical_points["CellDimension"]
            self.assertEqual(np.bincount(dimension, minlength=4) @ [1, -1, 1, -1], 1)
            lines = found.separatrices1
            self.assertTrue(np.all(np.diff(lines.offsets) >= 2))
            self.assertLess(lines.connectivity.max(), len(lines.points))
            minima = found.critical_points["CellId"][dimension == 0]
            self.assertEqual(found.manifolds["DescendingManifold"].max() + 1, len(minima))
            self.assertEqual(len(found.manifolds["DescendingManifold"]), self.mesh.vertices)

    def test_same_whatever_the_threads_and_types(self):
        expected = self.mesh.critical_points(self.field)
        for threads, field in ((1, self.field), (7, self.field.astype(np.float64)), (2, np.asarray(self.field.tolist()))):
            found = self.mesh.critical_points(field, threads=threads)
            np.testing.assert_array_equal(found["CriticalType"], expected["CriticalType"])
        for dtype in (np.int8, np.uint16, np.int64, np.bool_, np.float16, ">f4"):
            self.mesh.critical_points((10 * self.field).astype(dtype))

    @unittest.skipUnless(gale._gale.reads_files, "this gale reads no files")
    def test_what_of_a_file_is_left_out_is_a_warning_at_the_caller(self):
        header = b"NRRD0004\ntype: float\ndimension: 4\nsizes: 3 3 3 2\nkinds: domain domain domain list\nendian: little\nencoding: raw\n\n"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "twice.nrrd")
            path.write_bytes(header + np.arange(54, dtype="<f4").tobytes())
            with self.assertWarnsRegex(UserWarning, "twice.nrrd: left out all but the first of 2") as warned:
                mesh, arrays = gale.read(path)
        self.assertEqual(warned.filename, __file__)
        self.assertEqual((mesh.vertices, *next(iter(arrays.values()))[:2]), (27, 0, 1))

    def test_segments_are_as_large_as_the_library_makes_them(self):
        for made_by in (gale.Mesh, gale.Mesh.from_pyvista, gale.read):
            self.assertEqual(inspect.signature(made_by).parameters["capacity"].default, gale._gale.default_capacity)

    def test_arrays_outlive_their_owners(self):
        mesh, arrays = gale.read("grid:9")
        values = mesh.morse_smale(arrays["field"]).separatrices1.connectivity
        expected = values.copy()
        del mesh, arrays
        np.testing.assert_array_equal(values, expected)

    def test_progress_and_threads_of_python(self):
        told = []
        self.mesh.critical_points(self.field, progress=lambda done, of: told.append((done, of)))
        self.assertEqual(told[-1], (self.mesh.segments, self.mesh.segments))
        results = {}

        def work(k):
            mesh = gale.Mesh(self.mesh.points, self.mesh.relation("TV")[1].reshape(-1, 4)) if k % 2 else self.mesh
            for _ in range(3):
                results[k] = mesh.morse_smale(self.field).critical_points.points

        threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for k in range(4):
            np.testing.assert_array_equal(results[k], results[0])

    def test_progress_may_compute(self):
        kinds = self.mesh.critical_points(self.field)["CriticalType"]
        found = []
        outer = self.mesh.critical_points(
            self.field, progress=lambda done, of: found.append(self.mesh.critical_points(self.field)["CriticalType"]))
        self.assertTrue(found)
        for inner in (*found, outer["CriticalType"]):
            np.testing.assert_array_equal(inner, kinds)
        for relation in ("TF", "FT", "VV", "EE"):
            expected, rows = self.mesh.relation(relation), []
            self.mesh.relation(relation, progress=lambda done, of: rows.append(self.mesh.relation(relation)))
            for inner in rows:
                np.testing.assert_array_equal(inner[1], expected[1])

    def test_errors_in_progress_come_through(self):
        def fail(done, of):
            raise KeyError("mine")

        with self.assertRaises(KeyError):
            self.mesh.critical_points(self.field, progress=fail)

    def test_to_pyvista(self):
        try:
            import pyvista
        except ImportError:
            self.skipTest("there is no pyvista")
        found = self.mesh.morse_smale(self.field, persistence="5%")
        points, lines = found.critical_points.to_pyvista(), found.separatrices1.to_pyvista()
        self.assertEqual((points.n_points, lines.n_lines), (len(found.critical_points), len(found.separatrices1)))
        tetrahedra = np.column_stack([np.full(self.mesh.tetrahedra, 4), rows_as_array(self.mesh)])
        grid = pyvista.UnstructuredGrid(tetrahedra.ravel(), np.full(self.mesh.tetrahedra, 10), self.mesh.points)
        again = gale.Mesh.from_pyvista(grid).critical_points(self.field)
        expected = self.mesh.critical_points(self.field)
        np.testing.assert_array_equal(again["CriticalType"], expected["CriticalType"])
        if not hasattr(pyvista, "register_dataset_accessor"):
            return
        grid["height"] = self.field
        found = grid.gale.critical_points("height")
        np.testing.assert_array_equal(found["CriticalType"], expected["CriticalType"])
        self.assertIs(grid.gale.mesh, grid.gale.mesh)
        points, lines, manifolds = grid.gale.morse_smale("height", persistence="5%")
        self.assertEqual(points.n_points, len(self.mesh.morse_smale(self.field, persistence="5%").critical_points))
        self.assertIn("DescendingManifold", manifolds.point_data)
        self.assertNotIn("DescendingManifold", grid.point_data)
        with self.assertRaisesRegex(gale.Error, "'width'.*height"):
            grid.gale.critical_points("width")
        before = grid.gale.mesh
        grid.points = grid.points * 2
        self.assertIsNot(grid.gale.mesh, before)


def rows_as_array(mesh):
    return mesh.relation("TV")[1].reshape(-1, 4)


def in_child(queue):
    try:
        gale.read("grid:4")
        queue.put("no error")
    except gale.Error as error:
        queue.put(str(error))


class Process(unittest.TestCase):
    def run_python(self, code, **options):
        return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, **options)

    def test_ends_in_silence_whatever_is_alive(self):
        begin = "import gale, threading, time\nmesh, arrays = gale.read('grid:30')\nfield = arrays['field']\n"
        daemon = ("def work():\n while True: mesh.morse_smale(field{})\n"
                  "threading.Thread(target=work, daemon=True).start()\ntime.sleep(0.3)\n")
        ends = {
            "results": "keep = mesh.morse_smale(field)",
            "cycles": "mesh.self = mesh; keep = [mesh.relation('VT')]; keep.append(keep); gale.Mesh.keep = keep",
            "a hook": "import atexit; atexit.register(lambda: mesh.critical_points(field))",
            "a thread": daemon.format(""),
            "threads": 3 * daemon.format(", progress=lambda done, of: time.sleep(0.01)"),
            "an exception": "import sys\nsys.stderr = None\nmesh.relation('VT', progress=lambda done, of: 1 / 0)",
        }
        for name, end in ends.items():
            with self.subTest(name):
                done = self.run_python(begin + end)
                self.assertEqual((done.returncode, done.stdout, done.stderr), (int(name == "an exception"), "", ""))

    def test_calls_after_the_end_are_refused(self):
        done = self.run_python("import gale; mesh, arrays = gale.read('grid:9')\n"
                               "class Late:\n def __del__(self): mesh.vertices\nlate = Late()")
        self.assertEqual((done.returncode, done.stdout), (0, ""))
        self.assertNotIn("Kokkos", done.stderr)

    def test_refuses_subinterpreters(self):
        done = self.run_python(
            "try: import _interpreters as interpreters\nexcept ImportError: import _xxsubinterpreters as interpreters\n"
            "import gale, sys\n"
            "one = interpreters.create()\n"
            "interpreters.run_string(one, f'import sys; sys.path[:] = {sys.path!r}\\ntry: import gale\\n'"
            "                             'except ImportError as error: print(error, flush=True)')\n"
            "interpreters.destroy(one)\nprint(gale.read('grid:4')[0].vertices)")
        words = "gale can't be imported in a subinterpreter: use it in the main one, or in a process of its own"
        self.assertEqual((done.returncode, done.stdout.splitlines(), done.stderr), (0, [words, "64"], ""))

    def test_what_others_write_meanwhile_breaks_nothing(self):
        done = self.run_python(
            "import gale, threading, time\nimport numpy as np\nfrom meshes import random_mesh\n"
            "points, tetrahedra, field = random_mesh(1, 24)\nright = tetrahedra[:, 3].copy()\n"
            "wrong, ended, kinds = np.full_like(right, 2**30), False, set()\n"
            "def write():\n"
            " while not ended:\n  tetrahedra[:, 3] = wrong; time.sleep(2e-4); tetrahedra[:, 3] = right; time.sleep(2e-3)\n"
            "thread = threading.Thread(target=write)\nthread.start()\n"
            "for _ in range(60):\n"
            " try: kinds.add(len(gale.Mesh(points, tetrahedra).critical_points(field)))\n"
            " except gale.Error as error: kinds.add(str(error)[:11])\n"
            "ended = True\nthread.join()\nprint(kinds <= {len(gale.Mesh(points, tetrahedra).critical_points(field)),"
            " 'tetrahedron'})", cwd=os.path.dirname(__file__))
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "True\n", ""))

    def test_what_others_write_to_a_field_meanwhile_ends_no_process(self):
        done = self.run_python(
            "import gale, threading, time\nimport numpy as np\nfrom meshes import random_mesh\n"
            "points, tetrahedra, field = random_mesh(1, 24)\nmesh, right, ended = gale.Mesh(points, tetrahedra), field.copy(), False\n"
            "def write():\n"
            " while not ended:\n  field[::7] = np.nan; time.sleep(1e-4); field[::7] = -right[::7]; field[::3] = right[::3]\n"
            "thread = threading.Thread(target=write)\nthread.start()\n"
            "for _ in range(25):\n"
            " for find in (lambda: mesh.morse_smale(field, persistence=0.2), lambda: mesh.persistence_diagram(field, persistence=0.1),\n"
            "              lambda: mesh.merge_tree(field, persistence=0.1), lambda: mesh.simplify_field(field, persistence=0.1)):\n"
            "  try: find()\n"
            "  except gale.Error: pass\n"
            "ended = True\nthread.join()", cwd=os.path.dirname(__file__))
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_refuses_a_forked_process(self):
        gale.read("grid:4")
        context = multiprocessing.get_context("fork")
        queue = context.Queue()
        child = context.Process(target=in_child, args=(queue,))
        child.start()
        self.assertIn("spawn", queue.get(timeout=60))
        child.join()

    def test_takes_a_forked_process_before_the_first_use(self):
        done = self.run_python("import gale, os\nchild = os.fork()\nif child == 0:\n"
                               " print(gale.read('grid:4')[0].vertices, flush=True)\n"
                               "else: os.waitpid(child, 0)")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "64\n", ""))

    def test_files_that_are_none(self):
        for path in ("missing.vtu", os.devnull, "grid:1"):
            with self.assertRaisesRegex(gale.Error, path):
                gale.read(path)


if __name__ == "__main__":
    unittest.main()
