"""What analyses give: numpy arrays with the names that GALE's files have; PyVista's objects, pandas' frames and pictures of
them.

Results are equal (`==`) where all their arrays are. Notebooks show them as tables.

`plot` draws on what `on` says: axes of matplotlib's or a pyvista.Plotter; "matplotlib" or "pyvista", to have that make one;
else on a new one of PyVista's for pictures in space, where that is installed, and of matplotlib's. It returns what it drew
on, whose `show()` shows it; with `file` the picture is written there, too."""
from __future__ import annotations

from dataclasses import dataclass, field, fields
from html import escape
from typing import Any, Dict, Iterator, KeysView, List, Optional

import numpy as np

from . import _pictures
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

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with a row for each, and a column for each number that it has."""
        return _frame(self._columns())


def _beside(columns: Dict[str, np.ndarray], arrays: Dict[str, np.ndarray]) -> Dict[str, np.ndarray]:
    """Columns, and arrays, whose names get underscores where a column has them."""
    taken = {part for name in columns for part in [name, *name.split(", ")]}
    all_columns = dict(columns)
    for name, values in arrays.items():
        own = name
        while own in taken or (own != name and own in arrays):
            own += "_"
        all_columns[own] = values
    return all_columns


def _frame(columns: Dict[str, np.ndarray]) -> Any:
    """A pandas.DataFrame; arrays of several components have several columns."""
    import pandas

    flat: Dict[str, np.ndarray] = {}
    for name, values in columns.items():
        if values.ndim == 1:
            flat[name] = values
        else:
            names = name.split(", ") if ", " in name else [f"{name}_{k}" for k in range(values.shape[1])]
            flat.update(zip(names, values.T))
    return pandas.DataFrame(flat)


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

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame for each part, by its name; of arrays of the mesh's vertices one with a row for each vertex."""
        frames = {}
        for name, part in self._named().items():
            if isinstance(part, _Table):
                frames[name] = part.to_dataframe()
            elif isinstance(part, dict):
                frames[name] = _frame(part)
        return frames

    def to_pyvista(self) -> Any:
        """A pyvista.MultiBlock of the parts that have points, by their names."""
        import pyvista

        blocks = {name: part.to_pyvista() for name, part in self._named().items() if isinstance(part, (CriticalPoints, Cells))}
        return pyvista.MultiBlock(blocks)

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
        return _beside({"x, y, z": self.points}, self.arrays)

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData with a vertex for each."""
        import pyvista

        data = pyvista.PolyData(self.points)
        data.point_data.update(self.arrays)
        return data

    def _kinds(self) -> Optional[np.ndarray]:
        """0 to 4: minima, saddles, maxima, degenerate ones; nothing for points of which that isn't known."""
        for name in ("CriticalType", "CellDimension"):
            if name in self.arrays and "Vector" not in self.arrays:
                return self.arrays[name]
        return None

    def plot(self, on: Any = None, file: Any = None) -> Any:
        """Draws the points, in a colour for each kind."""
        picture = _pictures.Picture(on, file)
        _pictures.add_critical(picture, self.points, self._kinds())
        return picture.finish()


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
        return _beside({"points": np.diff(self.offsets)}, self.cell_arrays)

    def _cells(self) -> List[np.ndarray]:
        """The points of each."""
        return np.split(self.connectivity, self.offsets[1:-1]) if len(self) > 0 else []

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

    def plot(self, on: Any = None, file: Any = None) -> Any:
        """Draws the lines; separatrices in the colours of what they lead to."""
        picture = _pictures.Picture(on, file)
        self._add_to(picture)
        return picture.finish()

    def _add_to(self, picture: Any, top: int = 3) -> None:
        if "SeparatrixType" in self.cell_arrays:
            _pictures.add_separatrices(picture, self.points, self._cells(), self.cell_arrays["SeparatrixType"], top)
        else:
            picture.add_lines(self.points, iter(self._cells()), _pictures.COLORS[4], ("line", "lines"))


