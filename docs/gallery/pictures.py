"""What the gallery's scripts share: colours, surfaces, and small files."""
import numpy as np
from PIL import Image

NAMES = ["minima", "1-saddles", "2-saddles", "maxima"]
COLORS = np.array([[50, 90, 200], [60, 180, 120], [240, 170, 60], [210, 50, 50]], np.uint8)  # of the four dimensions


def triangles_of(mesh, chosen):
    """The chosen triangles of a mesh as a pyvista.PolyData."""
    import pyvista

    corners = mesh.relation("FV")[1].reshape(-1, 3)[chosen]
    return pyvista.PolyData(mesh.points, np.insert(corners.astype(np.int64), 0, 3, axis=1).ravel())


def surface_of(mesh):
    """Where a mesh ends: its triangles that have one tetrahedron."""
    return triangles_of(mesh, np.diff(mesh.relation("FT")[0]) == 1)


def save(picture, path):
    """Writes an image with 256 colours, for which it takes a fraction of the bytes."""
    image = Image.fromarray(np.ascontiguousarray(picture[..., :3]))
    image.quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(path, optimize=True)


def save_figure(figure, path):
    figure.canvas.draw()
    save(np.asarray(figure.canvas.buffer_rgba()), path)
