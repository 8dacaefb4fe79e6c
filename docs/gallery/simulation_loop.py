"""A simulation of one's own, with numpy and scipy: heat spreads from random spots, and critical points vanish.

The mesh is made once; each step asks it for the critical points of the values as they are.

usage: simulation_loop.py N PICTURE: on the N x N x N points of a cube"""
import sys

import gale
import matplotlib.pyplot as plt
import numpy as np
from pictures import COLORS, NAMES, save_figure

if len(sys.argv) != 3:
    sys.exit(__doc__)
n, picture = int(sys.argv[1]), sys.argv[2]
mesh, _ = gale.read(f"grid:{n}")
neighbours = mesh.relation_matrix("VV").astype(np.float64)
degree = np.diff(neighbours.indptr)

heat = np.random.default_rng(1).random(mesh.vertices)
steps, counts, slices = 60, [], {}
for step in range(steps + 1):
    if step in (0, 6, steps):
        slices[step] = heat.reshape(n, n, n)[n // 2].copy()
    counts.append(np.bincount(mesh.critical_points(heat)["CriticalType"], minlength=5)[:4])
    heat += 0.5 * (neighbours @ heat / degree - heat)
print(f"from {sum(counts[0])} critical points to {sum(counts[-1])}")

figure, axes = plt.subplots(1, 4, figsize=(12, 3.2), layout="constrained")
for axis, (step, values) in zip(axes, slices.items()):
    axis.imshow(values, cmap="inferno", origin="lower")
    axis.set(title=f"step {step}", xticks=[], yticks=[])
for kind, name in enumerate(NAMES):
    axes[3].plot([count[kind] for count in counts], color=COLORS[kind] / 255, label=name)
axes[3].set(xlabel="step", yscale="log", title="critical points")
axes[3].legend()
save_figure(figure, picture)
