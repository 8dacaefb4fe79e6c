"""The scripts of docs/gallery and examples, on small inputs: they run, and draw."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[3]
GALLERY = ROOT / "docs" / "gallery"
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

    def test_what_the_command_found_in_a_volume_is_drawn(self):
        try:
            import pyvista
            from vtkmodules.vtkIOImage import vtkNIFTIImageWriter
        except ImportError as missing:
            self.skipTest(str(missing))
        from_middle = np.linalg.norm(np.moveaxis(np.indices((24, 24, 24)), 0, -1) - 11.5, axis=-1).ravel()
        volume = pyvista.ImageData(dimensions=(24, 24, 24))
        volume["values"] = np.clip(150 - 10 * from_middle + 5 * np.sin(2 * from_middle), 0, None).astype(np.float32)
        draw = str(ROOT / "examples" / "draw_volume.py")
        with tempfile.TemporaryDirectory() as folder:
            def run(*command, code=0):
                done = subprocess.run([sys.executable, "-B", *command], capture_output=True, text=True, timeout=300, cwd=folder)
                self.assertEqual(done.returncode, code, done.stderr)
                return done.stderr

            writer = vtkNIFTIImageWriter()
            writer.SetFileName(str(Path(folder) / "ball.nii.gz"))
            writer.SetInputData(volume)
            writer.Write()
            run("-m", "gale", "critical-points", "ball.nii.gz", "--above", "0", "-o", "ball.vtp")
            run("-m", "gale", "morse-smale", "ball.nii.gz", "--above", "0", "-o", "ball")
            run(draw, "ball.nii.gz", "points.png", "ball.vtp")
            run(draw, "ball.nii.gz", "lines.png", "ball_critical_points.vtp", "ball_separatrices1.vtp")
            for picture in ("points.png", "lines.png"):
                self.assertGreater(self.colors_of(Path(folder) / picture), 1000, picture)
            self.assertIn("usage: draw_volume.py", run(draw, code=2))
            self.assertIn("above 1000, half of --surface", run(draw, "ball.nii.gz", "x.png", "ball.vtp", "--surface", "2000", code=1))
            for wrong, *files in (("no.nii.gz", "no.nii.gz", "x.png", "ball.vtp"), ("no.vtp", "ball.nii.gz", "x.png", "no.vtp"),
                                  ("ball.vtp", "ball.nii.gz", "x.png", "ball.vtp", "ball.vtp"),
                                  ("no/x.png", "ball.nii.gz", "no/x.png", "ball.vtp")):
                self.assertRegex(run(draw, *files, code=1), f"^{wrong}: [^\n]*\n$")

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
