"""What analyses give: numpy arrays with the names that GALE's files have, and PyVista's objects of them."""
from dataclasses import dataclass, field

import numpy as np


@dataclass
class CriticalPoints:
    """Points and their arrays, e.g. `critical["CriticalType"]`."""

    points: np.ndarray
    arrays: dict

    def __getitem__(self, name):
        return self.arrays[name]

    def __len__(self):
        return len(self.points)

    def to_pyvista(self):
        """A pyvista.PolyData with a vertex for each."""
        import pyvista

        data = pyvista.PolyData(self.points)
        data.point_data.update(self.arrays)
        return data


@dataclass
class Lines:
    """Lines between points: the i-th is points[connectivity[offsets[i]:offsets[i + 1]]]. `arrays` are of the points,
    `line_arrays` of the lines."""

    points: np.ndarray
    arrays: dict
    offsets: np.ndarray
    connectivity: np.ndarray
    line_arrays: dict

    def __len__(self):
        return len(self.offsets) - 1

    def to_pyvista(self):
        """A pyvista.PolyData with these lines."""
        import pyvista

        sizes = np.diff(self.offsets)
        cells = np.insert(self.connectivity.astype(np.int64), self.offsets[:-1], sizes)
        data = pyvista.PolyData(self.points, lines=cells)
        data.point_data.update(self.arrays)
        data.cell_data.update(self.line_arrays)
        return data


@dataclass
class Diagram:
    """A persistence diagram: a row for each class of homology, ordered by `type`, its dimension. Of those that never
    end, `is_finite` is 0 and the death that of the field's highest vertex."""

    type: np.ndarray
    birth: np.ndarray
    death: np.ndarray
    is_finite: np.ndarray
    birth_vertex: np.ndarray
    death_vertex: np.ndarray

    def __len__(self):
        return len(self.type)

    @property
    def persistence(self):
        return self.death - self.birth


@dataclass
class MorseSmaleComplex:
    """Critical simplices, the lines that join them, and for each vertex of the mesh the numbers of its manifolds.
    `kept_below`: how many pairs of saddles below the threshold could not be cancelled."""

    critical_points: CriticalPoints
    separatrices1: Lines
    manifolds: dict = field(default_factory=dict)
    kept_below: int = 0
