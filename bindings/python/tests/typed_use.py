"""For mypy --strict: right uses pass, and it says of each wrong one what is marked here."""
import gale
import numpy as np

mesh, arrays = gale.read("grid:4", above=None)
critical: gale.CriticalPoints = mesh.critical_points(arrays["field"], progress=True)
types: np.ndarray = critical["CriticalType"]
offsets: np.ndarray = mesh.morse_smale(arrays["field"], persistence="3%").separatrices1.offsets
version: str = gale.__version__
complex = mesh.morse_smale(arrays["field"], separatrices2=True)
names: list[str] = list(complex.keys()) + list(complex.critical_points)
counts: int = len(complex) + len(complex.separatrices1)
same: bool = complex == mesh.morse_smale(arrays["field"]) and "DestinationId" in complex.separatrices1
indptr, indices = mesh.relation("VT", progress=lambda done, of: None)

mesh.relation(3)  # type: ignore[arg-type]
mesh.vertices()  # type: ignore[operator]
mesh.critical_point(arrays["field"])  # type: ignore[attr-defined]
wrong: gale.Lines = mesh.critical_points(arrays["field"])  # type: ignore[assignment]
complex.critical_points[3]  # type: ignore[index]
