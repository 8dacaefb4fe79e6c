"""gale.Mesh and gale.read."""
from __future__ import annotations

import inspect
import numbers
import operator
import os
import warnings
from typing import Any, Callable, Dict, Iterable, Iterator, List, Optional, Sequence, Tuple, TypeVar, Union

import numpy as np

from . import _arrays, _gale
from ._gale import Error
from ._progress import Progress, told
from .results import (CriticalPoints, Diagram, DiscreteGradient, Lines, MergeTree, MorseSmaleComplex, Polygons,
                      SimplifiedField, Tracks)

Persistence = Union[float, str]
Path = Union[str, "os.PathLike[str]"]

# What the parameters of Mesh's methods and of read() are, each said once.
_PARAMETERS = {
    "above": "volumes: the voxels with values above this, in the units of the volume, become vertices; all with finite values where "
             "it isn't given",
    "arc_samples": "points between the ends of an arc, at most; arcs are straight with 0",
    "array": "volumes of several arrays: which one `above` is about; the first where it isn't given",
    "capacity": "vertices of a segment, at most; no result depends on it",
    "cells": '"any": cells that are neither tetrahedra nor triangles are split into these; "simplices" or "tetrahedra": they are refused',
    "connectivity": "(entries,) integers: the points of each cell, one cell after the other",
    "extrema_only": "whether minima and maxima alone are cancelled, and pairs of saddles stay",
    "field": "(vertices,) numbers of up to 8 bytes, none of them nan: the value at each point of the mesh, in its order",
    "grid": "a pyvista or vtk dataset: unstructured, structured or rectilinear grid, image, or surface",
    "mesh": "a meshio.Mesh",
    "name": "what the field is called among the arrays of the result",
    "offsets": "(cells + 1,) integers: where each cell begins in `connectivity`, and the end",
    "order": "(vertices,) a permutation of 0 to vertices - 1: the place of each point in an order to go by instead of that of the "
             "values, such as that of a SimplifiedField",
    "outside_files": "whether headers may name data files outside of their own folder",
    "steps": "(time, Mesh, field) of each step, in the order of time; of one Mesh",
    "path": "a file, by its extension, or a synthetic mesh: grid:N, plane:N",
    "persistence": 'a difference of values, in the units of the field, of at least 0; or a part of its range, such as "3%"',
    "points": "(vertices, 3) float32 or float64 coordinates",
    "progress": "called as progress(done, all) now and then, and may raise to end the run; True shows a bar where tqdm is installed",
    "separatrices2": "whether the walls of saddles are found, too; they are large",
    "threads": "threads to use; 0: as many as there are cores",
    "type": '"contour": of level sets; "join": of what is below a value; "split": of what is above',
    "types": "(cells,) VTK's numbers of what each cell is, such as 10 (tetrahedron) or 12 (hexahedron)",
}

Function = TypeVar("Function", bound=Callable[..., Any])


def _documented(**parameters: str) -> Callable[[Function], Function]:
    """Adds to a docstring what each parameter is: as `parameters` say, or else the table above."""
    def add(function: Function) -> Function:
        names = [name for name in inspect.signature(function).parameters if name not in ("self", "cls")]
        said = [f":param {name}: {parameters.get(name, _PARAMETERS.get(name))}." for name in names]
        function.__doc__ = inspect.cleandoc(function.__doc__ or "") + "\n\n" + "\n".join(said)
        return function

    return add


def _persistence(threshold: Optional[Persistence]) -> Dict[str, Tuple[float, bool]]:
    """The threshold, and whether it is in percent of the field's range, if there is one."""
    if threshold is None:
        return {}
    is_percent = isinstance(threshold, str)
    try:
        if isinstance(threshold, str) and not threshold.endswith("%"):
            raise ValueError
        value = float(threshold[:-1] if isinstance(threshold, str) else threshold)
    except (OverflowError, TypeError, ValueError):
        raise Error(f"the persistence {threshold!r} is neither a number nor a percentage such as '3%'") from None
    if not value >= 0:
        raise Error(f"the persistence {threshold} is not 0 or more")
    return {"persistence": (value, is_percent)}


