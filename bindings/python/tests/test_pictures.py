"""Pictures, frames and PyVista's objects of results."""
import ctypes.util
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import gale
import numpy as np
from gale import _pictures
from test_results import results
from meshes import random_mesh

try:
    import matplotlib
    matplotlib.use("Agg")
except ImportError:
    matplotlib = None
try:
    import pandas
except ImportError:
    pandas = None
try:
    import pyvista
except ImportError:
    pyvista = None


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        points, tetrahedra, cls.field = random_mesh(1)
        cls.mesh = gale.Mesh(points, tetrahedra)
        cls.all = results(cls.mesh, cls.field)
        cls.critical, _, cls.gradient, cls.diagram, cls.complex, cls.lines, cls.walls, cls.tree, cls.simplified = cls.all


@unittest.skipIf(matplotlib is None, "there is no matplotlib")
class ByMatplotlib(Results):
    def tearDown(self):
        import matplotlib.pyplot as plt

        plt.close("all")

    def test_each_result_is_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            for one in self.all:
                file = Path(folder) / f"{type(one).__name__}.png"
                one.plot("matplotlib", file)
                self.assertEqual(file.read_bytes()[:4], b"\x89PNG")

    def test_without_pyvista_it_is_matplotlib_that_draws(self):
        with mock.patch.dict(sys.modules, {"pyvista": None}):
            axes = self.complex.plot()
            self.assertEqual(axes.name, "3d")
            with self.assertRaises(ImportError):
                self.complex.plot("pyvista")

    def test_legends_count_what_there_is(self):
        types = self.critical["CriticalType"]
        names = [text.get_text() for text in self.critical.plot("matplotlib").get_legend().get_texts()]
        kinds = ("minim", "1-saddle", "2-saddle", "maxim", "degenerate")
        expected = [(k, n) for k, n in enumerate(np.bincount(types)) if n]
        self.assertEqual(len(names), len(expected))
        for name, (kind, count) in zip(names, expected):
            self.assertTrue(name.startswith(f"{count} {kinds[kind]}"), name)
        dots = self.diagram.plot().collections
        self.assertEqual(sum(len(one.get_offsets()) for one in dots), len(self.diagram))
        lines = self.lines.plot("matplotlib").collections
        self.assertEqual([len(one._segments3d) for one in lines], [n for n in np.bincount(self.lines["SeparatrixType"]) if n])

    def test_draws_on_what_it_is_given(self):
        import matplotlib.pyplot as plt

        axes = plt.figure().add_subplot()
        self.assertIs(self.diagram.plot(axes), axes)
        self.assertIs(self.tree.plot(axes), axes)
        space = plt.figure().add_subplot(projection="3d")
        self.assertIs(self.complex.plot(space), space)
        for wrong in (axes, 3):
            with self.assertRaisesRegex(gale.Error, "3D axes"):
                self.complex.plot(wrong)
        for one, wrong in ((self.complex, "gnuplot"), (self.diagram, "pyvista"), (self.diagram, 3)):
            with self.assertRaisesRegex(gale.Error, repr(wrong)):
                one.plot(wrong)

    def test_surfaces_name_their_saddles(self):
        points = np.array([[x, y, 0] for y in range(6) for x in range(6)], float)
        a = np.array([6 * y + x for y in range(5) for x in range(5)])
        mesh = gale.Mesh(points, np.concatenate([np.stack([a, a + 1, a + 7], 1), np.stack([a, a + 7, a + 6], 1)]))
        complex = mesh.morse_smale(np.sin(3 * points[:, 0]) + np.cos(2 * points[:, 1]))
        names = [text.get_text().split(" ", 1)[1] for text in complex.plot("matplotlib").get_legend().get_texts()]
        self.assertIn("saddles", names)
        self.assertNotIn("2-saddles", names)
        self.assertNotIn("paths between saddles", names)

    def test_results_of_nothing_are_drawn(self):
        diagram = self.mesh.persistence_diagram(self.field, persistence=1e9)
        nothing = gale.Diagram(*(values[:0] for values in (diagram.type, diagram.birth, diagram.death, diagram.is_finite,
                                                           diagram.birth_vertex, diagram.death_vertex)))
        nothing.plot()
        gale.CriticalPoints(np.empty((0, 3)), {"CriticalType": np.empty(0, np.int8)}).plot("matplotlib")


