"""Pictures of results: by PyVista or matplotlib, whichever is there."""
from __future__ import annotations

import os
from typing import Any, Dict, Iterator, List, Optional, Tuple

import numpy as np

from ._gale import Error

COLORS = ["#325ac8", "#3cb478", "#f0aa3c", "#d23232", "#8c8c8c"]  # of minima, saddles, maxima, degenerate points
_KINDS = [("minimum", "minima"), ("1-saddle", "1-saddles"), ("2-saddle", "2-saddles"), ("maximum", "maxima"),
          ("degenerate point", "degenerate points")]
_SADDLE = ("saddle", "saddles")  # of a surface, which has one kind
_PATHS = {0: (("path down to a minimum", "paths down to minima"), COLORS[0]),
          1: (("path between saddles", "paths between saddles"), COLORS[1]),
          2: (("path up to a maximum", "paths up to maxima"), COLORS[3])}
Names = Tuple[str, str]  # of one, and of several


def counted(count: int, names: Names) -> str:
    """Says how many there are."""
    return f"{count} {names[count != 1]}"


class Picture:
    """What points, lines and polygons are drawn on, in space: a pyvista.Plotter, or axes of matplotlib's.

    on: such a one; "pyvista" or "matplotlib", to have that make one; None for PyVista's where it is installed."""

    def __init__(self, on: Any, file: Any) -> None:
        self._file = None if file is None else os.fspath(file)
        if on is None or on == "pyvista":
            try:
                import pyvista

                # Without a screen nothing is shown: a file is drawn all the same.
                on = pyvista.Plotter(off_screen=True) if self._file else pyvista.Plotter()
            except ImportError:
                if on is not None:
                    raise
                on = "matplotlib"
        if isinstance(on, str):
            if on != "matplotlib":
                raise Error(f"pictures are drawn on {on!r}, neither 'pyvista' nor 'matplotlib', nor a plotter or axes")
            on = new_axes(projection="3d")
        self.target = on
        self._is_plotter = hasattr(on, "add_mesh")
        if not self._is_plotter and not hasattr(on, "add_collection3d"):
            raise Error(f"pictures in space are drawn on a pyvista.Plotter or on 3D axes, not on what is of {type(on).__name__}")

    def add_points(self, points: np.ndarray, color: str, names: Names, large: bool = False) -> None:
        """Adds balls of a color, and how many there are to the legend."""
        if len(points) == 0:
            return
        if self._is_plotter:
            self.target.add_points(np.asarray(points, float), color=color, point_size=14 if large else 9,
                                   render_points_as_spheres=True, label=" " + counted(len(points), names))
        else:
            self.target.scatter(*points.T, color=color, s=24 if large else 10, label=counted(len(points), names), depthshade=False)

    def add_lines(self, points: np.ndarray, cells: Iterator[np.ndarray], color: str, names: Names) -> None:
        """Adds lines: each cell names its points."""
        paths = [points[cell] for cell in cells]
        if len(paths) == 0:
            return
        if self._is_plotter:
            import pyvista

            ends = np.cumsum([0, *(len(path) for path in paths)])
            lines = np.concatenate([np.concatenate([[len(path)], np.arange(begin, begin + len(path))])
                                    for path, begin in zip(paths, ends)])
            polydata: Any = pyvista.PolyData
            data = polydata(np.concatenate(paths).astype(float), lines=lines)
            self.target.add_mesh(data, color=color, line_width=3, label=" " + counted(len(paths), names))
        else:
            from mpl_toolkits.mplot3d.art3d import Line3DCollection

            self._include(np.concatenate(paths))
            self.target.add_collection3d(Line3DCollection(paths, colors=color, linewidths=1, label=counted(len(paths), names)))

    def add_polygons(self, points: np.ndarray, cells: Iterator[np.ndarray], color: str, names: Names) -> None:
        """Adds polygons, through which others can be seen."""
        paths = [points[cell] for cell in cells]
        if len(paths) == 0:
            return
        if self._is_plotter:
            import pyvista

            ends = np.cumsum([0, *(len(path) for path in paths)])
            faces = np.concatenate([np.concatenate([[len(path)], np.arange(begin, begin + len(path))])
                                    for path, begin in zip(paths, ends)])
            polydata: Any = pyvista.PolyData
            data = polydata(np.concatenate(paths).astype(float), faces=faces)
            self.target.add_mesh(data, color=color, opacity=0.4, label=" " + counted(len(paths), names))
        else:
            from mpl_toolkits.mplot3d.art3d import Poly3DCollection

            self._include(np.concatenate(paths))
            self.target.add_collection3d(Poly3DCollection(paths, facecolors=color, alpha=0.3))

    def finish(self) -> Any:
        """Adds the legend, writes the file if there is to be one, and returns what was drawn on."""
        if self._is_plotter:
            if self.target.renderer._labels:
                self.target.add_legend(bcolor=None, size=(0.38, 0.22), loc="lower right", face="circle")
            if self._file:
                self.target.screenshot(self._file)
            return self.target
        if self.target.get_legend_handles_labels()[0]:
            self.target.legend(loc="upper left", fontsize="small")
        low, high = np.array([self.target.get_xlim(), self.target.get_ylim(), self.target.get_zlim()]).T
        self.target.set_box_aspect(np.maximum(high - low, 0.3 * np.max(high - low)))
        return saved(self.target, self._file)

    def _include(self, points: np.ndarray) -> None:
        self.target.auto_scale_xyz(*points.T.astype(float))


