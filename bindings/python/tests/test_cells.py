"""Meshes of hexahedra, polyhedra and other cells."""
import itertools
import pathlib
import pickle
import tempfile
import unittest
import warnings
from pathlib import Path

import gale
import numpy as np


def hexahedra(n):
    """(connectivity, offsets, types) of a grid of n^3 points, x fastest."""
    first = [(z * n + y) * n + x for z, y, x in itertools.product(range(n - 1), repeat=3)]
    corners = np.array([0, 1, n + 1, n, n * n, n * n + 1, n * n + n + 1, n * n + n])
    connectivity = (np.array(first)[:, None] + corners).ravel()
    return connectivity, np.arange(0, len(connectivity) + 1, 8), np.full(len(first), 12)


def as_polyhedra(connectivity):
    """(connectivity, offsets, types) of hexahedra by their faces."""
    faces = [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]]
    streams = [[6, *itertools.chain.from_iterable([4, *cell[face]] for face in faces)] for cell in connectivity.reshape(-1, 8)]
    return np.array(streams).ravel(), np.arange(0, 31 * len(streams) + 1, 31), np.full(len(streams), 42)


class Cells(unittest.TestCase):
    n = 5

    def setUp(self):
        rng = np.random.default_rng(4)
        n = self.n
        self.points = np.array([(x, y, z) for z, y, x in itertools.product(range(n), repeat=3)], float)
        self.cells = hexahedra(n)
        self.field = rng.standard_normal(n ** 3)

    def test_hexahedra_are_as_their_tetrahedra(self):
        mesh = gale.Mesh.from_cells(self.points, *self.cells)
        tetrahedra = mesh.relation("TV")[1].reshape(-1, 4)
        self.assertEqual((mesh.vertices, mesh.tetrahedra), (self.n ** 3, 6 * (self.n - 1) ** 3))
        np.testing.assert_array_equal(mesh.cells, np.repeat(np.arange((self.n - 1) ** 3), 6))
        written = gale.Mesh(self.points, tetrahedra)
        np.testing.assert_array_equal(written.cells, np.arange(mesh.tetrahedra))
        self.assertEqual(mesh.critical_points(self.field), written.critical_points(self.field))
        edges = self.points[tetrahedra[:, 1:]] - self.points[tetrahedra[:, :1]]
        volumes = np.abs(np.linalg.det(edges)) / 6
        np.testing.assert_allclose(np.bincount(mesh.cells, volumes), 1)

    def test_polyhedra_are_as_hexahedra(self):
        expected = gale.Mesh.from_cells(self.points, *self.cells)
        found = gale.Mesh.from_cells(self.points, *as_polyhedra(self.cells[0]))
        for a, b in zip(found.relation("TV"), expected.relation("TV")):
            np.testing.assert_array_equal(a, b)

    def test_any_integers(self):
        expected = gale.Mesh.from_cells(self.points, *self.cells).relation("VT")
        for ids, offsets, types in ((np.int32, np.int32, np.uint8), (np.uint16, np.uint64, np.int64), (np.int64, np.int64, np.int8)):
            cells = [array.astype(dtype) for array, dtype in zip(self.cells, (ids, offsets, types))]
            for a, b in zip(gale.Mesh.from_cells(self.points, *cells).relation("VT"), expected):
                np.testing.assert_array_equal(a, b)

    def test_cells_stay_when_pickled(self):
        mesh = gale.Mesh.from_cells(self.points, *self.cells)
        again = pickle.loads(pickle.dumps(mesh))
        np.testing.assert_array_equal(again.cells, mesh.cells)
        for a, b in zip(again.relation("TV"), mesh.relation("TV")):
            np.testing.assert_array_equal(a, b)

    def test_lower_cells_are_left_out_with_a_warning(self):
        connectivity, offsets, types = self.cells
        more = np.concatenate([[0, 1, 2], connectivity]), np.concatenate([[0], offsets + 3]), np.concatenate([[5], types])
        with self.assertWarnsRegex(UserWarning, "left out 1 cells of a dimension below 3"):
            mesh = gale.Mesh.from_cells(self.points, *more)
        self.assertEqual(mesh.cells[0], 1)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            gale.Mesh.from_cells(self.points, *self.cells)

    def test_wrong_cells(self):
        connectivity, offsets, types = self.cells
        for naming, arguments in {
                "cell 0 names point 125 of 125": (np.where(np.arange(len(connectivity)) == 3, 125, connectivity), offsets, types),
                "cell 1 ends at 3 in a connectivity": (connectivity, np.concatenate([[0, 8, 3], offsets[3:]]), types),
                "there are 64 offsets for 64 cells": (connectivity, offsets[1:], types),
                "cell 0 has the unknown type 99": (connectivity, offsets, np.full(len(types), 99)),
                "one of the types is 300": (connectivity, offsets, np.full(len(types), 300)),
                "offsets of float64 are not integers": (connectivity, offsets.astype(float), types),
                "have 1, 2 and 1 dimensions": (connectivity, offsets[:, None], types),
                "whose faces aren't": (connectivity, offsets, np.full(len(types), 42)),
        }.items():
            with self.subTest(naming=naming), self.assertRaisesRegex(gale.Error, naming):
                gale.Mesh.from_cells(self.points, *arguments)

    def test_files(self):
        def array(kind, values, more=""):
            return f'<DataArray type="{kind}" {more} format="ascii">{" ".join(map(str, np.ravel(values)))}</DataArray>'

        if not gale._gale.reads_files:
            self.skipTest("there are no files")
        connectivity, offsets, types = self.cells
        text = (f'<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid><Piece '
                f'NumberOfPoints="{len(self.points)}" NumberOfCells="{len(types)}"><Points>'
                + array("Float64", self.points, 'NumberOfComponents="3"') + "</Points><Cells>"
                + array("Int32", connectivity, 'Name="connectivity"') + array("Int32", offsets[1:], 'Name="offsets"')
                + array("UInt8", types, 'Name="types"') + "</Cells></Piece></UnstructuredGrid></VTKFile>")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "hexahedra.vtu"
            path.write_text(text)
            with self.assertWarnsRegex(UserWarning, "split 64 hexahedra into 384 tetrahedra"):
                mesh, _ = gale.read(path)
            with self.assertRaisesRegex(gale.Error, "it has 64 hexahedra, and tetrahedra alone are wanted"):
                gale.read(path, cells="tetrahedra")
            with self.assertRaisesRegex(gale.Error, "neither 'any' nor 'simplices'"):
                gale.read(path, cells="hexahedra")
        expected = gale.Mesh.from_cells(self.points, *self.cells)
        np.testing.assert_array_equal(mesh.cells, expected.cells)
        self.assertEqual(mesh.critical_points(self.field), expected.critical_points(self.field))