class Polygons(Cells):
    """Polygons between points."""

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData with these polygons."""
        return self._to_pyvista("faces")

    def plot(self, on: Any = None, file: Any = None) -> Any:
        """Draws the polygons."""
        picture = _pictures.Picture(on, file)
        self._add_to(picture)
        return picture.finish()

    def _add_to(self, picture: Any) -> None:
        picture.add_polygons(self.points, iter(self._cells()), _pictures.COLORS[4], ("polygon", "polygons"))


@dataclass(eq=False, repr=False)
class DiscreteGradient(_Parts):
    """The simplices that are paired with no other, and the pairs: a point at the middle of the lower simplex of each,
    with the arrays CellDimension (int8, of that simplex: 0, 1 or 2) and Vector (3 components, to the middle of the
    other)."""

    critical_simplices: CriticalPoints
    arrows: CriticalPoints

    def plot(self, on: Any = None, file: Any = None) -> Any:
        """Draws the critical simplices; arrows are too many."""
        return self.critical_simplices.plot(on, file)


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

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with a row for each pair: the arrays, and `persistence`."""
        return _frame({**self._columns(), "persistence": self.persistence})

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData with a line for each pair, from (birth, birth, 0) to (birth, death, 0), and the arrays at the
        lines."""
        import pyvista

        zeros = np.zeros(len(self))
        ends = np.stack([np.stack([self.birth, self.birth, zeros], axis=1), np.stack([self.birth, self.death, zeros], axis=1)], axis=1)
        lines = np.insert(np.arange(2 * len(self)).reshape(-1, 2), 0, 2, axis=1)
        polydata: Any = pyvista.PolyData
        data = polydata(ends.reshape(-1, 3), lines=lines.ravel()) if len(self) > 0 else polydata()
        data.cell_data.update({**self._named(), "persistence": self.persistence})
        return data

    def plot(self, on: Any = None, file: Any = None) -> Any:
        """Draws birth and death of each pair, in a colour for each type, on axes of matplotlib's. Classes that never end are
        triangles."""
        axes = _pictures.plane_axes(on)
        top = int(self.type.max(initial=0)) + 1  # the dimension of what ends the last type
        for kind in range(top):
            for ends, marker in ((True, "o"), (False, "^")):
                shown = (self.type == kind) & (self.is_finite == ends)
                if shown.any():
                    color = _pictures.COLORS[3 if kind == top - 1 and kind > 0 else kind]
                    name = f"type {kind}" if ends else f"type {kind}, without end"
                    axes.scatter(self.birth[shown], self.death[shown], s=8 if ends else 30, marker=marker, color=color,
                                 label=f"{np.count_nonzero(shown)} of {name}")
        if len(self) > 0:
            ends_at = [min(self.birth.min(), self.death.min()), max(self.birth.max(), self.death.max())]
            axes.plot(ends_at, ends_at, color="gray", linewidth=1, zorder=0)
            axes.legend(loc="lower right")
        axes.set(xlabel="birth", ylabel="death")
        return _pictures.saved(axes, file)


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
    _dimension = 3  # the mesh's, for pictures

    def plot(self, on: Any = None, file: Any = None) -> Any:
        """Draws critical simplices, the lines between them, and the walls of saddles if these are there."""
        picture = _pictures.Picture(on, file)
        if self.separatrices2 is not None:
            self.separatrices2._add_to(picture)
        self.separatrices1._add_to(picture, self._dimension)
        _pictures.add_critical(picture, self.critical_points.points, self.critical_points["CellDimension"], self._dimension)
        return picture.finish()


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

    def plot(self, on: Any = None, file: Any = None) -> Any:
        """Draws the tree on axes of matplotlib's: nodes at their values, with their arcs."""
        axes = _pictures.plane_axes(on)
        lower, upper = self.arcs["downNodeId"], self.arcs["upNodeId"]
        values, kinds = self.nodes["Scalar"].astype(float), self.nodes["CriticalType"]
        columns = _pictures.tree_columns(lower, upper, values)
        axes.plot(columns[[lower, upper]], values[[lower, upper]], color=_pictures.COLORS[4], linewidth=1, zorder=0)
        names = [("minimum", "minima"), ("join", "joins"), ("split", "splits"), ("maximum", "maxima"), ("other", "others")]
        for kind, name in enumerate(names):
            shown = kinds == kind
            if shown.any():
                label = _pictures.counted(int(np.count_nonzero(shown)), name)
                axes.scatter(columns[shown], values[shown], s=12, color=_pictures.COLORS[kind], label=label)
        axes.set(xticks=[], ylabel="value")
        axes.legend(loc="best", fontsize="small")
        return _pictures.saved(axes, file)

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
    they never fall: methods of gale.Mesh take it as `order`, else vertices' numbers order those that simplifying has made
    equal, and extrema that were removed may be there again; as the array NAME_Order it orders the vertices where the
    command, VTK's filters and ParaView read the field NAME. minima, maxima: how many are left. kept_below: how many below the threshold could not be removed."""

    values: np.ndarray
    order: np.ndarray
    minima: int
    maxima: int
    kept_below: int

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with a row for each vertex: `values` and `order`."""
        return _frame({"values": self.values, "order": self.order})

    def to_pyvista(self, mesh: Any = None) -> Any:
        """A pyvista.UnstructuredGrid of the mesh, a gale.Mesh, with `values` and `order` at its points. Needs the mesh, which
        the result doesn't hold."""
        if mesh is None:
            raise Error("a simplified field has no points: to_pyvista(mesh) takes the mesh that it is of")
        grid = mesh.to_pyvista()
        if grid.n_points != len(self.values):
            raise Error(f"the mesh has {grid.n_points} points, and the field {len(self.values)} values")
        grid.point_data.update({"values": self.values, "order": self.order})
        return grid

    def plot(self, on: Any = None, file: Any = None) -> Any:
        """Draws how many vertices have which values, on axes of matplotlib's."""
        axes = _pictures.plane_axes(on)
        axes.hist(self.values[np.isfinite(self.values)], bins=50, color=_pictures.COLORS[4])
        axes.set(xlabel="value", ylabel="vertices", title=f"{self.minima} minima, {self.maxima} maxima")
        return _pictures.saved(axes, file)


@dataclass(eq=False, repr=False)
class Tracks(_Parts):
    """Minima and maxima through the steps of a field.

    lines: through time, with the arrays TrackId, CriticalType (0 minima, 3 maxima) and LinkType (0 a track, 1 a merge, 2 a
    split); at points, which are the extrema of all steps, TrackId, Step, Time, CriticalType, ttkVertexScalarField, the
    field and Persistence. To have them rise through time: lines.points[:, 2] += lines.arrays["Time"].
    table: a row for each track, by column: TrackId, CriticalType, FirstStep, LastStep, FirstTime, LastTime, Begin (0 at the
    first step, 1 as a split, 2 as a birth), BeginTrack (what it splits from), End (0 at the last step, 1 by a merge, 2 by
    death), EndTrack (what it merges with), FirstVertex, LastVertex, Persistence (the greatest of its steps)."""

    lines: Lines
    table: Dict[str, np.ndarray]

    def plot(self, on: Any = None, file: Any = None) -> Any:
        """Draws the lines."""
        return self.lines.plot(on, file)
