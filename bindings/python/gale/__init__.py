"""Scalar fields on tetrahedral meshes: critical points, discrete gradients, Morse-Smale complexes, persistence,
merge trees, simplified fields.

>>> mesh = gale.Mesh(points, tetrahedra)        # arrays of (n, 3) coordinates and (m, 4) vertex ids
>>> critical = mesh.critical_points(values)     # a value for each point
>>> critical.points, critical["CriticalType"]

`python -m gale` is the command.
"""
import atexit
import os
from typing import Any, Dict

from . import _interpreter

_interpreter.require_main()  # before anything else, since what is loaded by a second interpreter breaks the first

from . import _gale
from ._gale import Error
from ._gale import version as __version__
from ._mesh import Mesh, read, read_steps, track
from ._ranks import DistributedMesh
from .results import (CriticalPoints, Diagram, DiscreteGradient, Lines, MergeTree, MorseSmaleComplex, Polygons,
                      SimplifiedField, Tracks)

__all__ = ["CriticalPoints", "Diagram", "DiscreteGradient", "DistributedMesh", "Error", "Lines", "MergeTree", "Mesh", "MorseSmaleComplex",
           "Polygons", "SimplifiedField", "Tracks", "__version__", "configuration", "read", "read_steps", "track"]


def configuration() -> Dict[str, Any]:
    """What this GALE is and was built with, for reports of defects: `version`, `commit` (empty where the sources came without
    a history), `kokkos`, its `backends`, `options` (libraries that it has), `compiler`."""
    return dict(_gale.configuration())


atexit.register(_gale.finalize)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_gale.after_fork)
