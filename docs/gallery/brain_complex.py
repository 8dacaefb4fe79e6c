"""The Morse-Smale complex of a brain scan, simplified: the paths from its saddles down to minima and up to maxima.

usage: brain_complex.py VOLUME ABOVE PERSISTENCE PICTURE, e.g. brain_complex.py inia19-t1-brain.nii.gz 0 15% complex.png"""
import sys

import gale
import numpy as np
import pyvista
from pictures import add_critical, add_legend, add_paths, save, surface_of

if len(sys.argv) != 5:
    sys.exit(__doc__)
volume, above, persistence, picture = sys.argv[1:]
mesh, arrays = gale.read(volume, above=None if volume.startswith("grid:") else float(above))
values = next(iter(arrays.values()))
complex = mesh.morse_smale(values, persistence=persistence)
print(f"{len(complex.critical_points)} critical simplices are left at {persistence}")

plotter = pyvista.Plotter(off_screen=True, window_size=(1000, 700))
plotter.add_mesh(surface_of(mesh).smooth(n_iter=100), color="wheat", opacity=0.12)
legend = add_critical(plotter, complex.critical_points, 11)
legend += add_paths(plotter, complex.separatrices1, np.ptp(mesh.points) / 600)
plotter.view_vector((1, -1.2, 0.6))
plotter.camera.zoom(1.5)
save(add_legend(plotter.screenshot(return_img=True), legend), picture)