class Images(unittest.TestCase):
    def test_cells_are_voxels_of_the_whole_image(self):
        field = np.arange(27.0)
        text = ('<VTKFile type="ImageData" version="0.1" byte_order="LittleEndian"><ImageData WholeExtent="0 2 0 2 0 2" Origin="0 0 0" '
                'Spacing="1 1 1"><Piece Extent="0 2 0 2 0 2"><PointData Scalars="f"><DataArray type="Float64" Name="f" format="ascii">'
                + " ".join(map(str, field)) + "</DataArray></PointData></Piece></ImageData></VTKFile>")
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "image.vti")
            file.write_text(text)
            whole, part = gale.read(file)[0], gale.read(file, above=0.5)[0]  # without the first point
        np.testing.assert_array_equal(whole.cells, np.repeat(np.arange(8), 6))
        np.testing.assert_array_equal(part.cells, np.repeat(np.arange(1, 8), 6))
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(part)).cells, part.cells)
        for mesh in (whole, part):
            corners = mesh.points[mesh.relation("TV")[1].reshape(-1, 4)]
            np.testing.assert_array_equal(corners.min(axis=1) @ [1, 2, 4], mesh.cells)


class Pyvista(unittest.TestCase):
    def setUp(self):
        try:
            import pyvista
        except ImportError:
            self.skipTest("there is no PyVista")
        self.pyvista = pyvista

    def test_no_tetrahedron_has_a_negative_volume(self):
        points = np.array([(x, y, z) for z, y, x in itertools.product(range(3), repeat=3)], float)
        grid = gale.Mesh.from_cells(points, *hexahedra(3)).to_pyvista()
        volumes = grid.compute_cell_sizes()["Volume"]
        np.testing.assert_allclose(volumes, 1 / 6)

    def test_other_cells_of_surfaces_are_counted(self):
        surface = self.pyvista.PolyData(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.0]]), verts=[1, 0], lines=[2, 0, 1],
                                        faces=[3, 0, 1, 2, 3, 1, 3, 2])
        with self.assertWarnsRegex(UserWarning, "left out 2 cells of a dimension below 2"):
            self.assertEqual(gale.Mesh.from_pyvista(surface).cells.tolist(), [2, 3])

    def test_what_has_no_points(self):
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStructuredGrid, vtkUnstructuredGrid

        unstructured, structured, surface, polygons = vtkUnstructuredGrid(), vtkStructuredGrid(), vtkPolyData(), vtkCellArray()
        unstructured.Allocate(1)
        unstructured.InsertNextCell(10, 4, [0, 1, 2, 3])
        structured.SetDimensions(3, 3, 3)
        polygons.InsertNextCell(3, [0, 1, 2])
        surface.SetPolys(polygons)
        for grid in (unstructured, structured, surface):
            with self.assertRaisesRegex(gale.Error, "the grid has no points"):
                gale.Mesh.from_pyvista(grid)
        with self.assertRaisesRegex(gale.Error, "the surface has no polygons"):
            gale.Mesh.from_pyvista(vtkPolyData())

    def test_coordinates_that_were_replaced(self):
        grid = self.pyvista.RectilinearGrid(*[np.arange(4.0)] * 3)
        grid["f"] = np.random.default_rng(6).standard_normal(64)
        if not hasattr(grid, "gale"):
            self.skipTest("this PyVista has no entry points")
        grid.gale.critical_points("f")
        grid.x = np.array([0, 0.1, 0.2, 3])
        self.assertEqual(grid.gale.mesh.points[:, 0].max(), 3)
        self.assertEqual(grid.gale.mesh.points[1, 0], 0.1)


