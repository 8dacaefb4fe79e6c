"""For Sphinx: scripts/docs.sh builds the site."""
import sys
import types
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "bindings" / "python"))

# The Python part of the package is enough to describe it.
compiled = types.ModuleType("gale._gale")
compiled.Error = type("Error", (ValueError,), {"__doc__": "What GALE refuses, and why.", "__module__": "gale"})
compiled.Mesh = type("Mesh", (), {})
compiled.version = compiled.configuration = compiled.finalize = compiled.after_fork = lambda: None
sys.modules["gale._gale"] = compiled
pyvista = types.ModuleType("pyvista")
pyvista.register_dataset_accessor = lambda *_: lambda accessor: accessor
for grid in ("UnstructuredGrid", "StructuredGrid", "RectilinearGrid", "ImageData"):
    setattr(pyvista, grid, object)
sys.modules["pyvista"] = pyvista

project = "GALE"
author = copyright = "The GALE developers"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinxcontrib.mermaid"]
autodoc_typehints = "description"
autodoc_member_order = "bysource"
myst_enable_extensions = ["colon_fence"]
myst_fence_as_directive = ["mermaid"]
myst_heading_anchors = 3
exclude_patterns = ["_build"]
html_theme = "furo"
html_title = "GALE"
html_static_path = ["style"]
html_css_files = ["site.css"]
