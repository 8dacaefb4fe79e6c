"""What analyses give: numpy arrays with the names that GALE's files have, and PyVista's objects of them.

Results are equal (`==`) where all their arrays are. Notebooks show them as tables."""
from __future__ import annotations

from dataclasses import dataclass, field, fields
from html import escape
from typing import Any, Dict, Iterator, KeysView, Optional

import numpy as np

from ._gale import Error


def _equal(one: Any, other: Any) -> bool:
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(_equal(one[name], other[name]) for name in one)
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other)
    return bool(one == other)


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


class _Result:
    """What all results can."""

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return all(_equal(getattr(self, one.name), getattr(other, one.name)) for one in fields(self))  # type: ignore

    __hash__ = None  # type: ignore[assignment]

    def __getitem__(self, name: str) -> Any:
        named = self._named()
        if name not in named:
            raise Error(f"there is no '{name}' here, but {', '.join(named) or 'nothing'}")
        return named[name]

    def __contains__(self, name: object) -> bool:
        return name in self._named()

    def __iter__(self) -> Iterator[str]:
        return iter(self._named())

    def keys(self) -> KeysView[str]:
        """The names by which [...] gives what is in this."""
        return self._named().keys()

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._short()})"

    def _repr_html_(self) -> str:
        return f"<b>{type(self).__name__}</b>: {escape(self._short())}{self._tables()}"

    def _named(self) -> Dict[str, Any]:
        raise NotImplementedError

    def _short(self) -> str:
        raise NotImplementedError

    def _tables(self) -> str:
        raise NotImplementedError


_SHOWN = 10  # rows


class _Table(_Result):
    """A table of n rows, in columns."""

    def _tables(self) -> str:
        columns = self._columns()
        count = len(next(iter(columns.values())))
        rows = ["".join(f"<th>{escape(name)}</th>" for name in ["", *columns])]
        for i in range(min(count, _SHOWN)):
            cells = "".join(f"<td>{escape(str(values[i]))}</td>" for values in columns.values())
            rows.append(f"<th>{i}</th>{cells}")
        if count > _SHOWN:
            rows.append(f"<td colspan={len(columns) + 1}>and {count - _SHOWN} more</td>")
        return f"<table>{''.join(f'<tr>{row}</tr>' for row in rows)}</table>"

    def _columns(self) -> Dict[str, np.ndarray]:
        raise NotImplementedError


class _Parts(_Result):
    """Results together: `len` is how many, and [...] gives them by their names."""

    def __len__(self) -> int:
        return len(self._named())

    def _named(self) -> Dict[str, Any]:
        parts = {one.name: getattr(self, one.name) for one in fields(self)}  # type: ignore[arg-type]
        return {name: part for name, part in parts.items() if part is not None}

    def _short(self) -> str:
        return ", ".join(f"{name}: {part._short() if isinstance(part, _Result) else self._shortest(part)}"
                         for name, part in self._named().items())

    def _tables(self) -> str:
        return "".join(f"<details><summary>{name}</summary>{part._tables()}</details>"
                       for name, part in self._named().items() if isinstance(part, _Result))

    @staticmethod
    def _shortest(part: Any) -> str:
        if isinstance(part, np.ndarray):
            return _count(len(part), "number")
        return ", ".join(part) if isinstance(part, dict) else str(part)


