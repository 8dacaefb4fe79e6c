"""Draws the Morse-Smale complex of a brain, simplified, and its persistence diagram.

usage: brain.py VOLUME ABOVE PERSISTENCE PICTURE, e.g. brain.py ch2bet.nii.gz 0 10% brain.png"""
import sys

import gale
import numpy as np
import pyvista

volume, above, persistence, picture = sys.argv[1:]
mesh, arrays = gale.read(volume, above=float(above))
field = next(iter(arrays.values()))
complex = mesh.morse_smale(field, persistence=persistence)
critical = complex.critical_points
print(f"{len(critical)} critical simplices and {len(complex.separatrices1)} lines are left at {persistence}")

plotter = pyvista.Plotter(off_screen=True, shape=(1, 2), window_size=(1600, 800))
plotter.add_mesh(complex.separatrices1.to_pyvista(), color="gray", line_width=1)
colors = np.array([[50, 90, 200], [60, 180, 120], [240, 170, 60], [210, 50, 50]], np.uint8)
plotter.add_points(critical.points, scalars=colors[critical["CellDimension"]], rgb=True, point_size=9,
                   render_points_as_spheres=True)
plotter.camera.zoom(1.5)

diagram = mesh.persistence_diagram(field)
plotter.subplot(0, 1)
chart = pyvista.Chart2D(x_label="birth", y_label="death")
names = "minimum and 1-saddle", "1-saddle and 2-saddle", "2-saddle and maximum"
for type, (name, color) in enumerate(zip(names, colors)):
    of_type = (diagram.type == type) & (diagram.is_finite == 1)
    chart.scatter(diagram.birth[of_type], diagram.death[of_type], color=tuple(int(c) for c in color), size=4, label=name)
chart.line([field.min(), field.max()], [field.min(), field.max()], color="gray")
plotter.add_chart(chart)
plotter.screenshot(picture)