def _flag(name: str, value: Any) -> bool:
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise TypeError(f"{name} is {value!r}, neither True nor False")


def _text(name: str, value: Any) -> str:
    if isinstance(value, str):
        return value
    raise TypeError(f"{name} is {value!r}, which is no str")


def _whole(name: str, value: Any) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}, which is no whole number") from None
    if not -2**31 <= number < 2**31:
        raise Error(f"{name} is {number}, which 32 bits don't hold")
    return number


_POLYHEDRON = 42
_POINTS, _LINE, _STRIP, _POLYGON = 2, 4, 6, 7


def _cells_of(grid: Any) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(connectivity, offsets, types) of an unstructured grid."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if grid.GetNumberOfCells() == 0:
        raise Error("the grid has no cells")
    _require_points(grid)  # VTK 9.7 asks for the types of cells at points
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    has_distinct = hasattr(grid, "GetDistinctCellTypesArray")  # newer VTKs have no type for each cell where all agree
    types = vtk_to_numpy(grid.GetDistinctCellTypesArray() if has_distinct else grid.GetCellTypesArray())
    if has_distinct:
        types = _type_of_each(grid) if len(types) > 1 else np.full(len(offsets) - 1, types[0], np.uint8)
    if not np.any(types == _POLYHEDRON):
        return connectivity, offsets, types
    return (*_with_faces(grid, connectivity, offsets, types), types)


def _type_of_each(grid: Any) -> np.ndarray:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkVersion

    has_new_name = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) >= (9, 6)
    types: np.ndarray = vtk_to_numpy(grid.GetCellTypes() if has_new_name else grid.GetCellTypesArray())
    return types


