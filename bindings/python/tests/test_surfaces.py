"""Meshes of triangles: from arrays, cells, PyVista and meshio."""
import pickle
import types
import unittest

import numpy as np

import gale

try:
    import pyvista
except ImportError:
    pyvista = None


def plane(side):
    """(points, triangles, field) of plane:side of the command."""
    y, x = np.divmod(np.arange(side * side), side)
    h = np.arange(side * side, dtype=np.uint32)
    for shift, factor in ((16, 0x7feb352d), (15, 0x846ca68b)):
        h = (h ^ (h >> np.uint32(shift))) * np.uint32(factor)
    h ^= h >> np.uint32(16)
    field = (np.sin(0.11 * x) * np.cos(0.13 * y) + np.sin(0.05 * x) + 0.05 * h / 2**32).astype(np.float32)
    a = np.arange(side * side).reshape(side, side)[:-1, :-1].ravel()
    triangles = np.stack([a, a + 1, a + side + 1, a, a + side, a + side + 1], axis=1).reshape(-1, 3)
    return np.stack([x, y, 0 * x], axis=1).astype(np.float64), triangles, field


class TriangleMeshes(unittest.TestCase):

    def setUp(self):
        self.points, self.triangles, self.field = plane(200)
        self.mesh = gale.Mesh(self.points, self.triangles)

    def test_they_have_a_dimension(self):
        self.assertEqual((self.mesh.dimension, self.mesh.triangles, self.mesh.tetrahedra), (2, len(self.triangles), 0))
        self.assertEqual(repr(self.mesh), f"gale.Mesh(40000 vertices, {len(self.triangles)} triangles)")

    def test_relations_are_among_vertices_edges_and_triangles(self):
        indptr, indices = self.mesh.relation("FV")
        np.testing.assert_array_equal(indices.reshape(-1, 3), np.sort(self.triangles, axis=1))
        edges = self.mesh.relation("EV")[1].reshape(-1, 2)
        expected = np.unique(np.concatenate([np.sort(self.triangles[:, pair], axis=1) for pair in ([0, 1], [0, 2], [1, 2])]),
                             axis=0)
        np.testing.assert_array_equal(edges, expected)
        self.assertEqual(np.diff(self.mesh.relation("VF")[0]).sum(), 3 * len(self.triangles))
        with self.assertRaisesRegex(gale.Error, "no relation TV"):
            self.mesh.relation("TV")

    def test_analyses(self):
        critical = self.mesh.critical_points(self.field)
        counts = np.bincount(critical["CriticalType"], minlength=5)
        simplices = self.mesh.critical_simplices(self.field)
        by_dimension = np.bincount(simplices["CellDimension"], minlength=3)
        self.assertEqual(by_dimension[0] - by_dimension[1] + by_dimension[2], 1)
        self.assertEqual(by_dimension[0], counts[0])
        diagram = self.mesh.persistence_diagram(self.field)
        finite = diagram.type[diagram.is_finite]
        self.assertEqual(np.count_nonzero(finite == 0), by_dimension[0] - 1)
        self.assertEqual(np.count_nonzero(finite == 1), by_dimension[2])
        complex_ = self.mesh.morse_smale(self.field)
        self.assertEqual(len(complex_.manifolds["DescendingManifold"]), len(self.points))
        tree = self.mesh.merge_tree(self.field)
        self.assertEqual(len(tree.arcs) + 1, len(tree.nodes))

    def test_they_are_pickled(self):
        copy = pickle.loads(pickle.dumps(self.mesh))
        np.testing.assert_array_equal(copy.relation("FV")[1], self.mesh.relation("FV")[1])

    def test_of_quads_and_polygons(self):
        mesh = gale.Mesh.from_cells(self.points[:5], [0, 1, 2, 3, 0, 3, 4, 2, 3, 4], [0, 4, 7, 10], [9, 5, 7])
        self.assertEqual((mesh.dimension, mesh.triangles), (2, 4))
        np.testing.assert_array_equal(mesh.cells, [0, 0, 1, 2])

    def test_of_meshio(self):
        block = types.SimpleNamespace(type="triangle", data=self.triangles)
        line = types.SimpleNamespace(type="line", data=np.array([[0, 1]]))
        with self.assertWarns(UserWarning):
            mesh = gale.Mesh.from_meshio(types.SimpleNamespace(points=self.points[:, :2], cells=[line, block]))
        self.assertEqual(mesh.triangles, len(self.triangles))
        np.testing.assert_array_equal(mesh.points, self.points)
        with self.assertRaisesRegex(gale.Error, "hexahedron27"):
            strange = types.SimpleNamespace(type="hexahedron27", data=self.triangles)
            gale.Mesh.from_meshio(types.SimpleNamespace(points=self.points, cells=[strange]))
        with self.assertRaisesRegex(gale.Error, "no mesh of meshio"):
            gale.Mesh.from_meshio(self.points)

    @unittest.skipIf(pyvista is None, "needs pyvista")
    def test_of_pyvista(self):
        faces = np.column_stack([np.full(len(self.triangles), 3), self.triangles]).ravel()
        surface = pyvista.PolyData(self.points, faces)
        self.assertEqual(gale.Mesh.from_pyvista(surface).triangles, len(self.triangles))
        self.assertEqual(gale.Mesh.from_pyvista(surface.strip()).triangles, len(self.triangles))
        sphere = gale.Mesh.from_pyvista(pyvista.Sphere())
        self.assertEqual(sphere.vertices - len(sphere.relation("EV")[0]) + 1 + sphere.triangles, 2)
        flat = pyvista.ImageData(dimensions=(5, 1, 7))
        self.assertEqual(gale.Mesh.from_pyvista(flat).triangles, 2 * 4 * 6)
        self.assertEqual(gale.Mesh.from_pyvista(flat.cast_to_structured_grid()).triangles, 2 * 4 * 6)
        with self.assertRaisesRegex(gale.Error, "no polygons"):
            gale.Mesh.from_pyvista(pyvista.PolyData(self.points))


if __name__ == "__main__":
    unittest.main()
