"""A slice of a brain, and the critical points of the scan that lie in it.

usage: brain_critical_points.py VOLUME ABOVE PICTURE, e.g. brain_critical_points.py ch2bet.nii.gz 0 critical.png"""
import sys

import gale
import matplotlib.pyplot as plt
import numpy as np
from pictures import COLORS, NAMES, save_figure

if len(sys.argv) != 4:
    sys.exit(__doc__)
volume, above, picture = sys.argv[1:]
mesh, arrays = gale.read(volume, above=None if volume.startswith("grid:") else float(above))
values = next(iter(arrays.values()))
critical = mesh.critical_points(values)
counts = np.bincount(critical["CriticalType"], minlength=4)
print(", ".join(f"{count} {name}" for count, name in zip(counts, NAMES)))

points = mesh.points
low, high = points.min(axis=0), points.max(axis=0)
step = np.diff(np.unique(points[:, 0].round(3)))[0]  # of voxels
height = (low[2] + high[2]) / 2
in_slice = np.abs(points[:, 2] - height) <= step / 2
columns, rows = (np.rint((points[in_slice, d] - low[d]) / step).astype(int) for d in (0, 1))
image = np.full((rows.max() + 1, columns.max() + 1), np.nan)
image[rows, columns] = values[in_slice]

figure, axes = plt.subplots(figsize=(6, 6.6), layout="constrained")
axes.imshow(image, cmap="gray", origin="lower", extent=[low[0], high[0], low[1], high[1]])
near = np.abs(critical.points[:, 2] - height) <= step / 2
for kind, name in enumerate(NAMES):
    x, y, _ = critical.points[near & (critical["CriticalType"] == kind)].T
    axes.scatter(x, y, s=4, color=COLORS[kind] / 255, label=name)
axes.set_axis_off()
axes.legend(loc="lower right", markerscale=3)
save_figure(figure, picture)