def _with_faces(grid: Any, connectivity: np.ndarray, offsets: np.ndarray,
                types: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """(connectivity, offsets) with the faces of polyhedra in place of their points."""
    from vtkmodules.vtkCommonCore import vtkIdList

    faces, parts, begin = vtkIdList(), [], 0
    sizes = np.diff(offsets)
    for cell in np.flatnonzero(types == _POLYHEDRON):
        grid.GetFaceStream(int(cell), faces)
        parts.append(connectivity[begin:offsets[cell]])
        parts.append(np.array([faces.GetId(k) for k in range(faces.GetNumberOfIds())], np.int64))
        sizes[cell] = faces.GetNumberOfIds()
        begin = offsets[cell + 1]
    parts.append(connectivity[begin:])
    return np.concatenate(parts), np.concatenate([[0], np.cumsum(sizes)])


def _require_points(grid: Any) -> None:
    if grid.GetPoints() is None:
        raise Error("the grid has no points")


def _points_of(grid: Any) -> np.ndarray:
    """The points of a grid of any kind."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if grid.IsA("vtkPointSet"):
        _require_points(grid)
        return vtk_to_numpy(grid.GetPoints().GetData())
    if grid.IsA("vtkRectilinearGrid"):
        axes = [vtk_to_numpy(axis) for axis in (grid.GetXCoordinates(), grid.GetYCoordinates(), grid.GetZCoordinates())]
    else:
        first = grid.GetExtent()[::2]
        axes = [np.arange(first[d], first[d] + grid.GetDimensions()[d], dtype=np.float64) for d in range(3)]
    z, y, x = np.meshgrid(*axes[::-1], indexing="ij")
    places = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)
    if grid.IsA("vtkRectilinearGrid"):
        return places
    matrix = grid.GetDirectionMatrix()
    direction = np.array([[matrix.GetElement(row, column) for column in range(3)] for row in range(3)])
    return places * grid.GetSpacing() @ direction.T + grid.GetOrigin()


def _surface_cells(surface: Any) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(connectivity, offsets, types) of the cells of a surface, as VTK numbers them."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if surface.GetNumberOfPolys() + surface.GetNumberOfStrips() == 0:
        raise Error("the surface has no polygons")
    parts = [(surface.GetVerts(), _POINTS), (surface.GetLines(), _LINE), (surface.GetPolys(), _POLYGON),
             (surface.GetStrips(), _STRIP)]
    counts = [cells.GetNumberOfCells() for cells, _ in parts]
    connectivity = [vtk_to_numpy(cells.GetConnectivityArray()) for cells, _ in parts]
    sizes = [np.diff(vtk_to_numpy(cells.GetOffsetsArray())[:count + 1]) for (cells, _), count in zip(parts, counts)]
    types = np.repeat(np.array([kind for _, kind in parts], np.uint8), counts)
    return np.concatenate(connectivity), np.concatenate([[0], np.cumsum(np.concatenate(sizes))]), types


# VTK's numbers of what meshio calls cells; it orders their points as VTK does.
_MESHIO_TYPES = {"vertex": 1, "line": 3, "line3": 21, "triangle": 5, "polygon": 7, "quad": 9, "tetra": 10, "hexahedron": 12,
                 "wedge": 13, "pyramid": 14, "triangle6": 22, "tetra10": 24}


def _meshio_cells(mesh: Any) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(connectivity, offsets, types) of all blocks of a mesh of meshio's."""
    connectivity, sizes, types = [np.zeros(0, np.int64)], [np.zeros(0, np.int64)], [np.zeros(0, np.uint8)]
    for block in mesh.cells:
        if block.type not in _MESHIO_TYPES:
            raise Error(f"cells of meshio's type {block.type!r} can't be split: it takes {', '.join(_MESHIO_TYPES)}")
        if len(block.data) == 0:
            continue
        corners = _arrays.ids(np.asarray(block.data), f"cells of meshio's type {block.type!r}")
        connectivity.append(corners.ravel())
        sizes.append(np.full(len(corners), corners.shape[1] if corners.ndim == 2 else 1, np.int64))
        types.append(np.full(len(corners), _MESHIO_TYPES[block.type], np.uint8))
    offsets = np.concatenate([[0], np.cumsum(np.concatenate(sizes))])
    return np.concatenate(connectivity), offsets, np.concatenate(types)


def _joined(of: Any, points: List[Any], corners: List[Any], capacity: int, cells: Optional[np.ndarray] = None) -> Any:
    """A mesh that was pickled."""
    mesh = of(_arrays.joined(points), _arrays.joined(corners), capacity)
    mesh._cells = cells
    return mesh


class Mesh:
    """A mesh of tetrahedra, or of triangles.

    points: (n, 3) float32 or float64, cells: (m, 4) int32 or int64 vertex ids of tetrahedra, or (m, 3) of triangles:
    numpy's, or by the array interface or DLPack; on a GALE with CUDA also in a device's memory, by DLPack or
    `__cuda_array_interface__`. They are copied: what happens to them afterwards, the mesh doesn't see.

    capacity: how many vertices a segment has at most; no result depends on it.

    Meshes don't change. They can be pickled, and sent to other processes.

    Fields are arrays, (n,), of a number for each point, from where points may be. Everywhere, `threads` is how many
    threads to use (0: as many as there are cores). `progress(done, all)` is called now and then, and may raise to end the
    run; True shows a bar where tqdm is installed. Raises gale.Error, a ValueError, for what isn't a mesh.
    """

    _mesh: _gale.Mesh
    _cells: Optional[np.ndarray] = None

    def __init__(self, points: Any, cells: Any, capacity: int = 64) -> None:
        self._mesh = _gale.Mesh(_arrays.points(points), _arrays.ids(cells), _whole("capacity", capacity))

    @classmethod
    @_documented()
    def from_cells(cls, points: Any, connectivity: Any, offsets: Any, types: Any, capacity: int = 64) -> Mesh:
        """The mesh of cells of any kind, as VTK numbers and orders them: `connectivity` has their points, cell c those from
        offsets[c] up to offsets[c + 1], and types[c] is what it is (12: a hexahedron). Tetrahedra stay as they are;
        hexahedra, voxels, wedges, pyramids, pentagonal and hexagonal prisms, polyhedra and quadratic tetrahedra are split,
        without new points and so that neighbours fit: `cells` says which one a tetrahedron is of. Where no cell is of
        dimension 3, triangles, quads, pixels, polygons, strips and quadratic triangles make a mesh of triangles likewise. A
        polyhedron's entries are its faces: how many, then of each how many corners, and these (VTK's face stream). Cells
        of lower dimension are left out, with a UserWarning."""
        split = _gale.from_cells(_arrays.points(points), _arrays.ids(connectivity, "cells"), _arrays.offsets(offsets),
                                 _arrays.types(types), _whole("capacity", capacity))
        for notice in split[2]:
            if not notice.startswith("split "):
                warnings.warn(notice, stacklevel=2)
        return cls._of(split[0], split[1])

    @classmethod
    @_documented()
    def from_pyvista(cls, grid: Any, capacity: int = 64) -> Mesh:
        """The mesh of a grid of PyVista or VTK: of the cells of an unstructured one (see from_cells), of the polygons and
        strips of a surface, of the hexahedra (or quads) of a structured one, of the voxels (or pixels) of a rectilinear grid
        or an image, whatever their values. Those of the last three are split as gale.read splits the voxels of a file, six
        tetrahedra (or two triangles) each, which are computed and take no memory."""
        if not hasattr(grid, "IsA"):
            raise Error(f"what is of {type(grid).__name__} is no grid")
        if grid.IsA("vtkUnstructuredGrid"):
            cells = _cells_of(grid)
            return cls.from_cells(_points_of(grid), *cells, capacity)
        if grid.IsA("vtkPolyData"):
            cells = _surface_cells(grid)
            return cls.from_cells(_points_of(grid), *cells, capacity)
        if not (grid.IsA("vtkStructuredGrid") or grid.IsA("vtkRectilinearGrid") or grid.IsA("vtkImageData")):
            raise Error(f"what is of {type(grid).__name__} is no unstructured, structured or rectilinear grid, no surface, "
                        "and no image")
        low_x, high_x, low_y, high_y, low_z, high_z = grid.GetExtent()
        dimensions = high_x - low_x + 1, high_y - low_y + 1, high_z - low_z + 1
        along = [count for count in dimensions if count > 1]
        if len(along) < 2:
            raise Error("a grid of {} x {} x {} points has no cells of dimension 2 or 3".format(*dimensions))
        return cls._of(_gale.from_grid(_arrays.points(_points_of(grid)), *along, *[1] * (3 - len(along)),
                                        _whole("capacity", capacity)))

    @classmethod
    @_documented()
    def from_meshio(cls, mesh: Any, capacity: int = 64) -> Mesh:
        """The mesh of what meshio has read, of all its blocks of cells (see from_cells); points of two coordinates are in
        the plane z = 0."""
        if not hasattr(mesh, "cells") or not hasattr(mesh, "points"):
            raise Error(f"what is of {type(mesh).__name__} is no mesh of meshio's")
        points = np.asarray(mesh.points)
        if points.ndim == 2 and points.shape[1] == 2:
            points = np.column_stack([points, np.zeros(len(points), points.dtype)])
        return cls.from_cells(points, *_meshio_cells(mesh), capacity)

    @classmethod
    def _of(cls, inner: _gale.Mesh, cells: Optional[np.ndarray] = None) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._mesh = inner
        mesh._cells = cells
        return mesh

    @property
    def vertices(self) -> int:
        """How many points there are."""
        return self._mesh.vertices

    @property
    def tetrahedra(self) -> int:
        """How many tetrahedra there are; 0 of a mesh of triangles."""
        return self._mesh.cells if self._mesh.dimension == 3 else 0

    @property
    def triangles(self) -> int:
        """How many triangles a mesh of triangles has; 0 of one of tetrahedra, whose faces aren't counted."""
        return self._mesh.cells if self._mesh.dimension == 2 else 0

    @property
    def dimension(self) -> int:
        """3 where the cells are tetrahedra, 2 where they are triangles."""
        return self._mesh.dimension

    @property
    def segments(self) -> int:
        """How many segments the mesh is divided into."""
        return self._mesh.segments

    @property
    def points(self) -> np.ndarray:
        """A copy of the points, (n, 3)."""
        return np.asarray(self._mesh.points())

    @property
    def cells(self) -> np.ndarray:
        """A copy of which of the cells that the mesh was made of each tetrahedron (or triangle) is, or is of: (tetrahedra,)
        int32, or int64 where there are too many cells. Of an image, also where a part of it was read, and of grid:N these
        are its voxels (or pixels)."""
        if self._cells is not None:
            return np.array(self._cells)
        cubes = self._mesh.cubes()
        return np.arange(self._mesh.cells, dtype=np.int32) if cubes is None else np.asarray(cubes)

    def to_pyvista(self) -> Any:
        """A pyvista.UnstructuredGrid of the tetrahedra, none of whose volumes is negative, or of the triangles, whose
        corners ascend: which way they faced isn't kept."""
        import pyvista

        points, cells = self.points, self._corners().astype(np.int64)
        if self.dimension == 2:
            return pyvista.UnstructuredGrid({5: cells}, points)
        a, b, c, d = (points[cells[:, corner]].astype(np.float64) for corner in range(4))
        is_negative = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) < 0
        cells[is_negative, 2:] = cells[is_negative, :1:-1]
        return pyvista.UnstructuredGrid({10: cells}, points)

    def _corners(self) -> np.ndarray:
        """The points of each tetrahedron or triangle, ascending."""
        return self.relation("TV" if self.dimension == 3 else "FV")[1].reshape(-1, self.dimension + 1)

    def __reduce__(self) -> Tuple[Any, ...]:
        return _joined, (type(self), _arrays.pieces(self.points), _arrays.pieces(self._corners()), self._mesh.capacity,
                         self._mesh.cubes() if self._cells is None else self._cells)

    def __copy__(self) -> Mesh:
        return self

    def __deepcopy__(self, memo: Any) -> Mesh:
        return self

    def __repr__(self) -> str:
        cells = f"{self.tetrahedra} tetrahedra" if self.dimension == 3 else f"{self.triangles} triangles"
        return f"gale.Mesh({self.vertices} vertices, {cells})"

    @_documented(name='two of "V", "E", "F", "T" (of triangles the first three): for each simplex of the first kind those of the second')
    def relation(self, name: str, threads: int = 0, progress: Progress = None) -> Tuple[np.ndarray, np.ndarray]:
        """Which simplices touch which, e.g. "VT": for each vertex its tetrahedra (of triangles "VF"). As (indptr, indices), (rows + 1,) int64
        and (entries,) int32: the i-th row is indices[indptr[i]:indptr[i + 1]], ascending. Vertices (V) and cells (T, or
        F of a mesh of triangles) have their places in the input; edges (E) and other triangles (F) are numbered in the order of their vertices, which
        "EV" and "FV" give."""
        return self._relation(name, threads, progress)[:2]

    @_documented(name='two of "V", "E", "F", "T" (of triangles the first three): for each simplex of the first kind those of the second')
    def relation_matrix(self, name: str, threads: int = 0, progress: Progress = None) -> Any:
        """The relation as a scipy.sparse.csr_array of ones (int32), with a row and a column for each simplex: `relation`'s
        arrays, where scipy takes them as they are. Needs scipy."""
        from scipy.sparse import csr_array

        indptr, indices, columns = self._relation(name, threads, progress)
        ones = np.ones(len(indices), np.int32)
        matrix = csr_array((ones, indices, indptr), shape=(len(indptr) - 1, columns))
        matrix.has_sorted_indices = matrix.has_canonical_format = True
        return matrix

    def _relation(self, name: str, threads: int, progress: Progress) -> Tuple[np.ndarray, np.ndarray, int]:
        with told(progress, _text("name", name)) as tell:
            return self._mesh.relation(name, _whole("threads", threads), tell)

    @_documented()
    def critical_points(self, field: Any, name: str = "field", threads: int = 0,
                        progress: Progress = None, order: Any = None) -> CriticalPoints:
        """The critical points of the piecewise linear field, by ascending vertex: CriticalPoints with the arrays `name`,
        CriticalType (int8: 0 minimum, 1 and 2 saddles, 3 maximum, 4 degenerate), IsOnBoundary (bool) and
        ttkVertexScalarField (int32), the vertex."""
        found = self._analyse("critical-points", field, name, threads, progress, order=order)
        return CriticalPoints(*found["critical_points"])

    @_documented()
    def critical_simplices(self, field: Any, name: str = "field", threads: int = 0,
                           progress: Progress = None, order: Any = None) -> CriticalPoints:
        """The simplices that the discrete gradient pairs with no other: CriticalPoints with the arrays `name`,
        CellDimension (int8: 0 minimum to 3 maximum), CellId (int32), IsOnBoundary (bool) and ttkVertexScalarField (int32),
        the highest vertex."""
        found = self._analyse("discrete-gradient", field, name, threads, progress, order=order)
        return CriticalPoints(*found["critical_simplices"])

    @_documented()
    def discrete_gradient(self, field: Any, name: str = "field", threads: int = 0,
                          progress: Progress = None, order: Any = None) -> DiscreteGradient:
        """The discrete gradient: its critical simplices, as `critical_simplices` has them, and its arrows. Large: some 13
        arrows a vertex."""
        found = self._analyse("discrete-gradient", field, name, threads, progress, {"arrows": True}, order=order)
        return DiscreteGradient(CriticalPoints(*found["critical_simplices"]), CriticalPoints(*found["arrows"]))

    @_documented()
    def persistence_diagram(self, field: Any, persistence: Persistence = 0, name: str = "field", threads: int = 0,
                            progress: Progress = None, order: Any = None) -> Diagram:
        """The persistent homology of the field, as a Diagram: pairs whose persistence is at least `persistence`, a
        difference of values or, as in "3%", a part of the field's range; and the classes that never end."""
        thresholds = _persistence(persistence)
        found = self._analyse("persistence-diagram", field, name, threads, progress, {}, thresholds, order=order)
        return Diagram(**found["diagram"])

    @_documented()
    def morse_smale(self, field: Any, persistence: Optional[Persistence] = None, extrema_only: bool = False,
                    name: str = "field", threads: int = 0, progress: Progress = None,
                    separatrices2: bool = False, order: Any = None) -> MorseSmaleComplex:
        """The MorseSmaleComplex of the field, simplified below `persistence` (as in persistence_diagram) if that is
        given; of extrema alone with `extrema_only`. With the walls of saddles, which are large, if `separatrices2`."""
        flags = {"extrema_only": extrema_only, "separatrices2": separatrices2}
        found = self._analyse("morse-smale", field, name, threads, progress, flags, _persistence(persistence), order=order)
        walls = Polygons(*found["separatrices2"]) if separatrices2 else None
        complex = MorseSmaleComplex(CriticalPoints(*found["critical_points"]), Lines(*found["separatrices1"]),
                                    found["manifolds"], found["kept_below"], walls)
        complex._dimension = self.dimension
        return complex

    @_documented()
    def merge_tree(self, field: Any, type: str = "contour", persistence: Optional[Persistence] = None,
                   arc_samples: int = 0, name: str = "field", threads: int = 0, progress: Progress = None, order: Any = None) -> MergeTree:
        """The MergeTree of the field: of `type` "contour", "join" or "split"; without branches below `persistence` (as in
        persistence_diagram) if that is given. Arcs are drawn over at most `arc_samples` points between their ends,
        barycentres of their vertices."""
        found = self._analyse("merge-tree", field, name, threads, progress, {}, _persistence(persistence),
                              {"type": type}, {"arc_samples": arc_samples}, order)
        return MergeTree(CriticalPoints(*found["nodes"]), Lines(*found["arcs"]), found["segmentation"])

    @_documented()
    def simplify_field(self, field: Any, persistence: Optional[Persistence] = None, name: str = "field",
                       threads: int = 0, progress: Progress = None, order: Any = None) -> SimplifiedField:
        """The field without the minima and maxima whose persistence is below `persistence` (as in persistence_diagram), as
        a SimplifiedField."""
        found = self._analyse("simplify-field", field, name, threads, progress, {}, _persistence(persistence), order=order)
        values, order = found["field"].values()
        return SimplifiedField(values, order, found["minima"], found["maxima"], found["kept_below"])

    def _analyse(self, analysis: str, field: Any, name: str, threads: int, progress: Progress,
                 flags: Optional[Dict[str, bool]] = None, thresholds: Optional[Dict[str, Tuple[float, bool]]] = None,
                 choices: Optional[Dict[str, str]] = None, numbers: Optional[Dict[str, int]] = None,
                 order: Any = None) -> Dict[str, Any]:
        """What an analysis finds, by the names of its results; with options that aren't given at their defaults."""
        given = ({key: _flag(key, value) for key, value in (flags or {}).items()}, thresholds or {},
                 {key: _text(key, value) for key, value in (choices or {}).items()},
                 {key: _whole(key, value) for key, value in (numbers or {}).items()})
        with told(progress, analysis) as tell:
            found = self._found(analysis, _arrays.field(field), _text("name", name), given, _whole("threads", threads), tell,
                                None if order is None else _arrays.field(order))
        note = found.pop("note")
        if note:
            warnings.warn(note, stacklevel=3)
        return found

    def _found(self, *arguments: Any) -> Dict[str, Any]:
        """What an analysis finds with (analysis, field, name, options, threads, progress, order), which are of the right
        types."""
        found: Dict[str, Any] = self._mesh.analyse(*arguments)
        return found


