"""What the gallery's scripts share: colours, surfaces, paths, legends, and small files."""
import numpy as np
from PIL import Image

ONE = ["minimum", "1-saddle", "2-saddle", "maximum"]
NAMES = ["minima", "1-saddles", "2-saddles", "maxima"]
COLORS = np.array([[50, 90, 200], [60, 180, 120], [240, 170, 60], [210, 50, 50]], np.uint8)  # of the four dimensions
DESCENDING, ASCENDING = 0, 2  # of SeparatrixType


def triangles_of(mesh, chosen):
    """The chosen triangles of a mesh as a pyvista.PolyData."""
    import pyvista

    corners = mesh.relation("FV")[1].reshape(-1, 3)[chosen]
    return pyvista.PolyData(mesh.points, np.insert(corners.astype(np.int64), 0, 3, axis=1).ravel())


def surface_of(mesh):
    """Where a mesh ends: its triangles that have one tetrahedron."""
    return triangles_of(mesh, np.diff(mesh.relation("FT")[0]) == 1)


def paths_of(separatrices1, kind, steps):
    """The separatrices of a type that occurs, as smooth lines: each point but the ends is moved towards the middle of its
    neighbours, since a path runs from simplex to simplex."""
    import pyvista

    points, lines = [np.empty((0, 3))], []
    for line in np.flatnonzero(separatrices1.cell_arrays["SeparatrixType"] == kind):
        begin, end = separatrices1.offsets[line:line + 2]
        path = separatrices1.points[separatrices1.connectivity[begin:end]].astype(float)
        for _ in range(steps):
            path[1:-1] = path[1:-1] / 2 + (path[:-2] + path[2:]) / 4
        lines.append(np.append(len(path), np.arange(len(path)) + sum(map(len, points))))
        points.append(path)
    return pyvista.PolyData(np.concatenate(points), lines=np.concatenate(lines))


def add_paths(plotter, separatrices1, radius, steps=30):
    """Adds the paths down to minima and up to maxima as tubes. Returns the legend's entries for those that there are."""
    legend = []
    for kind, dimension, name in ((DESCENDING, 0, "paths down to minima"), (ASCENDING, 3, "paths up to maxima")):
        if (separatrices1.cell_arrays["SeparatrixType"] == kind).any():
            tubes = paths_of(separatrices1, kind, steps).tube(radius=radius)
            plotter.add_mesh(tubes, color=COLORS[dimension].tolist(), ambient=0.35)
            legend.append(("line", dimension, name))
    return legend


def add_critical(plotter, critical, size):
    """Adds critical simplices as balls, extrema larger than saddles. Returns the legend's entries for those that there are."""
    dimensions, legend = critical["CellDimension"], []
    for dimension, (one, several) in enumerate(zip(ONE, NAMES)):
        chosen = critical.points[dimensions == dimension]
        if len(chosen):
            larger = 1 if dimension in (1, 2) else 1.6
            plotter.add_points(chosen, color=COLORS[dimension].tolist(), point_size=larger * size, render_points_as_spheres=True)
            legend.append(("ball", dimension, f"{len(chosen)} {one if len(chosen) == 1 else several}"))
    return legend


def add_legend(picture, legend, width=230):
    """The picture without its white margins, with a legend on its right: a (mark, dimension or color, text) for each line."""
    from PIL import ImageDraw, ImageFont

    inked = np.argwhere((picture[..., :3] < 250).any(axis=2))
    (top, left), (bottom, right) = inked.min(axis=0), inked.max(axis=0) + 1
    drawn = picture[top:bottom, left:right, :3]
    image = Image.new("RGB", (drawn.shape[1] + width + 40, drawn.shape[0] + 20), "white")
    image.paste(Image.fromarray(np.ascontiguousarray(drawn)), (10, 10))
    draw, font = ImageDraw.Draw(image), ImageFont.load_default(17)
    x, y = drawn.shape[1] + 30, (image.height - 30 * len(legend)) // 2 + 15
    for mark, color, text in legend:
        color = tuple(map(int, COLORS[color] if isinstance(color, int) else color))
        if mark == "ball":
            draw.ellipse((x + 8, y - 8, x + 24, y + 8), fill=color)
        else:
            half = 2 if mark == "line" else 8
            draw.rectangle((x, y - half, x + 32, y + half), fill=color)
        draw.text((x + 44, y), text, "black", font, anchor="lm")
        y += 30
    return np.asarray(image)


def save(picture, path):
    """Writes an image with 256 colours, for which it takes a fraction of the bytes."""
    image = Image.fromarray(np.ascontiguousarray(picture[..., :3]))
    image.quantize(256, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(path, optimize=True)


def save_figure(figure, path):
    figure.canvas.draw()
    save(np.asarray(figure.canvas.buffer_rgba()), path)
