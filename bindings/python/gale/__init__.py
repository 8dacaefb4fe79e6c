"""Scalar fields on tetrahedral meshes: critical points, discrete gradients, Morse-Smale complexes, persistence.

>>> mesh = gale.Mesh(points, tetrahedra)        # arrays of (n, 3) coordinates and (m, 4) vertex ids
>>> critical = mesh.critical_points(values)     # a value for each point
>>> critical.points, critical["CriticalType"]
"""
import atexit
import os

import numpy as np

from . import _gale
from ._gale import Error, __version__
from .results import CriticalPoints, Diagram, Lines, MorseSmaleComplex

__all__ = ["CriticalPoints", "Diagram", "Error", "Lines", "Mesh", "MorseSmaleComplex", "__version__", "read"]

atexit.register(_gale.finalize)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_gale.after_fork)


def _contiguous(array, kinds, default):
    """The array itself, if its type is one of `kinds` and its rows follow each other; else a copy."""
    array = np.asarray(array)
    if array.dtype not in kinds:
        if not (np.issubdtype(array.dtype, np.integer) or np.issubdtype(array.dtype, np.floating)):
            raise Error(f"an array of {array.dtype} is not one of numbers")
        array = array.astype(default)
    return np.ascontiguousarray(array)


def _field(values):
    values = np.asarray(values)
    if values.dtype == np.bool_:
        values = values.view(np.uint8)
    elif values.dtype == np.float16:
        values = values.astype(np.float32)
    elif values.dtype.kind not in "iuf" or values.dtype.itemsize > 8:
        raise Error(f"a field of {values.dtype} is not one of numbers of up to 8 bytes")
    return np.ascontiguousarray(values.astype(values.dtype.newbyteorder("="), copy=False))


def _persistence(threshold):
    """(threshold, whether it is in percent of the field's range)"""
    if threshold is None:
        return None, False
    if isinstance(threshold, str):
        if not threshold.endswith("%"):
            raise Error(f"the persistence '{threshold}' is neither a number nor a percentage such as '3%'")
        value, is_percent = float(threshold[:-1]), True
    else:
        value, is_percent = float(threshold), False
    if not value >= 0:
        raise Error(f"the persistence {threshold} is not 0 or more")
    return value, is_percent


class Mesh:
    """A tetrahedral mesh.

    points: (n, 3) float32 or float64, tetrahedra: (m, 4) int32 or int64 vertex ids, read where they are; of other
    types, or where rows don't follow each other, a copy. `points` must not change while the mesh lives.

    capacity: how many vertices a segment has at most; no result depends on it.

    Fields are arrays of a number for each point. Everywhere, `threads` is how many threads to use (0: as many as there
    are cores), and `progress(done, all)` is called now and then. Raises gale.Error, a ValueError, for what isn't a mesh.
    """

    def __init__(self, points, tetrahedra, capacity=100):
        self._mesh = _gale.Mesh(_contiguous(points, (np.float32, np.float64), np.float64),
                                _contiguous(tetrahedra, (np.int32, np.int64), np.int64), capacity)

    @classmethod
    def from_pyvista(cls, grid, capacity=100):
        """Of a pyvista.UnstructuredGrid, or a vtkUnstructuredGrid, all of whose cells are tetrahedra."""
        import pyvista

        grid = pyvista.wrap(grid)
        if not np.all(grid.celltypes == pyvista.CellType.TETRA):
            raise Error("not all cells are tetrahedra: triangulate() makes such a grid")
        return cls(grid.points, grid.cell_connectivity.reshape(-1, 4), capacity)

    @classmethod
    def _of(cls, inner):
        mesh = cls.__new__(cls)
        mesh._mesh = inner
        return mesh

    vertices = property(lambda self: self._mesh.vertices, doc="How many points there are.")
    tetrahedra = property(lambda self: self._mesh.tetrahedra, doc="How many tetrahedra there are.")
    segments = property(lambda self: self._mesh.segments, doc="How many segments the mesh is divided into.")
    points = property(lambda self: self._mesh.points(), doc="A copy of the points, (n, 3).")

    def __repr__(self):
        return f"gale.Mesh({self.vertices} vertices, {self.tetrahedra} tetrahedra)"

    def relation(self, name, threads=0, progress=None):
        """Which simplices touch which, e.g. "VT": for each vertex its tetrahedra. As (indptr, indices): the i-th row is
        indices[indptr[i]:indptr[i + 1]], ascending. Vertices (V) and tetrahedra (T) have their places in the input;
        edges (E) and triangles (F) are numbered in the order of their vertices, which "EV" and "FV" give."""
        return self._mesh.relation(name, threads, progress)

    def critical_points(self, field, name="field", threads=0, progress=None):
        """The critical points of the piecewise linear field, by ascending vertex: CriticalPoints with the arrays `name`,
        CriticalType (0 minimum, 1 and 2 saddles, 3 maximum, 4 degenerate), IsOnBoundary and ttkVertexScalarField, the
        vertex."""
        return CriticalPoints(*self._mesh.critical_points(_field(field), name, threads, progress))

    def critical_simplices(self, field, name="field", threads=0, progress=None):
        """The simplices that the discrete gradient pairs with no other: CriticalPoints with the arrays `name`,
        CellDimension (0 minimum to 3 maximum), CellId, IsOnBoundary and ttkVertexScalarField, the highest vertex."""
        return CriticalPoints(*self._mesh.critical_simplices(_field(field), name, threads, progress))

    def persistence_diagram(self, field, persistence=0, name="field", threads=0, progress=None):
        """The persistent homology of the field, as a Diagram: pairs whose persistence is at least `persistence`, a
        difference of values or, as in "3%", a part of the field's range; and the classes that never end."""
        value, is_percent = _persistence(persistence)
        return Diagram(**self._mesh.persistence_diagram(_field(field), name, value, is_percent, threads, progress))

    def morse_smale(self, field, persistence=None, extrema_only=False, name="field", threads=0, progress=None):
        """The MorseSmaleComplex of the field, simplified below `persistence` (as in persistence_diagram) if that is
        given; of extrema alone with `extrema_only`."""
        value, is_percent = _persistence(persistence)
        parts = self._mesh.morse_smale(_field(field), name, value, is_percent, extrema_only, threads, progress)
        return MorseSmaleComplex(CriticalPoints(*parts["critical_points"]), Lines(*parts["separatrices1"]),
                                 parts["manifolds"], parts["kept_below"])


def read(path, above=None, array="", tetrahedralize=False, outside_files=False, capacity=100):
    """The mesh of a file, and its point arrays by name: (Mesh, dict).

    Meshes: .vtu, .vtk; volumes, of which the voxels with values above `above` are split into tetrahedra: .vti, .nii,
    .nii.gz, .mha, .mhd, .nrrd, .vtk; and grid:N. `array` is the volume's array that `above` is about."""
    inner, arrays = _gale.read(os.fspath(path), above, array, tetrahedralize, outside_files, capacity)
    return Mesh._of(inner), arrays
