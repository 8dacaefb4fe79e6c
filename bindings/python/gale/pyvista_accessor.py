"""`grid.gale` on PyVista's grids: `grid.gale.critical_points("pressure")`. PyVista 0.48 and later find it by
its entry point; with earlier ones, gale.Mesh.from_pyvista does the same."""
from __future__ import annotations

from typing import Any, Dict, List, Optional, Tuple

import numpy as np
import pyvista

from . import Diagram, Error, Mesh


@pyvista.register_dataset_accessor("gale", pyvista.UnstructuredGrid)
@pyvista.register_dataset_accessor("gale", pyvista.StructuredGrid)
@pyvista.register_dataset_accessor("gale", pyvista.RectilinearGrid)
@pyvista.register_dataset_accessor("gale", pyvista.ImageData)
class GaleAccessor:
    """Analyses of a grid's point arrays, which are called by name. Their other arguments and results are gale.Mesh's,
    but that points and lines are PyVista's, and that an array NAME_Order orders the points for the array NAME. The mesh is made at the first call, and again where the grid's points or cells
    were replaced."""

    def __init__(self, grid: Any) -> None:
        self._grid = grid
        self._mesh: Optional[Mesh] = None
        self._made_from: Tuple[Any, ...] = ()
        self._made_of: List[Tuple[Any, int]] = []

    @property
    def mesh(self) -> Mesh:
        """The grid as a gale.Mesh."""
        if self._mesh is None or self._points_changed():
            self._mesh = Mesh.from_pyvista(self._grid)
            self._made_from, self._made_of = self._shape(), self._parts()
        return self._mesh

    def _points_changed(self) -> bool:
        return self._shape() != self._made_from or self._parts() != self._made_of

    def _parts(self) -> List[Tuple[Any, int]]:
        """What the mesh is made of, and when it was modified."""
        parts = [self._grid.GetPoints()] if self._grid.IsA("vtkPointSet") else []
        parts += [self._grid.GetCells()] if self._grid.IsA("vtkUnstructuredGrid") else []
        if self._grid.IsA("vtkRectilinearGrid"):
            parts += [self._grid.GetXCoordinates(), self._grid.GetYCoordinates(), self._grid.GetZCoordinates()]
        return [(part, part.GetMTime()) for part in parts]

    def _shape(self) -> Tuple[Any, ...]:
        grid = self._grid
        is_regular = not grid.IsA("vtkUnstructuredGrid")
        return (grid.n_points, grid.n_cells, *((*grid.GetExtent(), *grid.bounds) if is_regular else ()))

    def _given(self, name: str, options: Dict[str, Any]) -> Dict[str, Any]:
        """What methods of gale.Mesh are given for the point array: beside it NAME_Order, where that is there."""
        names = self._grid.point_data.keys()
        if name not in names:
            raise Error(f"the grid has no point array '{name}': it has {', '.join(names) or 'none'}")
        order = f"{name}_Order"
        beside = {"order": self._grid.point_data[order]} if order in names else {}
        return {"field": self._grid.point_data[name], "name": name, **beside, **options}

    def critical_points(self, name: str, **options: Any) -> Any:
        """A pyvista.PolyData of the critical points of the point array `name`."""
        return self.mesh.critical_points(**self._given(name, options)).to_pyvista()

    def critical_simplices(self, name: str, **options: Any) -> Any:
        """A pyvista.PolyData of the critical simplices of the point array `name`."""
        return self.mesh.critical_simplices(**self._given(name, options)).to_pyvista()

    def persistence_diagram(self, name: str, **options: Any) -> Diagram:
        """The gale.Diagram of the point array `name`."""
        return self.mesh.persistence_diagram(**self._given(name, options))

    def morse_smale(self, name: str, **options: Any) -> Tuple[Any, ...]:
        """(critical points, separatrices, grid): two pyvista.PolyData, and a copy of the grid with the manifolds as point
        arrays. With `separatrices2`, a pyvista.PolyData of the walls comes last."""
        found = self.mesh.morse_smale(**self._given(name, options))
        grid = self._grid.copy(deep=False)
        grid.point_data.update(found.manifolds)
        walls = () if found.separatrices2 is None else (found.separatrices2.to_pyvista(),)
        return (found.critical_points.to_pyvista(), found.separatrices1.to_pyvista(), grid, *walls)

    def merge_tree(self, name: str, **options: Any) -> Tuple[Any, ...]:
        """(nodes, arcs, grid): two pyvista.PolyData, and a copy of the grid with the arcs of its points as point arrays."""
        found = self.mesh.merge_tree(**self._given(name, options))
        grid = self._grid.copy(deep=False)
        grid.point_data.update(found.segmentation)
        return (*found.to_pyvista(), grid)

    def simplify_field(self, name: str, **options: Any) -> Any:
        """A copy of the grid with the simplified point array `name`, and the order of its points, NAME_Order."""
        found = self.mesh.simplify_field(**self._given(name, options))
        grid = self._grid.copy(deep=False)
        grid.point_data.update({name: found.values, f"{name}_Order": found.order})
        return grid

    def relation(self, name: str, **options: Any) -> Tuple[np.ndarray, np.ndarray]:
        """(indptr, indices) of a relation such as "VT"."""
        return self.mesh.relation(name, **options)
