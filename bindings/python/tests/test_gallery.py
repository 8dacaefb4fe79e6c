"""The scripts of docs/gallery, on small inputs: they run, and draw."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

GALLERY = Path(__file__).parents[3] / "docs" / "gallery"
SCRIPTS = {"brain_critical_points": ["grid:16", "0"], "brain_complex": ["grid:16", "0", "5%"],
           "persistence_diagram": ["grid:16", "0"], "simulation_loop": ["12"], "gmsh_mesh": ["0.3"],
           "terrain_tree": ["40%"]}
WITHOUT_PICTURE = {"pictures", "simulation_on_ranks"}  # what the others share, and what test_ranks runs


class Gallery(unittest.TestCase):
    def colors_of(self, file):
        from PIL import Image

        with Image.open(file) as image:
            pixels = np.asarray(image.convert("RGB"))
        self.assertGreater(min(pixels.shape[:2]), 200, file)
        return len(np.unique(pixels.reshape(-1, 3), axis=0))

    def test_all_scripts_draw(self):
        try:
            import gmsh
            import matplotlib
            import pyvista
            import scipy
        except (ImportError, OSError) as missing:  # the latter where gmsh lacks a library of the system's
            self.skipTest(str(missing))
        with tempfile.TemporaryDirectory() as folder:
            for name, arguments in SCRIPTS.items():
                with self.subTest(name):
                    file = Path(folder) / f"{name}.png"
                    command = [sys.executable, "-B", str(GALLERY / f"{name}.py"), *arguments, str(file)]
                    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertGreater(self.colors_of(file), 30)
                    done = subprocess.run(command[:3], capture_output=True, text=True, timeout=300)
                    self.assertEqual(done.returncode, 1)
                    self.assertIn(f"usage: {name}.py", done.stderr)

    def test_the_notebook_runs(self):
        try:
            import ipykernel
            import matplotlib
            import nbclient
            import nbformat
            import pandas
        except ImportError as missing:
            self.skipTest(str(missing))
        notebook = nbformat.read(GALLERY / "first_steps.ipynb", as_version=4)
        self.assertFalse(any(cell.get("outputs") for cell in notebook.cells), "it is kept without what it shows")
        nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
        shown = [output.get("data", {}) for cell in notebook.cells for output in cell.get("outputs", [])]
        self.assertEqual(sum("image/png" in data for data in shown), 3)
        self.assertGreaterEqual(sum("<b>CriticalPoints</b>" in data.get("text/html", "") for data in shown), 1)

    def test_every_script_has_its_picture(self):
        index = (GALLERY / "README.md").read_text()
        self.assertEqual({file.stem for file in GALLERY.glob("*.py")} - WITHOUT_PICTURE, set(SCRIPTS))
        for name in SCRIPTS:
            self.assertIn(f"({name}.py)", index)
            self.assertIn(f"({name}.png)", index)
            self.assertLess((GALLERY / f"{name}.png").stat().st_size, 150e3)


if __name__ == "__main__":
    unittest.main()
