"""gale.DistributedMesh, of what lies on the ranks of MPI."""
from __future__ import annotations

import functools
from typing import Any, Callable, Dict, NoReturn, Optional, Tuple

import numpy as np

from . import _arrays, _gale
from ._gale import Error
from ._mesh import Mesh, _flag, _whole


def _agree(comm: Any, failure: Optional[Exception], call: str = "") -> None:
    """Raises on all ranks what the lowest of them says that has failed; or which ones differ in what they call. Collective."""
    known = isinstance(failure, Error)
    said = comm.allgather((None if failure is None else str(failure) if known else f"{type(failure).__name__}: {failure}", call))
    if failure is not None and comm.size == 1:
        raise failure
    for rank, (text, _) in enumerate(said):
        if text is not None:
            raise Error(f"rank {rank}: {text}") from failure
    for rank, (_, other) in enumerate(said):
        if other != said[0][1]:
            raise Error(f"ranks 0 and {rank} ask for different things: {said[0][1]} and {other}")


def _collective(method: Callable[..., Any]) -> Callable[..., Any]:
    """The method, which raises on all ranks what it raises on one before it begins."""
    @functools.wraps(method)
    def call(self: DistributedMesh, *arguments: Any, **named: Any) -> Any:
        self._has_begun = False
        try:
            return method(self, *arguments, **named)
        except Exception as error:
            if not self._has_begun:
                _agree(self._comm, error)
            raise
    return call


class DistributedMesh(Mesh):
    """One rank's part of a mesh of tetrahedra, or of triangles, that lies on the ranks of an mpi4py communicator.

    comm: the communicator. ids: (n,) global ids of the vertices that this rank hands over; points: (n, 3) float32 or
    float64, where they are; cells: (m, 4) or (m, 3) global ids of the corners of its cells; cell_ids: (m,)
    global ids of these, which are counted from rank to rank where they aren't given. int64 ids and cells, and
    float64 points, are read where they are: the points as long as the mesh lives, so don't change them. A cell is handed
    over by one rank, a vertex by any number of them, of which the lowest owns it; a rank may have none. With
    `repartition` vertices are dealt out anew, as many to each rank.

    Its methods are those of a Mesh but `relation` and `relation_matrix`. All ranks call them, in the same order, with a field that has a value for each vertex that was handed over. Each rank gets what it owns
    of a result, by global ids; a diagram, the nodes and arcs of a tree and simplified separatrices are on the first rank,
    and arrays of the mesh's points are in the order of `vertex_ids`. What fails on one rank raises gale.Error on all, wrong
    arguments too, and so do calls that differ from rank to rank; but `comm` itself.

    Jobs call MPI on a thread of their own, as mpi4py has it by default (MPI.THREAD_MULTIPLE)."""

    def __init__(self, comm: Any, ids: Any, points: Any, cells: Any, cell_ids: Any = None, repartition: bool = False,
                 capacity: int = 64) -> None:
        inner = getattr(_gale, "DistributedMesh", None)
        if inner is None:
            raise Error("this gale is built without MPI: GALE_ENABLE_MPI")
        from mpi4py import MPI

        if not isinstance(comm, MPI.Intracomm) or comm == MPI.COMM_NULL:
            raise Error(f"{comm!r} is no communicator of mpi4py's that has ranks of one group")
        self._comm = comm
        part, failure = None, None
        try:
            corners = _arrays.global_ids(cells, "cells")
            part = (_arrays.global_ids(ids, "ids"), _arrays.points(points),
                    np.zeros((0, 4), np.int64) if corners.size == 0 else corners,
                    None if cell_ids is None else _arrays.global_ids(cell_ids, "cell ids"),
                    _flag("repartition", repartition), _whole("capacity", capacity))
            inner.check_part(*part)
        except Exception as error:
            failure = error
        _agree(comm, failure, f"repartition={repartition}")
        assert part is not None
        self._mesh: Any = inner(MPI._addressof(comm), *part)

    @property
    def vertex_ids(self) -> np.ndarray:
        """The global ids of the vertices that this rank holds, ascending: its own, and others that its cells touch."""
        return np.asarray(self._mesh.vertex_ids)

    @property
    def owners(self) -> np.ndarray:
        """The rank that owns each of `vertex_ids`."""
        return np.asarray(self._mesh.owners)

    @property
    def points(self) -> np.ndarray:
        """A copy of the points of `vertex_ids`, (n, 3)."""
        return np.array(self._mesh.points())

    @property
    def cells(self) -> np.ndarray:
        """Not there: the cells of a part are those that it was made of."""
        self._refuse("cells")

    def __repr__(self) -> str:
        kind = "tetrahedra" if self.dimension == 3 else "triangles"
        return f"gale.DistributedMesh({self.vertices} vertices, {self._mesh.cells} {kind} on all ranks)"

    def _refuse(self, what: str) -> NoReturn:
        raise Error(f"a mesh on several ranks has no {what}")

    def _relation(self, name: str, threads: int, progress: Any) -> Tuple[np.ndarray, np.ndarray, int]:
        self._refuse("relations")

    def _found(self, *arguments: Any) -> Dict[str, Any]:
        self._mesh.check(*arguments)
        self._has_begun = True
        analysis, _, name, given, _, _, order = arguments
        _agree(self._comm, None, f"{analysis} of {(name, *given)}" + (" with an order" if order is not None else ""))
        return super()._found(*arguments)

    def to_pyvista(self) -> Any:
        self._refuse("grid of PyVista's")

    def __reduce__(self) -> Tuple[Any, ...]:
        self._refuse("copy in other processes")


for _name in ("critical_points", "critical_simplices", "discrete_gradient", "persistence_diagram", "morse_smale", "merge_tree",
              "simplify_field"):
    setattr(DistributedMesh, _name, _collective(getattr(DistributedMesh, _name)))
