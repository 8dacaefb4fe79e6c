"""What analyses give: numpy arrays with the names that GALE's files have, and PyVista's objects of them."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Dict, Optional

import numpy as np


@dataclass
class CriticalPoints:
    """n points and what belongs to them, e.g. `critical["CriticalType"]`.

    points: (n, 3), of the mesh's type. arrays: by name, each (n,) or (n, components)."""

    points: np.ndarray
    arrays: Dict[str, np.ndarray]

    def __getitem__(self, name: str) -> np.ndarray:
        return self.arrays[name]

    def __len__(self) -> int:
        return len(self.points)

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData with a vertex for each."""
        import pyvista

        data = pyvista.PolyData(self.points)
        data.point_data.update(self.arrays)
        return data


@dataclass
class Cells:
    """m cells among n points: the i-th has points[connectivity[offsets[i]:offsets[i + 1]]].

    points: (n, 3). arrays: of the points, each (n,). offsets: (m + 1,) int64. connectivity: int32 places among the
    points. cell_arrays: of the cells, each (m,)."""

    points: np.ndarray
    arrays: Dict[str, np.ndarray]
    offsets: np.ndarray
    connectivity: np.ndarray
    cell_arrays: Dict[str, np.ndarray]

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def _to_pyvista(self, kind: str) -> Any:
        import pyvista

        cells = np.insert(self.connectivity.astype(np.int64), self.offsets[:-1], np.diff(self.offsets))
        polydata: Any = pyvista.PolyData
        data = polydata(self.points, **{kind: cells})
        data.point_data.update(self.arrays)
        data.cell_data.update(self.cell_arrays)
        return data


class Lines(Cells):
    """Lines between points, each of two."""

    @property
    def line_arrays(self) -> Dict[str, np.ndarray]:
        """The arrays of the lines: `cell_arrays`."""
        return self.cell_arrays

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData with these lines."""
        return self._to_pyvista("lines")


class Polygons(Cells):
    """Polygons between points."""

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData with these polygons."""
        return self._to_pyvista("faces")


@dataclass
class DiscreteGradient:
    """The simplices that are paired with no other, and the pairs: a point at the middle of the lower simplex of each,
    with the arrays CellDimension (int8, of that simplex: 0, 1 or 2) and Vector (3 components, to the middle of the
    other)."""

    critical_simplices: CriticalPoints
    arrows: CriticalPoints


@dataclass
class Diagram:
    """A persistence diagram of n classes of homology, ordered by `type`, the dimension.

    type: (n,) int8. birth, death: (n,) float64 values of the field. is_finite: (n,) uint8; of classes that never end it
    is 0, and the death that of the field's highest vertex. birth_vertex, death_vertex: (n,) int32."""

    type: np.ndarray
    birth: np.ndarray
    death: np.ndarray
    is_finite: np.ndarray
    birth_vertex: np.ndarray
    death_vertex: np.ndarray

    def __len__(self) -> int:
        return len(self.type)

    @property
    def persistence(self) -> np.ndarray:
        """Deaths less births, (n,) float64."""
        return self.death - self.birth


@dataclass
class MorseSmaleComplex:
    """Critical simplices, the lines that join them, and for each vertex of the mesh the numbers of its manifolds.

    manifolds: DescendingManifold, AscendingManifold and MorseSmaleManifold, each (vertices,) int32, -1 where there is
    none. kept_below: how many pairs of saddles below the threshold could not be cancelled. separatrices2: the walls of
    saddles, if they were asked for."""

    critical_points: CriticalPoints
    separatrices1: Lines
    manifolds: Dict[str, np.ndarray] = field(default_factory=dict)
    kept_below: int = 0
    separatrices2: Optional[Polygons] = None