class Grids(unittest.TestCase):
    def setUp(self):
        try:
            from vtkmodules import vtkCommonDataModel
        except ImportError:
            self.skipTest("there is no VTK")
        self.vtk = vtkCommonDataModel

    def test_structured_and_rectilinear_grids_and_images(self):
        from vtkmodules.util.numpy_support import numpy_to_vtk
        from vtkmodules.vtkCommonCore import vtkPoints

        image = self.vtk.vtkImageData()
        image.SetExtent(1, 3, 0, 3, 2, 6)
        image.SetSpacing(0.5, 2, 1)
        image.SetOrigin(3, 4, 5)
        found = gale.Mesh.from_pyvista(image)
        points = np.array([image.GetPoint(k) for k in range(image.GetNumberOfPoints())])
        np.testing.assert_allclose(found.points, points)
        self.assertEqual(found.tetrahedra, 6 * 2 * 3 * 4)
        np.testing.assert_array_equal(found.cells, np.repeat(np.arange(image.GetNumberOfCells()), 6))
        # What the tetrahedra give, written out.
        written = gale.Mesh(found.points, found.relation("TV")[1].reshape(-1, 4))
        field = np.random.default_rng(5).integers(0, 9, len(points)).astype(np.float32)
        self.assertEqual(found.critical_points(field), written.critical_points(field))
        one, other = found.morse_smale(field), written.morse_smale(field)
        for name, values in other.manifolds.items():
            np.testing.assert_array_equal(one.manifolds[name], values)

        rectilinear = self.vtk.vtkRectilinearGrid()
        rectilinear.SetDimensions(3, 4, 5)
        for axis, set_axis in enumerate((rectilinear.SetXCoordinates, rectilinear.SetYCoordinates, rectilinear.SetZCoordinates)):
            set_axis(numpy_to_vtk(np.unique(points[:, axis]), deep=True))
        structured = self.vtk.vtkStructuredGrid()
        structured.SetDimensions(3, 4, 5)
        places = vtkPoints()
        places.SetData(numpy_to_vtk(points, deep=True))
        structured.SetPoints(places)
        for grid in (rectilinear, structured):
            same = gale.Mesh.from_pyvista(grid)
            np.testing.assert_allclose(same.points, points)
            np.testing.assert_array_equal(same.relation("VT")[1], found.relation("VT")[1])
        image = self.vtk.vtkImageData()
        image.SetDimensions(3, 4, 1)
        self.assertEqual(gale.Mesh.from_pyvista(image).triangles, 12)
        image.SetDimensions(3, 1, 1)
        with self.assertRaisesRegex(gale.Error, "3 x 1 x 1 points has no cells of dimension 2 or 3"):
            gale.Mesh.from_pyvista(image)

    def test_polyhedra(self):
        from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints

        connectivity, _, _ = hexahedra(2)
        stream, offsets, types = as_polyhedra(connectivity)
        grid, points = self.vtk.vtkUnstructuredGrid(), vtkPoints()
        for z, y, x in itertools.product(range(2), repeat=3):
            points.InsertNextPoint(x, y, z)
        grid.SetPoints(points)
        faces = vtkIdList()
        for entry in stream:
            faces.InsertNextId(int(entry))
        tetrahedron = vtkIdList()
        for corner in (0, 1, 2, 4):
            tetrahedron.InsertNextId(corner)
        grid.InsertNextCell(10, tetrahedron)
        grid.InsertNextCell(42, faces)
        found = gale.Mesh.from_pyvista(grid)
        np.testing.assert_array_equal(found.cells, [0, 1, 1, 1, 1, 1, 1])


if __name__ == "__main__":
    unittest.main()