@_documented()
def read(path: Path, above: Optional[float] = None, array: str = "", cells: str = "any",
         outside_files: bool = False, capacity: int = 64) -> Tuple[Mesh, Dict[str, np.ndarray]]:
    """The mesh of a file, and its point arrays by name, each (n,) or (n, components): (Mesh, dict).

    Meshes: .vtu, .pvtu, .vtk, .vts, .vtr, .e, .ex2, .exo, .vtkhdf, .hdf; surfaces: .vtp, .stl, .ply, .obj, .off, .vtk;
    volumes, of which the voxels with values above `above` are split into tetrahedra: .vti, .nii, .nii.gz, .mha, .mhd,
    .nrrd, .vtk; grid:N or plane:N; and of a .pvd or .series the first step (see read_steps). `array` is the volume's array that `above` is about. What of the file is left out,
    such as all but the first of several times, is a UserWarning, and so is that cells were split (see Mesh.from_cells);
    with cells="simplices" (or "tetrahedra") a file of other cells is refused instead."""
    inner, arrays, cell_ids = _read(path, above, array, cells, outside_files, capacity, None)
    return Mesh._of(inner, cell_ids), arrays


@_documented(inputs="a series, or several files that are its steps")
def read_steps(inputs: Union[Path, Sequence[Path]], above: Optional[float] = None, array: str = "", cells: str = "any",
               outside_files: bool = False, capacity: int = 64) -> Iterator[Tuple[float, Mesh, Dict[str, np.ndarray]]]:
    """The steps of a series, each read when it is asked for: (time, Mesh, point arrays) as of `read`, whose other
    arguments these are. `inputs` is a .pvd or .series, an Exodus or VTKHDF file, whose times are the steps, or several
    files, whose times are 0, 1, 2 and so on.

    A mesh that has the same cells as the step before is not made again, but shares what that one has:

    >>> for time, mesh, arrays in gale.read_steps("run.pvd"):
    ...     print(time, len(mesh.critical_points(arrays["pressure"])))"""
    paths = [inputs] if isinstance(inputs, (str, os.PathLike)) else list(inputs)
    before = None
    for time, place, at in _gale.steps_of([_place(path) for path in paths], _flag("outside_files", outside_files)):
        before, arrays, cell_ids = _read(os.fsdecode(place), above, array, cells, outside_files, capacity, before, at)
        yield time, Mesh._of(before, cell_ids), arrays