class Trees(unittest.TestCase):
    def test_inner_nodes_are_in_the_middle_of_what_hangs_on_them(self):
        # 0 - 1, and 1 to 2 and 3
        columns = _pictures.tree_columns(np.array([0, 1, 1]), np.array([1, 2, 3]), np.array([0., 1, 2, 3]))
        np.testing.assert_array_equal(columns, [0.5, 0.5, 0, 1])
        # a contour tree: two minima, which meet in 2, and two maxima, where 3 splits
        columns = _pictures.tree_columns(np.array([0, 1, 2, 3, 3]), np.array([2, 2, 3, 4, 5]), np.arange(6.))
        self.assertEqual(len(set(columns[[1, 4, 5]])), 3)
        self.assertEqual(columns[3], columns[[4, 5]].mean())
        self.assertFalse(np.isnan(columns).any())

    def test_long_trees_and_several(self):
        n = 5000
        columns = _pictures.tree_columns(np.arange(n), np.arange(1, n + 1), np.arange(n + 1.))
        np.testing.assert_array_equal(columns, 0)
        columns = _pictures.tree_columns(np.array([0]), np.array([1]), np.array([0., 1, 2]))
        np.testing.assert_array_equal(columns, [0, 0, 1])


@unittest.skipIf(pandas is None, "there is no pandas")
class Frames(Results):
    def test_have_all_numbers(self):
        frame = self.critical.to_dataframe()
        self.assertEqual(list(frame), ["x", "y", "z", *self.critical.keys()])
        np.testing.assert_array_equal(frame[["x", "y", "z"]], self.critical.points)
        np.testing.assert_array_equal(frame["CriticalType"], self.critical["CriticalType"])
        frame = self.diagram.to_dataframe()
        np.testing.assert_array_equal(frame["persistence"], self.diagram.persistence)
        self.assertEqual(len(self.lines.to_dataframe()), len(self.lines))
        self.assertEqual(list(self.gradient.arrows.to_dataframe())[-3:], ["Vector_0", "Vector_1", "Vector_2"])
        self.assertEqual(set(self.complex.to_dataframe()), {"critical_points", "separatrices1", "manifolds", "separatrices2"})
        self.assertEqual(set(self.tree.to_dataframe()), {"nodes", "arcs", "segmentation"})
        self.assertEqual(len(self.tree.to_dataframe()["segmentation"]), self.mesh.vertices)
        np.testing.assert_array_equal(self.simplified.to_dataframe()["order"], self.simplified.order)


@unittest.skipIf(pyvista is None, "there is no pyvista")
class ByPyvista(Results):
    def test_objects_have_what_results_have(self):
        diagram = self.diagram.to_pyvista()
        self.assertEqual(diagram.n_cells, len(self.diagram))
        np.testing.assert_array_equal(diagram.cell_data["type"], self.diagram.type)
        np.testing.assert_array_equal(diagram.points[1::2, 1], self.diagram.death)
        blocks = self.complex.to_pyvista()
        self.assertEqual(blocks.keys(), ["critical_points", "separatrices1", "separatrices2"])
        self.assertEqual(blocks["separatrices1"].n_cells, len(self.lines))
        grid = self.simplified.to_pyvista(self.mesh)
        self.assertEqual((grid.n_points, grid.n_cells), (self.mesh.vertices, self.mesh.tetrahedra))
        np.testing.assert_array_equal(grid.point_data["values"], self.simplified.values)
        again = gale.Mesh.from_pyvista(grid)
        self.assertEqual(again.critical_points(self.field), self.critical)
        with self.assertRaisesRegex(gale.Error, "takes the mesh"):
            self.simplified.to_pyvista()

    @unittest.skipUnless(ctypes.util.find_library("X11"), "VTK ends the process where there is no X11")
    def test_draws(self):
        with tempfile.TemporaryDirectory() as folder:
            for one in (self.critical, self.complex, self.lines, self.walls):
                file = Path(folder) / "picture.png"
                plotter = one.plot(file=file)
                self.assertIsInstance(plotter, pyvista.Plotter)
                self.assertGreater(len(np.unique(pyvista.read(file).point_data.active_scalars.reshape(-1, 3), axis=0)), 20)
                plotter.close()
                file.unlink()


if __name__ == "__main__":
    unittest.main()
