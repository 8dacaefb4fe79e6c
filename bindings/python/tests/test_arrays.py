"""Arrays that aren't numpy's, and matrices of scipy's."""
import unittest

import gale
import numpy as np
from meshes import random_mesh


class DLPack:
    """An array that others know by DLPack alone; `device` is what it says of where it is."""

    def __init__(self, array, device=(1, 0)):
        self.array, self.device = array, device

    def __dlpack_device__(self):
        return self.device

    def __dlpack__(self, **options):
        return self.array.__dlpack__(**options)


class OnDevice:
    """What numba has: an array on a CUDA device, by the array interface of such. Nothing may read it here."""

    def __init__(self, array, **changes):
        self.__cuda_array_interface__ = {"shape": array.shape, "typestr": array.dtype.str, "data": (0xdead0000, True),
                                         "strides": None, "version": 3, **changes}


class Arrays(unittest.TestCase):
    def setUp(self):
        self.points, self.tetrahedra, self.field = random_mesh(1)
        self.expected = gale.Mesh(self.points, self.tetrahedra).critical_points(self.field)

    def same(self, mesh, field):
        found = mesh.critical_points(field)
        for name, values in self.expected.arrays.items():
            np.testing.assert_array_equal(found[name], values)

    def test_dlpack(self):
        mesh = gale.Mesh(DLPack(self.points), DLPack(self.tetrahedra))
        self.same(mesh, DLPack(self.field))
        self.same(gale.Mesh(DLPack(np.asfortranarray(self.points)), DLPack(self.tetrahedra.astype(np.int16))),
                  DLPack(np.repeat(self.field, 2)[::2]))

    def test_buffers_and_interfaces(self):
        class Interface:
            def __init__(self, array):
                self.array, self.__array_interface__ = array, array.__array_interface__

        self.same(gale.Mesh(Interface(self.points), memoryview(self.tetrahedra)), Interface(self.field))

    def test_arrays_that_cannot_be_written(self):
        for array in (self.points, self.tetrahedra, self.field):
            array.setflags(write=False)
        self.same(gale.Mesh(self.points, self.tetrahedra), self.field)

    @unittest.skipIf(gale._gale.has_cuda, "this gale reads them: test_device.py")
    def test_devices_are_refused_in_words(self):
        without = "is in the memory of a CUDA device, and this gale was built without CUDA: copy it to the host first"
        with self.assertRaisesRegex(gale.Error, f"^points {without}$"):
            gale.Mesh(OnDevice(self.points), self.tetrahedra)
        with self.assertRaisesRegex(gale.Error, f"^tetrahedra {without}$"):
            gale.Mesh(self.points, OnDevice(self.tetrahedra))
        with self.assertRaisesRegex(gale.Error, f"^the field {without}$"):
            gale.Mesh(self.points, self.tetrahedra).critical_points(OnDevice(self.field))
        for wrong, words in ((OnDevice(self.points, strides=(8, 512)), "don't follow each other"),
                             (OnDevice(self.points, typestr=">f8"), ">f8"), (OnDevice(self.points, typestr="<c8"), "<c8")):
            with self.assertRaisesRegex(gale.Error, words):
                gale.Mesh(wrong, self.tetrahedra)
        with self.assertRaisesRegex(gale.Error, r"points has the shape \(64\)"):
            gale.Mesh(OnDevice(self.field), self.tetrahedra)

    @unittest.skipIf(gale._gale.has_cuda, "this gale reads them: test_device.py")
    def test_contiguous_strides_on_a_device_are_no_error_of_layout(self):
        with self.assertRaisesRegex(gale.Error, "built without CUDA"):
            gale.Mesh(OnDevice(self.points, strides=(24, 8)), self.tetrahedra)


class Matrices(unittest.TestCase):
    def setUp(self):
        try:
            import scipy.sparse
        except ImportError:
            self.skipTest("there is no scipy")
        self.mesh = gale.Mesh(*random_mesh(2)[:2])

    def test_are_the_relations(self):
        counts = {letter: len(self.mesh.relation(letter + "T")[0]) - 1 if letter != "T" else self.mesh.tetrahedra
                  for letter in "VEFT"}
        self.assertEqual(counts["V"] - counts["E"] + counts["F"] - counts["T"], 1)
        for a in "VEFT":
            for b in "VEFT":
                matrix, (indptr, indices) = self.mesh.relation_matrix(a + b), self.mesh.relation(a + b)
                self.assertEqual(matrix.shape, (counts[a], counts[b]))
                np.testing.assert_array_equal(matrix.indptr, indptr)
                np.testing.assert_array_equal(matrix.indices, indices)
                matrix.check_format()

    def test_products_are_what_they_should_be(self):
        of_tetrahedra = self.mesh.relation_matrix("TV")
        self.assertEqual((of_tetrahedra.T != self.mesh.relation_matrix("VT")).nnz, 0)
        shared = of_tetrahedra @ of_tetrahedra.T  # how many vertices two tetrahedra share
        self.assertEqual(((shared == 3).astype(int) != self.mesh.relation_matrix("TT")).nnz, 0)


class Grids(unittest.TestCase):
    """vtkUnstructuredGrids, of Debian's VTK or PyVista's, whichever is there."""

    def setUp(self):
        try:
            import vtkmodules.vtkCommonDataModel
        except ImportError:
            self.skipTest("there is no VTK for Python")
        self.points, self.tetrahedra, self.field = random_mesh(3)

    def grid(self, tetrahedra, cell_type=10):
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid

        grid, cells, points = vtkUnstructuredGrid(), vtkCellArray(), vtkPoints()
        points.SetData(numpy_to_vtk(self.points, deep=True))
        cells.SetData(tetrahedra.shape[1], numpy_to_vtkIdTypeArray(tetrahedra.ravel().astype(np.int64), deep=True))
        grid.SetPoints(points)
        grid.SetCells(cell_type, cells)
        return grid

    def test_cells_of_any_storage(self):
        expected = gale.Mesh(self.points, self.tetrahedra).relation("VT")
        grid = self.grid(self.tetrahedra)
        stores = [store for store in ("ConvertTo64BitStorage", "ConvertTo32BitStorage", "ConvertToFixedSize32BitStorage",
                                      "ConvertToFixedSize64BitStorage") if hasattr(grid.GetCells(), store)]
        self.assertGreaterEqual(len(stores), 2)
        for store in stores:
            getattr(grid.GetCells(), store)()
            found = gale.Mesh.from_pyvista(grid).relation("VT")
            for a, b in zip(found, expected):
                np.testing.assert_array_equal(a, b, store)

    def test_refuses_other_cells(self):
        with self.assertRaisesRegex(gale.Error, "no tetrahedra"):
            gale.Mesh.from_pyvista(self.grid(self.tetrahedra[:, :2], 3))
        with self.assertRaisesRegex(gale.Error, "cell 0 is a vtkQuadraticHexahedron"):
            gale.Mesh.from_pyvista(self.grid(np.zeros((1, 20), int), 25))
        with self.assertRaisesRegex(gale.Error, "no cells"):
            gale.Mesh.from_pyvista(self.grid(self.tetrahedra[:0]))


if __name__ == "__main__":
    unittest.main()