def new_axes(**options: Any) -> Any:
    """Axes of matplotlib's, on a figure of their own."""
    try:
        import matplotlib.pyplot as plt
    except ImportError as missing:
        raise ImportError("pictures take matplotlib or, where they are in space, PyVista: "
                          "python -m pip install matplotlib") from missing
    return plt.figure(layout="constrained").add_subplot(**options)


def plane_axes(on: Any) -> Any:
    """The axes that a picture in a plane is drawn on: `on`, or new ones."""
    if on is None or (isinstance(on, str) and on == "matplotlib"):
        return new_axes()
    if not hasattr(on, "scatter"):
        raise Error(f"pictures in a plane are drawn on axes of matplotlib's, not on {on!r}")
    return on


def saved(axes: Any, file: Optional[Any]) -> Any:
    """The axes, whose figure is written to a file if there is to be one."""
    if file is not None:
        axes.figure.savefig(os.fspath(file), dpi=150)
    return axes


def add_critical(picture: Picture, points: np.ndarray, kinds: Optional[np.ndarray], top: int = 3) -> None:
    """Adds critical points in the colors of their kinds, extrema larger than saddles. `top` is the kind of maxima."""
    if kinds is None:
        picture.add_points(points, COLORS[4], ("point", "points"))
        return
    for kind in range(5):
        looks = 3 if kind == top else kind
        names = _SADDLE if top == 2 and kind == 1 else _KINDS[looks]
        picture.add_points(points[kinds == kind], COLORS[looks], names, looks in (0, 3))


def add_separatrices(picture: Picture, points: np.ndarray, cells: List[np.ndarray], types: np.ndarray, top: int = 3) -> None:
    """Adds lines from saddles in the colors of where they lead to."""
    for kind, path in _PATHS.items():
        names, color = _PATHS[2] if top == 2 and kind == 1 else path
        picture.add_lines(points, iter([cells[i] for i in np.flatnonzero(types == kind)]), color, names)


def tree_columns(lower: np.ndarray, upper: np.ndarray, heights: np.ndarray) -> np.ndarray:
    """Places nodes of a tree (or several) beside one another: leaves one each, others in the middle of those that hang on
    them, as seen from the lowest node. lower, upper: (arcs,) their nodes. heights: (nodes,)."""
    around: List[List[int]] = [[] for _ in heights]
    for low, high in zip(lower.tolist(), upper.tolist()):
        around[low].append(high)
        around[high].append(low)
    columns = np.full(len(heights), np.nan)
    parents: Dict[int, int] = {}
    leaves = 0
    for root in np.argsort(heights, kind="stable").tolist():
        if root in parents:
            continue
        parents[root] = -1
        waiting: List[Tuple[int, bool]] = [(root, False)]
        while waiting:
            node, is_left = waiting.pop()
            hanging = [other for other in around[node] if parents.get(other, node) == node and other != parents[node]]
            if is_left:
                columns[node] = np.mean([columns[other] for other in hanging])
                continue
            if not hanging:
                columns[node] = leaves
                leaves += 1
                continue
            waiting.append((node, True))
            for other in sorted(hanging, key=lambda one: -heights[one]):
                parents[other] = node
                waiting.append((other, False))
    return columns
