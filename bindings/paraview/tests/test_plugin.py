"""The plugin in pvbatch, compared with what the command writes: loaded, run, rendered, applied many times."""
import os
import sys
import unittest
from pathlib import Path

import gale  # of the command's tests
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy


def resident_mib():
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20


def values_of(array):
    values = vtk_to_numpy(array).tolist()
    return list(map(tuple, values)) if array.GetNumberOfComponents() > 1 else values


def arrays_of(attributes):
    return {attributes.GetArray(k).GetName(): values_of(attributes.GetArray(k)) for k in range(attributes.GetNumberOfArrays())}


def cells_of(dataset, kind):
    """Each a list of points, as gale.XmlFile.cells has them."""
    cells = dataset.GetCells() if kind == "Cells" else getattr(dataset, f"Get{kind}")()
    ends, points = vtk_to_numpy(cells.GetOffsetsArray()), vtk_to_numpy(cells.GetConnectivityArray()).tolist()
    return [points[begin:end] for begin, end in zip(ends, ends[1:])]


class Plugin(gale.CommandTest):
    @classmethod
    def setUpClass(cls):
        simple.LoadPlugin(os.environ["GALE_PLUGIN"], remote=False, ns=vars(simple))

    def setUp(self):
        super().setUp()
        self.grid = self.generate(16)

    def generate(self, size):
        # In base64: ParaView 5.11 of Debian 12 can't read its own appended arrays since libexpat 2.5.0-1+deb12u2.
        self.succeed("generate", f"grid:{size}", "-o", f"grid{size}.vtu", "--encoding", "base64")
        return simple.XMLUnstructuredGridReader(FileName=[str(self.folder / f"grid{size}.vtu")])

    def same(self, found, file, kind, port=0):
        """Has a filter's output the points, cells and arrays of a file?"""
        found.UpdatePipeline()
        expected, found = gale.XmlFile(self.folder / file), found.SMProxy.GetClientSideObject().GetOutputDataObject(port)
        self.assertGreater(len(expected.points), 10)
        self.assertEqual(values_of(found.GetPoints().GetData()), expected.points)
        self.assertEqual(arrays_of(found.GetPointData()), expected.point_arrays)
        self.assertEqual(arrays_of(found.GetCellData()), expected.cell_arrays)
        self.assertEqual(cells_of(found, kind), expected.cells(kind))

    def test_critical_points_are_the_commands(self):
        self.succeed("critical-points", "grid16.vtu", "-o", "critical.vtp")
        self.same(simple.GALECriticalPoints(Input=self.grid, ScalarField=["POINTS", "field"]), "critical.vtp", "Verts")

    def test_complex_is_the_commands(self):
        self.succeed("morse-smale", "grid16.vtu", "--persistence", "0.1%", "--separatrices2", "-o", "complex")
        found = simple.GALEMorseSmaleComplex(Input=self.grid, Simplify=1, Persistence=0.1, ComputeSeparatrices2=1)
        for port, (part, kind) in enumerate({"critical_points.vtp": "Verts", "separatrices1.vtp": "Lines",
                                             "separatrices2.vtp": "Polys", "segmentation.vtu": "Cells"}.items()):
            with self.subTest(part):
                self.same(found, f"complex_{part}", kind, port)

    def test_segments_are_the_commands(self):
        self.succeed("segment", "grid16.vtu", "--capacity", "30", "-o", "segments.vtu")
        self.same(simple.GALESegmentation(Input=self.grid, Capacity=30), "segments.vtu", "Cells")

    def test_volume_is_the_commands(self):
        wavelet = simple.Wavelet(WholeExtent=[-8, 8, -8, 8, -8, 8])
        simple.SaveData(str(self.folder / "wavelet.vti"), proxy=wavelet)
        self.succeed("critical-points", "wavelet.vti", "--above", "120", "-o", "wavelet.vtp")
        self.same(simple.GALECriticalPoints(Input=wavelet, UseThreshold=1, Threshold=120), "wavelet.vtp", "Verts")

    def test_result_is_rendered(self):
        points = simple.GALECriticalPoints(Input=self.grid)
        view = simple.CreateView("RenderView")
        self.addCleanup(simple.Delete, view)
        view.ViewSize, view.Background, view.UseColorPaletteForBackground = [200, 200], [0, 0, 0], 0
        view.OrientationAxesVisibility = 0
        shown = simple.Show(points, view)
        shown.Representation, shown.PointSize, shown.ColorArrayName = "Points", 6, ["POINTS", ""]
        shown.AmbientColor = shown.DiffuseColor = [1, 0, 0]
        simple.ResetCamera(view)
        simple.Render(view)
        picture = str(self.folder / "points.png")
        self.assertTrue(simple.SaveScreenshot(picture, view))
        pixels = vtk_to_numpy(servermanager.Fetch(simple.PNGSeriesReader(FileNames=[picture])).GetPointData().GetArray(0))
        red = (pixels[:, 0] > 100) & (pixels[:, 1] < 60) & (pixels[:, 2] < 60)
        count = servermanager.Fetch(points).GetNumberOfPoints()
        self.assertGreater(count, 20)
        self.assertTrue(10 * count < red.sum() <= 40 * count, f"{red.sum()} red points of the picture for {count} points")

    def test_errors_name_what_is_wrong(self):
        said = []
        points = simple.GALECriticalPoints(Input=self.grid, ScalarField=["POINTS", "nothing"])

        def note(_, __, text):
            said.append(text)

        note.CallDataType = "string0"
        points.SMProxy.GetClientSideObject().AddObserver("ErrorEvent", note)
        points.UpdatePipeline()
        self.assertIn("the input has no point array 'nothing'", "".join(said))

    def test_ten_applies_leak_nothing(self):
        complex_ = simple.GALEMorseSmaleComplex(Input=self.generate(40))
        resident = []
        for apply in range(10):
            complex_.Capacity = 100 + apply
            complex_.UpdatePipeline()
            resident.append(round(resident_mib(), 1))
        print("MiB resident after each of ten applies:", *resident, file=sys.stderr)
        # The mesh and its outputs take more than 30 MiB: what is kept at each turn would show.
        self.assertLess(max(resident[5:]) - max(resident[:5]), 10)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
