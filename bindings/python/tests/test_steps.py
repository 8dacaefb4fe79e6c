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


class Tracks(unittest.TestCase):
    def test_of_bumps_that_move_meet_come_and_go(self):
        side = np.linspace(0, 1, 21)
        x, y = [grid.ravel() for grid in np.meshgrid(side, side)]
        corner = (np.arange(20)[:, None] * 21 + np.arange(20)).ravel()
        triangles = np.concatenate([np.stack([corner, corner + 1, corner + 22], 1), np.stack([corner, corner + 21, corner + 22], 1)])
        mesh = gale.Mesh(np.stack([x, y, 0 * x], 1), triangles)

        def bump(left, low, height):
            return height * np.exp(-((x - left) ** 2 + (y - low) ** 2) / (2 * 0.08 ** 2))

        def steps():  # two bumps of 0.08 are one where they are less than 0.16 apart: from step 4 on
            for k in range(6):
                field = bump(0.2 + 0.03 * k, 0.3, 1) + bump(max(0.74 - 0.06 * k, 0.28 + 0.03 * k), 0.3, 0.9)
                yield 0.5 * k, mesh, field + (bump(0.75, 0.8, 0.8) if 1 <= k <= 3 else 0)

        tracks = gale.track(steps(), 0.1, name="height")
        table = {name: values[tracks.table["CriticalType"] == 3].tolist() for name, values in tracks.table.items()}
        moving, met, brief = table["TrackId"]
        self.assertEqual([table[name] for name in ("FirstStep", "LastStep", "LastTime")], [[0, 0, 1], [5, 3, 3], [2.5, 1.5, 1.5]])
        self.assertEqual((table["Begin"], table["BeginTrack"]), ([0, 0, 2], [-1, -1, -1]))
        self.assertEqual((table["End"], table["EndTrack"]), ([0, 1, 2], [-1, moving, -1]))
        along = tracks.lines.arrays["TrackId"] == moving
        np.testing.assert_array_equal(tracks.lines.arrays["Time"][along], 0.5 * np.arange(6))
        np.testing.assert_allclose(tracks.lines.points[along][:4, 0], 0.2 + 0.03 * np.arange(4), atol=0.05)
        kinds = tracks.lines["LinkType"][tracks.lines["CriticalType"] == 3]
        self.assertEqual(sorted(kinds.tolist()), [0, 0, 0, 1])
        self.assertEqual(tracks, gale.track(list(steps()), 0.1, name="height", threads=1))
        self.assertIn("LinkType", repr(tracks))

    def test_of_other_meshes_and_nothing(self):
        self.assertEqual(len(gale.track([]).lines), 0)
        points = [[0, 0, 0], [1, 0, 0], [0, 1, 0.5]]
        one, other = (gale.Mesh(points, [[0, 1, 2]]) for _ in range(2))
        for steps, persistence in (([(0, one, [1, 2, 3]), (1, other, [1, 2, 3])], 0), ([(np.nan, one, [1, 2, 3])], 0),
                                   ([(0, one, [1, 2])], 0), ([(0, one, [1, 2, 3])], -1), ([(0, one, [1, np.nan, 3])], 0)):
            with self.assertRaises(gale.Error):
                gale.track(steps, persistence)


if __name__ == "__main__":
    unittest.main()