@dataclass(eq=False, repr=False)
class CriticalPoints(_Table):
    """n points and what belongs to them, e.g. `critical["CriticalType"]`.

    points: (n, 3), of the mesh's type. arrays: by name, each (n,) or (n, components)."""

    points: np.ndarray
    arrays: Dict[str, np.ndarray]

    def __len__(self) -> int:
        return len(self.points)

    def __getitem__(self, name: str) -> np.ndarray:
        values: np.ndarray = super().__getitem__(name)
        return values

    def _named(self) -> Dict[str, Any]:
        return self.arrays

    def _short(self) -> str:
        return f"{_count(len(self), 'point')}: {', '.join(self.arrays)}"

    def _columns(self) -> Dict[str, np.ndarray]:
        return {"x, y, z": self.points, **self.arrays}

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData with a vertex for each."""
        import pyvista

        data = pyvista.PolyData(self.points)
        data.point_data.update(self.arrays)
        return data


@dataclass(eq=False, repr=False)
class Cells(_Table):
    """m cells among n points: the i-th has points[connectivity[offsets[i]:offsets[i + 1]]]. `len` is m, and [...] gives
    the cells' arrays.

    points: (n, 3). arrays: of the points, each (n,). offsets: (m + 1,) int64. connectivity: int32 places among the
    points. cell_arrays: of the cells, each (m,)."""

    points: np.ndarray
    arrays: Dict[str, np.ndarray]
    offsets: np.ndarray
    connectivity: np.ndarray
    cell_arrays: Dict[str, np.ndarray]

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __getitem__(self, name: str) -> np.ndarray:
        values: np.ndarray = super().__getitem__(name)
        return values

    def _named(self) -> Dict[str, Any]:
        return self.cell_arrays

    def _short(self) -> str:
        kind = type(self).__name__.lower()[:-1]
        return f"{_count(len(self), kind)} of {_count(len(self.points), 'point')}: {', '.join(self.cell_arrays)}"

    def _columns(self) -> Dict[str, np.ndarray]:
        return {"points": np.diff(self.offsets), **self.cell_arrays}

    def _to_pyvista(self, kind: str) -> Any:
        import pyvista

        cells = np.insert(self.connectivity.astype(np.int64), self.offsets[:-1], np.diff(self.offsets))
        polydata: Any = pyvista.PolyData
        data = polydata(self.points, **{kind: cells})
        data.point_data.update(self.arrays)
        data.cell_data.update(self.cell_arrays)
        return data


class Lines(Cells):
    """Lines through two points or more, which they may have in common."""

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


@dataclass(eq=False, repr=False)
class DiscreteGradient(_Parts):
    """The simplices that are paired with no other, and the pairs: a point at the middle of the lower simplex of each,
    with the arrays CellDimension (int8, of that simplex: 0, 1 or 2) and Vector (3 components, to the middle of the
    other)."""

    critical_simplices: CriticalPoints
    arrows: CriticalPoints


@dataclass(eq=False, repr=False)
class Diagram(_Table):
    """A persistence diagram of n classes of homology, ordered by `type`, the dimension.

    type: (n,) int8. birth, death: (n,) float64 values of the field. is_finite: (n,) bool; false for classes that never
    end, whose death is that of the field's highest vertex. birth_vertex, death_vertex: (n,) int32."""

    type: np.ndarray
    birth: np.ndarray
    death: np.ndarray
    is_finite: np.ndarray
    birth_vertex: np.ndarray
    death_vertex: np.ndarray

    def __len__(self) -> int:
        return len(self.birth)

    def __getitem__(self, name: str) -> np.ndarray:
        values: np.ndarray = super().__getitem__(name)
        return values

    @property
    def persistence(self) -> np.ndarray:
        """Deaths less births, (n,) float64."""
        return self.death - self.birth

    def _named(self) -> Dict[str, Any]:
        return {one.name: getattr(self, one.name) for one in fields(self)}

    def _short(self) -> str:
        kinds = [f"{number} of type {kind}" for kind, number in enumerate(np.bincount(self.type)) if number > 0]
        return f"{_count(len(self), 'pair')}: {', '.join(kinds)}"

    def _columns(self) -> Dict[str, np.ndarray]:
        return self._named()


@dataclass(eq=False, repr=False)
class MorseSmaleComplex(_Parts):
    """Critical simplices, the lines that join them, and for each vertex of the mesh the numbers of its manifolds.

    manifolds: DescendingManifold, AscendingManifold and MorseSmaleManifold, each (vertices,) int32, -1 where there is
    none. kept_below: how many pairs of saddles below the threshold could not be cancelled. separatrices2: the walls of
    saddles, if they were asked for."""

    critical_points: CriticalPoints
    separatrices1: Lines
    manifolds: Dict[str, np.ndarray] = field(default_factory=dict)
    kept_below: int = 0
    separatrices2: Optional[Polygons] = None


@dataclass(eq=False, repr=False)
class MergeTree(_Parts):
    """The nodes of a join, split or contour tree, from the lowest to the highest; its arcs; and the arc of each vertex.

    nodes: with the arrays NodeId, VertexId (int32), CriticalType (int8), Scalar, RegionSize, RegionSpan. arcs: with
    SegmentationId, downNodeId, upNodeId, RegionSize (int32), RegionSpan; their first points are the nodes'. segmentation:
    SegmentationId, RegionType, RegionSize, RegionSpan, each (vertices,); an arc is -1 where there is none."""

    nodes: CriticalPoints
    arcs: Lines
    segmentation: Dict[str, np.ndarray]

    def to_pyvista(self) -> Any:
        """(nodes, arcs): two pyvista.PolyData."""
        return self.nodes.to_pyvista(), self.arcs.to_pyvista()

    def to_networkx(self) -> Any:
        """A networkx.Graph with the nodes' arrays at its nodes and the arcs' at its edges, as Python's numbers."""
        import networkx

        graph = networkx.Graph()
        for node in range(len(self.nodes)):
            graph.add_node(node, **{name: values[node].tolist() for name, values in self.nodes.arrays.items()})
        for arc in range(len(self.arcs)):
            of_arc = {name: values[arc].tolist() for name, values in self.arcs.cell_arrays.items()}
            graph.add_edge(of_arc["downNodeId"], of_arc["upNodeId"], **of_arc)
        return graph


@dataclass(eq=False, repr=False)
class SimplifiedField(_Parts):
    """A field without extrema of little persistence.

    values: (vertices,), of the field's type. order: (vertices,) int32, the place of each vertex in an order along which
    they never fall; as the array NAME_Order it orders the vertices where GALE reads the field NAME from a file. minima,
    maxima: how many are left. kept_below: how many below the threshold could not be removed."""

    values: np.ndarray
    order: np.ndarray
    minima: int
    maxima: int
    kept_below: int
