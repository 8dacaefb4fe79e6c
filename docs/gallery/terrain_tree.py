"""The mountains of a terrain: its split tree, simplified, and the land that belongs to each arc.

The terrain, the Jacksboro fault in Tennessee, comes with matplotlib.

usage: terrain_tree.py PERSISTENCE PICTURE, e.g. terrain_tree.py 25% tree.png"""
import sys

import gale
import matplotlib.pyplot as plt
import numpy as np
import pyvista
from matplotlib.cbook import get_sample_data
from matplotlib.colors import hsv_to_rgb
from pictures import COLORS, save_figure

if len(sys.argv) != 3:
    sys.exit(__doc__)
persistence, picture = sys.argv[1:]
heights = get_sample_data("jacksboro_fault_dem.npz")["elevation"][::-1].astype(float)
y, x = np.indices(heights.shape)
points = np.stack([x, y, heights / 30], axis=-1).reshape(-1, 3)  # 90 m apart, and three times as high
a = (y * heights.shape[1] + x)[:-1, :-1].ravel()  # the lower left corner of each square
b, c, d = a + 1, a + heights.shape[1], a + heights.shape[1] + 1
triangles = np.concatenate([np.stack([a, b, d], axis=1), np.stack([a, d, c], axis=1)])
tree = gale.Mesh(points, triangles).merge_tree(heights.ravel(), "split", persistence=persistence)
lower, upper = (tree.arcs.cell_arrays[name] for name in ("downNodeId", "upNodeId"))
scalar, kinds = tree.nodes["Scalar"], tree.nodes["CriticalType"]
print(f"{np.sum(kinds == 3)} summits of {persistence}")

hues = np.arange(len(lower)) * 0.618 % 1  # arcs nearby get hues far apart
colors = hsv_to_rgb(np.stack([hues, np.where(kinds[upper] == 3, 0.6, 0.3), np.full(len(hues), 0.9)], axis=1))
land = pyvista.PolyData(points, np.insert(triangles, 0, 3, axis=1).ravel())
land["colors"] = (255 * colors[tree.segmentation["SegmentationId"]]).astype(np.uint8)
plotter = pyvista.Plotter(off_screen=True, window_size=(1400, 1000))
plotter.add_mesh(land, scalars="colors", rgb=True, smooth_shading=True, ambient=0.15)
for kind in (2, 3):
    plotter.add_points(tree.nodes.points[kinds == kind] + [0, 0, 2], color=COLORS[kind].tolist(), point_size=18, render_points_as_spheres=True)
plotter.view_vector((0.5, -1, 1.1))
shot = plotter.screenshot(return_img=True)
inked = np.argwhere((shot < 250).any(axis=2))
(top, left), (bottom, right) = inked.min(axis=0), inked.max(axis=0)

columns = np.zeros(len(scalar))  # of summits one each, of passes the middle of those above
taken = iter(range(len(scalar)))
def place(node):
    above = sorted(upper[lower == node], key=lambda other: scalar[other])
    columns[node] = np.mean([place(other) for other in above]) if above else next(taken)
    return columns[node]
place(0)

figure, (map_axes, tree_axes) = plt.subplots(1, 2, figsize=(12, 5), width_ratios=(1.6, 1), layout="constrained")
map_axes.imshow(shot[top:bottom, left:right])
map_axes.set_axis_off()
for low, high, color in zip(lower, upper, colors):
    tree_axes.plot(columns[[low, high, high]], scalar[[low, low, high]], color=color, linewidth=4, solid_capstyle="round", zorder=1)
for kind, name in ((0, "lowest point"), (2, "pass"), (3, "summit")):
    tree_axes.scatter(columns[kinds == kind], scalar[kinds == kind], color=COLORS[kind] / 255, label=name, zorder=2)
tree_axes.set(xticks=[], ylabel="height (m)", title="a colour an arc, and its land")
tree_axes.legend(loc="lower left")
save_figure(figure, picture)
