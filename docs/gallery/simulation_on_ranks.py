"""A simulation with FEniCSx on many ranks: heat spreads in a cube of tetrahedra, and is analysed at each step, in place.

Each rank hands over the tetrahedra and values that FEniCSx has for it: no file is written, and no mesh is gathered.

usage: mpirun -n 3 python3 simulation_on_ranks.py N STEPS: of N x N x N cubes of six tetrahedra each"""
import sys

from mpi4py import MPI  # first: it starts MPI for several threads, as GALE wants it

import gale
import numpy as np
import ufl
from dolfinx import fem, mesh
from dolfinx.fem import petsc
from petsc4py import PETSc

if len(sys.argv) != 3:
    sys.exit(__doc__)
n, steps = int(sys.argv[1]), int(sys.argv[2])
ranks = MPI.COMM_WORLD
cube = mesh.create_unit_cube(ranks, n, n, n)
space = fem.FunctionSpace(cube, ("Lagrange", 1))

# The unknowns are the vertices: FEniCSx's global numbers of those of this rank's tetrahedra, and where they are.
numbering = space.dofmap.index_map
here = numbering.size_local + numbering.num_ghosts
ids = numbering.local_to_global(np.arange(here, dtype=np.int32)).astype(np.int64)
own = cube.topology.index_map(3).size_local
cells = ids[space.dofmap.list.array.reshape(-1, 4)[:own]]
points = space.tabulate_dof_coordinates()[:here]
part = gale.DistributedMesh(ranks, ids, points, cells)

# Backward Euler: (u - u_before) v + dt grad(u) grad(v) = 0, nothing flows through the boundary.
u, v, before = ufl.TrialFunction(space), ufl.TestFunction(space), fem.Function(space)
before.interpolate(lambda x: np.sin(9 * x[0]) * np.cos(11 * x[1]) + np.sin(13 * x[2] + 5 * x[0]) + x[1] / 7)
dt = 2e-3
matrix = petsc.assemble_matrix(fem.form((u * v + dt * ufl.dot(ufl.grad(u), ufl.grad(v))) * ufl.dx))
matrix.assemble()
right = fem.form(before * v * ufl.dx)
solver = PETSc.KSP().create(ranks)
solver.setOperators(matrix)
solver.setType("cg")
solver.getPC().setType("jacobi")
solver.setTolerances(rtol=1e-12)

for step in range(steps + 1):
    values = before.x.array
    critical = part.critical_points(values)["CriticalType"]
    counts = ranks.reduce(np.bincount(critical, minlength=5))
    diagram = part.persistence_diagram(values, persistence="1%")
    lines = part.morse_smale(values, persistence="1%").separatrices1  # simplified: on the first rank
    if ranks.rank == 0:
        print(f"step {step}: {counts[0]} minima, {counts[3]} maxima, {len(diagram)} persistent classes, "
              f"{len(lines.cell_arrays['SourceId'])} separatrices", flush=True)
    load = petsc.assemble_vector(right)
    load.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
    solver.solve(load, before.vector)
    before.x.scatter_forward()
