"""The persistence diagram of a volume, and how many features each threshold leaves: how much to simplify.

usage: persistence_diagram.py VOLUME ABOVE PICTURE, e.g. persistence_diagram.py ch2bet.nii.gz 0 diagram.png"""
import sys

import gale
import matplotlib.pyplot as plt
import numpy as np
from pictures import COLORS, save_figure

if len(sys.argv) != 4:
    sys.exit(__doc__)
volume, above, picture = sys.argv[1:]
mesh, arrays = gale.read(volume, above=None if volume.startswith("grid:") else float(above))
values = next(iter(arrays.values()))
diagram = mesh.persistence_diagram(values)

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.6), layout="constrained")
for kind, name in enumerate(("minimum and 1-saddle", "1-saddle and 2-saddle", "2-saddle and maximum")):
    pairs = (diagram.type == kind) & diagram.is_finite
    shown = np.unique(np.column_stack([diagram.birth[pairs], diagram.death[pairs]]), axis=0)
    left.scatter(*shown.T, s=3, color=COLORS[kind + kind // 2] / 255, label=name)
    persistence = np.sort(diagram.persistence[pairs])
    right.plot(persistence, np.arange(len(persistence), 0, -1), color=COLORS[kind + kind // 2] / 255)
ends = [values.min(), values.max()]
left.plot(ends, ends, color="gray", linewidth=1)
left.set(xlabel="birth", ylabel="death", title=f"{len(diagram)} features")
left.legend(loc="lower right", markerscale=3)
right.set(xlabel="persistence", ylabel="pairs of that persistence or more", yscale="log")
save_figure(figure, picture)
