"""The Morse-Smale complex of a brain scan, simplified: its separatrices, and the critical points that they join.

usage: brain_complex.py VOLUME ABOVE PERSISTENCE PICTURE, e.g. brain_complex.py ch2bet.nii.gz 0 30% complex.png"""
import sys

import gale
import pyvista
from pictures import COLORS, save, surface_of

if len(sys.argv) != 5:
    sys.exit(__doc__)
volume, above, persistence, picture = sys.argv[1:]
mesh, arrays = gale.read(volume, above=None if volume.startswith("grid:") else float(above))
values = next(iter(arrays.values()))
complex = mesh.morse_smale(values, persistence=persistence)
critical = complex.critical_points
print(f"{len(critical)} critical simplices and {len(complex.separatrices1)} lines are left at {persistence}")

plotter = pyvista.Plotter(off_screen=True, window_size=(800, 700))
plotter.add_mesh(surface_of(mesh).smooth(n_iter=50), color="wheat", opacity=0.15)
lines = complex.separatrices1.to_pyvista()
lines.cell_data["color"] = COLORS[[0, 2, 3]][complex.separatrices1.line_arrays["SeparatrixType"]]
plotter.add_mesh(lines, scalars="color", rgb=True, line_width=3)
plotter.add_points(critical.points, scalars=COLORS[critical["CellDimension"]], rgb=True, point_size=14,
                   render_points_as_spheres=True)
plotter.view_vector((1, -1.2, 0.6))
plotter.camera.zoom(1.3)
save(plotter.screenshot(return_img=True), picture)
