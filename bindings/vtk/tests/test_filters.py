"""The filters from Python, compared with what the command writes."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from galevtk.vtkFiltersGale import (vtkGaleCriticalPoints, vtkGaleMergeTree, vtkGaleMorseSmaleComplex, vtkGaleSegmentation,
                                    vtkGaleSimplifiedField)
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader


def read(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def arrays_of(attributes):
    """By name: (type, components, all values)."""
    named = {}
    for k in range(attributes.GetNumberOfArrays()):
        array = attributes.GetArray(k)
        values = [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]
        named[array.GetName()] = array.GetDataTypeAsString(), array.GetNumberOfComponents(), values
    return named


def cells_of(cells):
    return [cells.GetConnectivityArray().GetTuple1(k) for k in range(cells.GetConnectivityArray().GetNumberOfTuples())]


class SameAsTheCommand(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="gale_vtk_")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.command("generate", "grid:14", "-o", "grid.vtu")
        cls.grid = read(vtkXMLUnstructuredGridReader(), cls.folder / "grid.vtu")

    @classmethod
    def command(cls, *arguments):
        subprocess.run([os.environ["GALE"], *arguments], cwd=cls.folder, check=True, stdout=subprocess.DEVNULL, timeout=300)

    def same(self, found, file):
        """Are points, cells and all arrays the same?"""
        expected = read(vtkXMLPolyDataReader(), self.folder / file)
        self.assertEqual(found.GetNumberOfPoints(), expected.GetNumberOfPoints())
        self.assertEqual([found.GetPoint(k) for k in range(found.GetNumberOfPoints())],
                         [expected.GetPoint(k) for k in range(found.GetNumberOfPoints())])
        self.assertEqual(arrays_of(found.GetPointData()), arrays_of(expected.GetPointData()))
        self.assertEqual(arrays_of(found.GetCellData()), arrays_of(expected.GetCellData()))
        for part in ("GetVerts", "GetLines", "GetPolys"):
            self.assertEqual(cells_of(getattr(found, part)()), cells_of(getattr(expected, part)()), part)

    def test_critical_points(self):
        self.command("critical-points", "grid.vtu", "-o", "critical.vtp")
        points = vtkGaleCriticalPoints()
        points.SetInputData(self.grid)
        points.Update()
        self.assertGreater(points.GetOutput().GetNumberOfPoints(), 20)
        self.same(points.GetOutput(), "critical.vtp")

    def test_complex(self):
        self.command("morse-smale", "grid.vtu", "--persistence", "1%", "--separatrices2", "-o", "complex")
        found = vtkGaleMorseSmaleComplex()
        found.SetInputData(self.grid)
        found.SimplifyOn()
        found.SetPersistence(1)
        found.ComputeSeparatrices2On()
        found.Update()
        self.same(found.GetCriticalPoints(), "complex_critical_points.vtp")
        self.same(found.GetSeparatrices1(), "complex_separatrices1.vtp")
        self.same(found.GetSeparatrices2(), "complex_separatrices2.vtp")
        expected = read(vtkXMLUnstructuredGridReader(), self.folder / "complex_segmentation.vtu")
        self.assertEqual(arrays_of(found.GetSegmentation().GetPointData()), arrays_of(expected.GetPointData()))
        self.assertEqual(found.GetOutputDataObject(3), found.GetSegmentation())

    def test_trees(self):
        for number, kind in enumerate(("contour", "join", "split")):
            self.command("merge-tree", "grid.vtu", "--type", kind, "--persistence", "1%", "--arc-samples", "3", "-o", "tree")
            found = vtkGaleMergeTree()
            found.SetInputData(self.grid)
            found.SetTreeType(number)
            found.SimplifyOn()
            found.SetArcSamples(3)
            found.Update()
            self.same(found.GetNodes(), "tree_nodes.vtp")
            self.same(found.GetArcs(), "tree_arcs.vtp")
            expected = read(vtkXMLUnstructuredGridReader(), self.folder / "tree_segmentation.vtu")
            self.assertEqual(arrays_of(found.GetSegmentation().GetPointData()), arrays_of(expected.GetPointData()))

    def test_simplified_field(self):
        self.command("simplify-field", "grid.vtu", "--persistence", "5%", "-o", "simple.vtu")
        found = vtkGaleSimplifiedField()
        found.SetInputData(self.grid)
        found.SimplifyOn()
        found.SetPersistence(5)
        found.Update()
        expected = read(vtkXMLUnstructuredGridReader(), self.folder / "simple.vtu")
        self.assertEqual(arrays_of(found.GetOutput().GetPointData()), arrays_of(expected.GetPointData()))

    def test_segments(self):
        self.command("segment", "grid.vtu", "--capacity", "30", "-o", "segments.vtu")
        segments = vtkGaleSegmentation()
        segments.SetInputData(self.grid)
        segments.SetCapacity(30)
        segments.Update()
        expected = read(vtkXMLUnstructuredGridReader(), self.folder / "segments.vtu")
        self.assertEqual(arrays_of(segments.GetOutput().GetPointData()), arrays_of(expected.GetPointData()))

    def test_outputs_have_the_types_of_their_ports(self):
        types = {vtkGaleCriticalPoints: ["vtkPolyData"], vtkGaleMorseSmaleComplex: 3 * ["vtkPolyData"] + ["vtkUnstructuredGrid"],
                 vtkGaleMergeTree: 2 * ["vtkPolyData"] + ["vtkUnstructuredGrid"],
                 vtkGaleSimplifiedField: ["vtkUnstructuredGrid"], vtkGaleSegmentation: ["vtkUnstructuredGrid"]}
        for made, names in types.items():
            found = made()
            found.SetInputData(self.grid)
            found.Update()
            self.assertEqual([found.GetOutput(port).GetClassName() for port in range(len(names))], names)
            self.assertEqual(found.GetOutput(), found.GetOutput(0))
            self.assertGreater(found.GetOutput().GetNumberOfPoints(), 20)

    def test_errors_and_progress_reach_observers(self):
        said, told = [], []
        points = vtkGaleCriticalPoints()
        self.assertIsInstance(points, vtkAlgorithm)

        def note(_, __, text):
            said.append(text)

        note.CallDataType = "string0"
        points.AddObserver("ErrorEvent", note)
        points.GetExecutive().AddObserver("ErrorEvent", note)
        points.AddObserver("ProgressEvent", lambda caller, _: told.append(caller.GetProgress()))
        points.SetInputData(self.grid)
        points.SetInputArrayToProcess(0, 0, 0, 0, "nothing")
        points.Update()
        self.assertIn("the input has no point array 'nothing'", said[0])
        points.SetInputArrayToProcess(0, 0, 0, 0, "field")
        points.SetNumberOfThreads(1)
        told.clear()
        points.Update()
        self.assertGreater(len(told), 10)
        self.assertEqual((told[-1], told), (1, sorted(told)))


if __name__ == "__main__":
    unittest.main()
