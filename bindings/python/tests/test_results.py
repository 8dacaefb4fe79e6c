"""What results and meshes are as Python's objects: equal, short, copied, sent."""
import copy
import multiprocessing
import pickle
import unittest

import gale
import numpy as np
from meshes import random_mesh


def results(mesh, field):
    found = mesh.morse_smale(field, separatrices2=True)
    return [mesh.critical_points(field), mesh.critical_simplices(field), mesh.discrete_gradient(field),
            mesh.persistence_diagram(field), found, found.separatrices1, found.separatrices2,
            mesh.merge_tree(field, arc_samples=2), mesh.simplify_field(field, "5%")]


def types_in_child(mesh, field):
    return mesh.critical_points(field)["CriticalType"]


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.points, cls.tetrahedra, cls.field = random_mesh(1)
        cls.mesh = gale.Mesh(cls.points, cls.tetrahedra)
        cls.all = results(cls.mesh, cls.field)

    def test_equal_where_all_is(self):
        again, other = results(self.mesh, self.field), results(self.mesh, -self.field)
        for one, same, different in zip(self.all, again, other):
            self.assertTrue(one == same and not one != same)
            self.assertTrue(one != different and not one == different)
            self.assertFalse(one == 3 or one == self.field.tolist() or one == {})
            with self.assertRaises(TypeError):
                hash(one)

    def test_short_in_words(self):
        for one in self.all:
            self.assertTrue(repr(one).startswith(type(one).__name__ + "("))
            self.assertLess(len(repr(one)), 900)
        self.assertRegex(repr(self.all[0]), r"^CriticalPoints\(\d+ points: field, CriticalType, IsOnBoundary, ttkV.*\)$")
        self.assertRegex(repr(self.all[3]), r"^Diagram\(\d+ pairs: \d+ of type 0, \d+ of type 1.*\)$")
        self.assertRegex(repr(self.all[5]), r"^Lines\(\d+ lines of \d+ points: SourceId, .*\)$")

    def test_tables_in_notebooks(self):
        for one in self.all:
            html = one._repr_html_()
            self.assertEqual(html.count("<table>"), html.count("</table>"))
            self.assertIn(f"<b>{type(one).__name__}</b>", html)
        critical = self.mesh.critical_points(self.field, name="<script>")
        html = critical._repr_html_()
        self.assertIn("&lt;script&gt;", html)
        self.assertNotIn("<script>", html)
        self.assertEqual(html.count("<tr>"), 1 + min(len(critical), 10) + (len(critical) > 10))

    def test_no_column_hides_another(self):
        points, cells, field = random_mesh(1)
        found = gale.Mesh(points, cells).critical_points(field, name="x")
        self.assertEqual(list(found._columns()), ["x, y, z", "x_", "CriticalType", "IsOnBoundary", "ttkVertexScalarField"])
        found.arrays["x_"] = found["CriticalType"]
        self.assertEqual(list(found._columns())[1:3], ["x__", "CriticalType"])
        self.assertIn("x_", found._columns())

    def test_infinite_values_are_not_drawn(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("there is no matplotlib")
        matplotlib.use("Agg")
        values = np.array(self.field, float)
        values[3] = np.inf
        self.mesh.simplify_field(values).plot()

    def test_names_lead_to_what_is_there(self):
        for one in self.all:
            self.assertEqual(list(one), list(one.keys()))
            for name in one.keys():
                self.assertIn(name, one)
                if isinstance(one, (gale.MorseSmaleComplex, gale.DiscreteGradient, gale.MergeTree, gale.SimplifiedField)):
                    self.assertIs(one[name], getattr(one, name))
                else:
                    self.assertEqual(len(one[name]), len(one))
            self.assertNotIn("missing", one)
        self.assertEqual((len(self.all[2]), len(self.all[4])), (2, 5))

    def test_flags_are_bool(self):
        for flags in (self.all[0]["IsOnBoundary"], self.all[1]["IsOnBoundary"], self.all[3].is_finite,
                      self.all[4].critical_points["IsOnBoundary"]):
            self.assertEqual(flags.dtype, np.bool_)
        on_surface = np.array([np.any((point < 0.5) | (point > 2.5)) for point in np.round(self.all[0].points)])
        np.testing.assert_array_equal(self.all[0]["IsOnBoundary"], on_surface)

    def test_pickled(self):
        for one in self.all:
            self.assertEqual(pickle.loads(pickle.dumps(one)), one)
            self.assertEqual(copy.deepcopy(one), one)

    def test_pickled_meshes_are_the_same(self):
        for points in (self.points, self.points.astype(np.float32)):
            mesh = gale.Mesh(points, self.tetrahedra, capacity=7)
            for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
                again = pickle.loads(pickle.dumps(mesh, protocol))
                np.testing.assert_array_equal(again.points, mesh.points)
                self.assertEqual((again.points.dtype, again.segments), (points.dtype, mesh.segments))
                for name in "VT", "EV", "FE", "TT":
                    for a, b in zip(again.relation(name), mesh.relation(name)):
                        np.testing.assert_array_equal(a, b)
                self.assertEqual(results(again, self.field), results(mesh, self.field))
        for again in (copy.copy(self.mesh), copy.deepcopy(self.mesh), copy.deepcopy({"mesh": self.mesh})["mesh"]):
            self.assertEqual(again.critical_points(self.field), self.all[0])

    def test_other_processes_take_meshes(self):
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            types = pool.apply(types_in_child, (self.mesh, self.field))
        np.testing.assert_array_equal(types, self.all[0]["CriticalType"])

    def test_pyvista_has_the_walls(self):
        try:
            import pyvista
        except ImportError:
            self.skipTest("there is no pyvista")
        if not hasattr(pyvista, "register_dataset_accessor"):
            self.skipTest("this pyvista has no accessors")
        grid = pyvista.UnstructuredGrid({10: self.tetrahedra}, self.points)
        grid["height"] = self.field
        self.assertEqual(len(grid.gale.morse_smale("height")), 3)
        walls = grid.gale.morse_smale("height", separatrices2=True)[3]
        self.assertEqual(walls.n_cells, len(self.all[6]))
        np.testing.assert_array_equal(walls.cell_data["SourceId"], self.all[6]["SourceId"])


if __name__ == "__main__":
    unittest.main()
