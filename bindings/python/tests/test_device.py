"""Arrays in a device's memory: for a GALE with CUDA on a machine that has a device; skipped elsewhere.

The memory is had from the CUDA runtime itself (libcudart), so that no package is needed for it."""
import ctypes
import ctypes.util
import unittest

import gale
import numpy as np
from meshes import random_mesh


def cuda_runtime():
    """The CUDA runtime, if this GALE has CUDA and there is a device; else None."""
    if not gale._gale.has_cuda:
        return None
    for name in (ctypes.util.find_library("cudart"), "libcudart.so", "libcudart.so.13", "libcudart.so.12"):
        try:
            runtime = ctypes.CDLL(name) if name else None
        except OSError:
            continue
        count = ctypes.c_int(0)
        if runtime and runtime.cudaGetDeviceCount(ctypes.byref(count)) == 0 and count.value > 0:
            return runtime
    return None


class OnDevice:
    """A copy of an array in the device's memory, by the array interface of such."""

    def __init__(self, runtime, array):
        array = np.ascontiguousarray(array)
        self.runtime, self.shape, self.dtype, self.nbytes = runtime, array.shape, array.dtype, array.nbytes
        self.pointer = ctypes.c_void_p()
        self.check(runtime.cudaMalloc(ctypes.byref(self.pointer), ctypes.c_size_t(array.nbytes)))
        self.copy(self.pointer, ctypes.c_void_p(array.ctypes.data), 1)

    @property
    def __cuda_array_interface__(self):
        return {"shape": self.shape, "typestr": self.dtype.str, "data": (self.pointer.value, False), "strides": None, "version": 3}

    def on_host(self):
        array = np.empty(self.shape, self.dtype)
        self.copy(ctypes.c_void_p(array.ctypes.data), self.pointer, 2)
        return array

    def copy(self, to, source, kind):
        self.check(self.runtime.cudaMemcpy(to, source, ctypes.c_size_t(self.nbytes), kind))

    def check(self, code):
        if code != 0:
            raise RuntimeError(f"the CUDA runtime says {code}")

    def __del__(self):
        if self.pointer:
            self.runtime.cudaFree(self.pointer)


class Device(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.runtime = cuda_runtime()
        if cls.runtime is None:
            raise unittest.SkipTest("this gale has no CUDA, or there is no device")

    def setUp(self):
        self.points, self.tetrahedra, self.field = random_mesh(3, 8)
        self.mesh = gale.Mesh(self.points, self.tetrahedra)

    def put(self, array):
        return OnDevice(self.runtime, array)

    def test_results_are_those_of_arrays_on_the_host(self):
        expected = self.mesh.critical_points(self.field)
        for coordinate, index, value in ((np.float64, np.int64, np.float64), (np.float32, np.int32, np.float32),
                                         (np.float64, np.int32, np.int16)):
            field = (1000 * self.field).astype(value) if value == np.int16 else self.field.astype(value)
            points, tetrahedra = self.points.astype(coordinate), self.tetrahedra.astype(index)
            expected = gale.Mesh(points, tetrahedra).critical_points(field)
            mesh = gale.Mesh(self.put(points), self.put(tetrahedra))
            for given in (field, self.put(field)):
                found = mesh.critical_points(given)
                np.testing.assert_array_equal(found.points, expected.points)
                for name, values in expected.arrays.items():
                    np.testing.assert_array_equal(found[name], values)
            np.testing.assert_array_equal(mesh.points, points)

    def test_host_and_device_may_be_mixed(self):
        expected = self.mesh.relation("EF")
        for points, tetrahedra in ((self.put(self.points), self.tetrahedra), (self.points, self.put(self.tetrahedra))):
            for found, right in zip(gale.Mesh(points, tetrahedra).relation("EF"), expected):
                np.testing.assert_array_equal(found, right)

    def test_all_analyses_take_fields_of_a_device(self):
        mesh, field = gale.Mesh(self.put(self.points), self.put(self.tetrahedra)), self.put(self.field)
        right = self.mesh.persistence_diagram(self.field)
        found = mesh.persistence_diagram(field)
        np.testing.assert_array_equal(np.asarray(found.birth), np.asarray(right.birth))
        np.testing.assert_array_equal(np.asarray(found.death), np.asarray(right.death))
        right, found = self.mesh.morse_smale(self.field), mesh.morse_smale(field)
        for name, values in right.manifolds.items():
            np.testing.assert_array_equal(found.manifolds[name], values)
        right, found = self.mesh.critical_simplices(self.field), mesh.critical_simplices(field)
        for name, values in right.arrays.items():
            np.testing.assert_array_equal(found[name], values)

    def test_arrays_stay_as_they_are_and_may_go(self):
        points, tetrahedra, field = self.put(self.points), self.put(self.tetrahedra), self.put(self.field)
        mesh = gale.Mesh(points, tetrahedra)
        expected = mesh.critical_points(field)["CriticalType"]
        for kept, original in ((points, self.points), (tetrahedra, self.tetrahedra), (field, self.field)):
            np.testing.assert_array_equal(kept.on_host(), original)
        del points, tetrahedra, kept
        np.testing.assert_array_equal(mesh.critical_points(field)["CriticalType"], expected)

    def test_wrong_values_on_a_device_are_refused_as_on_the_host(self):
        with self.assertRaisesRegex(gale.Error, "vertex"):
            gale.Mesh(self.put(self.points), self.put(self.tetrahedra + len(self.points)))
        field = self.field.copy()
        field[5] = np.nan
        with self.assertRaisesRegex(gale.Error, "(?i)nan"):
            self.mesh.critical_points(self.put(field))
        with self.assertRaisesRegex(gale.Error, str(len(field) - 1)):
            self.mesh.critical_points(self.put(self.field[1:]))


if __name__ == "__main__":
    unittest.main()
