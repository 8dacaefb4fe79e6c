"""gale.read_steps: each step is what its file alone is, and meshes that stay the same are made once."""
import os
import tempfile
import unittest

import numpy as np

import gale
from gale import _gale


@unittest.skipUnless(_gale.reads_files, "this gale reads no files")
class Steps(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for k, height in enumerate((1, 2, 3)):
            self.write(f"f{k}.vtk", [[0, 1, 2, 3]], height)
        self.write("two.vtk", [[0, 1, 2, 3], [1, 2, 3, 4]], 4)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, cells, height):
        points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, height], [1, 1, height]]
        rows = "\n".join(" ".join(map(str, row)) for row in points)
        corners = "\n".join("4 " + " ".join(map(str, cell)) for cell in cells)
        values = " ".join(str(height * k * k % 5) for k in range(len(points)))
        with open(self.path(name), "w") as file:
            file.write(f"# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {len(points)} float\n{rows}\n"
                       f"CELLS {len(cells)} {5 * len(cells)}\n{corners}\nCELL_TYPES {len(cells)}\n{'10 ' * len(cells)}\n"
                       f"POINT_DATA {len(points)}\nSCALARS h float\nLOOKUP_TABLE default\n{values}\n")

    def expect(self, inputs, files, times):
        steps = list(gale.read_steps(inputs))
        self.assertEqual([time for time, _, _ in steps], times)
        for (_, mesh, arrays), file in zip(steps, files):
            alone, own = gale.read(self.path(file))
            np.testing.assert_array_equal(mesh.points, alone.points)
            np.testing.assert_array_equal(mesh.relation("TV")[1], alone.relation("TV")[1])
            np.testing.assert_array_equal(arrays["h"], own["h"])
            self.assertEqual(mesh.critical_points(arrays["h"]), alone.critical_points(own["h"]))

    def test_of_several_files(self):
        files = ["f0.vtk", "f1.vtk", "two.vtk", "f2.vtk"]
        self.expect([self.path(file) for file in files], files, [0, 1, 2, 3])

    def test_of_a_series(self):
        with open(self.path("run.pvd"), "w") as file:
            file.write('<VTKFile type="Collection" version="0.1"><Collection><DataSet timestep="2" file="f2.vtk"/>'
                       '<DataSet timestep="-0.5" file="f1.vtk"/></Collection></VTKFile>')
        self.expect(self.path("run.pvd"), ["f1.vtk", "f2.vtk"], [-0.5, 2])
        with self.assertWarnsRegex(UserWarning, "took the first of 2 time steps"):
            _, arrays = gale.read(self.path("run.pvd"))
        np.testing.assert_array_equal(arrays["h"], gale.read(self.path("f1.vtk"))[1]["h"])

    def test_that_are_none(self):
        self.assertEqual(list(gale.read_steps([])), [])
        for inputs in (self.path("missing.pvd"), [self.path("f0.vtk"), "missing.vtk"], ["a\0"], [self.path("f0.vtk"), "a.pvd"]):
            with self.assertRaises(gale.Error):
                list(gale.read_steps(inputs))


if __name__ == "__main__":
    unittest.main()