@_documented()
def track(steps: Iterable[Tuple[float, Mesh, Any]], persistence: Optional[Persistence] = None, name: str = "field",
          threads: int = 0, progress: Progress = None) -> Tracks:
    """Follows the minima and maxima of a field through its steps: Tracks. An extremum goes on in the extremum of the next
    step whose manifold holds its vertex, if that is so backward, too, of each step's complex simplified below
    `persistence` (as in Mesh.persistence_diagram). Steps are asked for one after the other, and none is kept:

    >>> run = gale.read_steps("run.pvd")
    >>> tracks = gale.track(((time, mesh, arrays["pressure"]) for time, mesh, arrays in run), "3%")
    >>> tracks.table["End"]                        # 0 at the last step, 1 merged with EndTrack, 2 dead"""
    tracker = _gale.Tracker()
    threshold = _persistence(0 if persistence is None else persistence)["persistence"]
    before = -np.inf
    for number, step in enumerate(steps):
        if not isinstance(step, (tuple, list)) or len(step) != 3 or not isinstance(step[1], Mesh):
            raise TypeError(f"step {number}, of {type(step).__name__}, is not (time, Mesh, field)")
        time, mesh, field = step
        if not isinstance(time, (numbers.Real, np.ndarray)):
            raise TypeError(f"the time of step {number} is {time!r}, which is no number")
        if float(time) < before:
            raise Error(f"the time of step {number}, {time}, is before that of the last one, {before}")
        before = float(time)
        with told(progress, f"step at {time}") as tell:
            tracker.add(before, mesh._mesh, _arrays.field(field), _text("name", name), threshold,
                        _whole("threads", threads), tell)
    lines, table = tracker.found()
    return Tracks(Lines(*lines), table)


