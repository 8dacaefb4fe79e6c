"""A mesh from gmsh, of a part that was bored through: where each basin of a field is, and the paths down to its minima.

usage: gmsh_mesh.py SIZE PICTURE: SIZE is the length of edges, e.g. gmsh_mesh.py 0.07 gmsh.png"""
import sys

import gale
import gmsh
import numpy as np
import pyvista
from pictures import add_critical, add_legend, add_paths, save

if len(sys.argv) != 3:
    sys.exit(__doc__)
size, picture = float(sys.argv[1]), sys.argv[2]
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
part = gmsh.model.occ.addBox(-1, -1, -0.6, 2, 2, 1.2)
bores = [(3, gmsh.model.occ.addCylinder(x, y, -1, 0, 0, 2, 0.3)) for x in (-0.5, 0.5) for y in (-0.5, 0.5)]
ball = (3, gmsh.model.occ.addSphere(0, 0, 0.6, 0.35))
gmsh.model.occ.cut([(3, part)], [*bores, ball])
gmsh.model.occ.synchronize()
gmsh.option.setNumber("Mesh.MeshSizeMax", size)
gmsh.model.mesh.generate(3)
tags, coordinates, _ = gmsh.model.mesh.getNodes()
corners = gmsh.model.mesh.getElementsByType(4)[1]  # of tetrahedra
gmsh.finalize()

place = np.zeros(int(tags.max()) + 1, np.int64)
place[tags] = np.arange(len(tags))
mesh = gale.Mesh(coordinates.reshape(-1, 3), place[corners].reshape(-1, 4))
x, y, z = mesh.points.T
values = np.sin(4 * x + 1) * np.cos(3.5 * y) + 0.4 * z
complex = mesh.morse_smale(values, persistence="5%")
print(mesh, f"{len(complex.critical_points)} critical simplices")

corners = mesh.relation("TV")[1].reshape(-1, 4).astype(np.int64)
tetrahedra = np.full(mesh.tetrahedra, pyvista.CellType.TETRA)
grid = pyvista.UnstructuredGrid(np.insert(corners, 0, 4, axis=1).ravel(), tetrahedra, mesh.points)
grid.cell_data["basin"] = complex.manifolds["DescendingManifold"][corners[:, 0]]
plotter = pyvista.Plotter(off_screen=True, window_size=(800, 600))
pastels = ["#f2cdbb", "#d3cbe3", "#cfe3cf", "#efe6b8", "#bfe0ea", "#e6c7dd"]
colors = [pastels[k % len(pastels)] for k in range(grid["basin"].max() + 1)]
half = grid.extract_cells(mesh.points[corners].mean(axis=1) @ [1, -1, 0] < 0)
plotter.add_mesh(half, scalars="basin", clim=(0, len(colors) - 1), cmap=colors, show_scalar_bar=False, ambient=0.2)
legend = add_critical(plotter, complex.critical_points, 16)
legend += add_paths(plotter, complex.separatrices1, 0.012, steps=8)
legend += [("patch", pyvista.Color(color).int_rgb, f"basin of minimum {k + 1}") for k, color in enumerate(colors)]
plotter.view_vector((1.5, -1, 1.2))
plotter.camera.zoom(1.3)
save(add_legend(plotter.screenshot(return_img=True), legend), picture)
