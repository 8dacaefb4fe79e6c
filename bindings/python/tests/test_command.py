"""`python -m gale`, and that the module finds what the command finds."""
import importlib.metadata
import json
import os
import subprocess
import sys
import tempfile
import unittest

import gale
import numpy as np


def command(*arguments):
    return subprocess.run([sys.executable, "-m", "gale", *arguments], capture_output=True, text=True, timeout=300)


class Command(unittest.TestCase):
    def test_is_the_command(self):
        done = command("--version")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        is_built = gale.configuration()
        self.assertEqual(is_built["version"], gale.__version__)
        self.assertEqual(done.stdout.splitlines(), [
            f"gale {is_built['version']}", f"commit {is_built['commit'] or 'unknown'}",
            f"Kokkos {is_built['kokkos']}: {', '.join(is_built['backends'])}", f"with {', '.join(is_built['options'])}",
            f"by {is_built['compiler']}"])

    def test_hands_on_exit_codes_and_errors(self):
        done = command("info", "missing.vtu")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        with self.assertRaises(gale.Error) as raised:
            gale.read("missing.vtu")
        self.assertEqual(done.stderr, f"gale: {raised.exception}\n")
        self.assertEqual(command("nonsense").returncode, 2)

    def test_script_of_that_name(self):
        try:
            scripts = importlib.metadata.distribution("gale-mesh").entry_points
        except importlib.metadata.PackageNotFoundError:
            self.skipTest("the module was installed by CMake")
        self.assertIn("gale.__main__:main", [script.value for script in scripts if script.name == "gale"])


class SameResults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh, arrays = gale.read("grid:24")
        cls.field = arrays["field"]

    def report(self, name, *options):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "report.json")
            done = command(name, "grid:24", *options, "--report", file)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(file) as opened:
                return json.load(opened)["result"]

    def test_critical_points(self):
        result = self.report("critical-points")
        types = np.bincount(self.mesh.critical_points(self.field)["CriticalType"], minlength=5)
        self.assertEqual(types.tolist(), [result[k] for k in ("minima", "saddles1", "saddles2", "maxima", "degenerate")])

    def test_critical_simplices_element_by_element(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "critical.vtp")
            done = command("discrete-gradient", "grid:24", "-o", file)
            self.assertEqual(done.returncode, 0, done.stderr)
            written = read_points(self, file)
        found = self.mesh.critical_simplices(self.field)
        self.assertEqual(set(found.arrays), set(written) - {"Points"})
        np.testing.assert_array_equal(found.points, written["Points"])
        for name, values in found.arrays.items():
            np.testing.assert_array_equal(values, written[name], name)

    def test_gradient_has_an_arrow_for_each_pair(self):
        found = self.mesh.discrete_gradient(self.field)
        critical = np.bincount(found.critical_simplices["CellDimension"], minlength=4)
        self.assertEqual(critical.tolist(), self.report("discrete-gradient")["critical"])
        edges, triangles = (len(self.mesh.relation(r)[0]) - 1 for r in ("EV", "FV"))
        free = np.array([self.mesh.vertices, edges, triangles, self.mesh.tetrahedra]) - critical
        arrows = np.bincount(found.arrows["CellDimension"], minlength=3)
        self.assertEqual(arrows.tolist(), [free[0], free[1] - free[0], free[3]])
        self.assertEqual(found.arrows["Vector"].shape, (len(found.arrows), 3))

    def test_morse_smale(self):
        result = self.report("morse-smale", "--persistence", "5%", "--separatrices2")
        found = self.mesh.morse_smale(self.field, persistence="5%", separatrices2=True)
        dimensions = np.bincount(found.critical_points["CellDimension"], minlength=4)
        self.assertEqual(dimensions.tolist(), result["critical"])
        kinds = found.separatrices1.line_arrays
        each = [len(np.unique(kinds["SeparatrixId"][kinds["SeparatrixType"] == kind])) for kind in (0, 2, 1)]
        self.assertEqual(each, [result["separatrices"][k] for k in ("descending", "ascending", "saddle_connectors")])
        self.assertEqual(found.manifolds["MorseSmaleManifold"].max() + 1, result["manifolds"]["morse_smale"])
        walls = found.separatrices2
        self.assertGreater(len(walls), 0)
        self.assertEqual(len(walls.cell_arrays["SeparatrixType"]), len(walls))
        self.assertIsNone(self.mesh.morse_smale(self.field).separatrices2)

    def test_persistence_diagram(self):
        result = self.report("persistence-diagram", "--persistence", "2%")
        found = self.mesh.persistence_diagram(self.field, persistence="2%")
        pairs = np.bincount(found.type[found.is_finite], minlength=3)
        self.assertEqual(pairs.tolist(), result["pairs"])

    def test_merge_tree(self):
        for kind in ("contour", "join", "split"):
            result = self.report("merge-tree", "--type", kind, "--persistence", "2%")
            found = self.mesh.merge_tree(self.field, type=kind, persistence="2%", arc_samples=3)
            self.assertEqual((len(found.nodes), len(found.arcs)), (result["nodes"], result["arcs"]))

    def test_simplify_field(self):
        result = self.report("simplify-field", "--persistence", "2%")
        found = self.mesh.simplify_field(self.field, persistence="2%")
        self.assertEqual((found.minima, found.maxima, found.kept_below), (result["minima"], result["maxima"], result["kept_below"]))


def read_points(test, file):
    """The point arrays of a .vtp, by VTK."""
    try:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    except ImportError:
        test.skipTest("there is no VTK for Python")
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    data = reader.GetOutput()
    arrays = data.GetPointData()
    named = {arrays.GetArrayName(k): vtk_to_numpy(arrays.GetArray(k)) for k in range(arrays.GetNumberOfArrays())}
    return {"Points": vtk_to_numpy(data.GetPoints().GetData()), **named}


if __name__ == "__main__":
    unittest.main()