def _place(path: Path) -> bytes:
    """A path as the system has it."""
    place = os.fsencode(path)
    if b"\0" in place:
        raise Error(f"the path {path!r} has a null character")
    return place


def _read(path: Path, above: Optional[float], array: str, cells: str, outside_files: bool, capacity: int,
          like: Optional[_gale.Mesh], time: Optional[int] = None) -> Tuple[_gale.Mesh, Dict[str, np.ndarray], Optional[np.ndarray]]:
    """A file's mesh, its point arrays and its cells' global ids."""
    if not isinstance(cells, str) or cells not in ("any", "simplices", "tetrahedra"):
        raise Error(f"cells are {cells!r}, neither 'any' nor 'simplices'")
    if isinstance(above, (str, bytes)) or (above is not None and not hasattr(above, "__float__")):
        raise TypeError(f"above is {above!r}, which is no number")
    inner, arrays, cell_arrays, notices = _gale.read(
        _place(path), None if above is None else float(above), _text("array", array), cells != "any",
        _flag("outside_files", outside_files), _whole("capacity", capacity), like, time)
    name = os.fsdecode(path)
    if array and array not in arrays:
        raise Error(f"{name} has no point array '{array}': it has {', '.join(arrays) or 'none'}")
    for notice in notices:
        warnings.warn(f"{name}: {notice}", stacklevel=3)
    return inner, arrays, cell_arrays.get("GlobalCellIds")
