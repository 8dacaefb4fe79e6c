"""Small meshes for the tests."""
import itertools

import numpy as np


def random_mesh(seed, n=4):
    """The tetrahedra of a small grid of cubes, each split in six, at shaken points."""
    rng = np.random.default_rng(seed)
    grid = np.array(list(itertools.product(range(n), repeat=3)), dtype=float)
    tetrahedra = []
    for x, y, z in itertools.product(range(n - 1), repeat=3):
        for order in itertools.permutations(range(3)):
            corner = [x, y, z]
            cell = [(corner[0] * n + corner[1]) * n + corner[2]]
            for axis in order:
                corner[axis] += 1
                cell.append((corner[0] * n + corner[1]) * n + corner[2])
            tetrahedra.append(cell)
    return grid + rng.uniform(-0.2, 0.2, grid.shape), np.array(tetrahedra), rng.standard_normal(len(grid))
