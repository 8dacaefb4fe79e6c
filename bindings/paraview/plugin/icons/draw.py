"""Draws the plugin's icons, 48 by 48 points: usage draw.py [FOLDER]. Needs nothing but Python."""
import struct
import sys
import zlib
from pathlib import Path

SIZE, FINE = 48, 4  # points, and samples along each side of one
MINIMUM, SADDLE, MAXIMUM = (44, 105, 176), (236, 236, 236), (196, 52, 47)
LINE, EDGE = (64, 64, 64), (40, 40, 40)


def disc(x, y, radius, colour):
    """A layer: the colour of a place, or None."""
    def paint(px, py):
        distance = ((px - x) ** 2 + (py - y) ** 2) ** 0.5
        return colour if distance < radius - 1.5 else EDGE if distance < radius else None
    return paint


def line(x0, y0, x1, y1, width, colour):
    length = (x1 - x0) ** 2 + (y1 - y0) ** 2

    def paint(px, py):
        t = min(1, max(0, ((px - x0) * (x1 - x0) + (py - y0) * (y1 - y0)) / length))
        distance = ((px - x0 - t * (x1 - x0)) ** 2 + (py - y0 - t * (y1 - y0)) ** 2) ** 0.5
        return colour if distance < width / 2 else None
    return paint


def square(x, y, size, colour):
    def paint(px, py):
        if not (x <= px < x + size and y <= py < y + size):
            return None
        inside = x + 1.5 <= px < x + size - 1.5 and y + 1.5 <= py < y + size - 1.5
        return colour if inside else EDGE
    return paint


CRITICAL_POINTS = [disc(11, 37, 8, MINIMUM), disc(25, 24, 6, SADDLE), disc(37, 11, 8, MAXIMUM), disc(39, 38, 5, SADDLE),
                   disc(9, 13, 5, MAXIMUM)]
MORSE_SMALE = [line(9, 39, 24, 24, 4, MINIMUM), line(39, 39, 24, 24, 4, MINIMUM), line(9, 9, 24, 24, 4, MAXIMUM),
               line(39, 9, 24, 24, 4, MAXIMUM), disc(9, 39, 7, MINIMUM), disc(39, 39, 7, MINIMUM), disc(9, 9, 7, MAXIMUM),
               disc(39, 9, 7, MAXIMUM), disc(24, 24, 6, SADDLE)]
MERGE_TREE = [line(24, 8, 24, 20, 4, LINE), line(24, 20, 10, 40, 4, LINE), line(24, 20, 31, 29, 4, LINE),
              line(31, 29, 25, 40, 4, LINE), line(31, 29, 40, 40, 4, LINE), disc(24, 8, 7, MAXIMUM), disc(24, 20, 5, SADDLE),
              disc(31, 29, 5, SADDLE), disc(9, 40, 6, MINIMUM), disc(25, 40, 6, MINIMUM), disc(41, 40, 6, MINIMUM)]
SIMPLIFIED_FIELD = [line(3, 16, 11, 38, 4, MINIMUM), line(11, 38, 20, 21, 4, MINIMUM), line(20, 21, 28, 21, 4, SADDLE),
                    line(28, 21, 36, 8, 4, MAXIMUM), line(36, 8, 45, 30, 4, MAXIMUM), line(20, 21, 24, 30, 2, LINE),
                    line(24, 30, 28, 21, 2, LINE)]
SEGMENTATION = [square(4, 4, 20, (231, 179, 72)), square(24, 4, 10, (113, 170, 99)), square(34, 4, 10, (86, 142, 197)),
                square(24, 14, 10, (199, 96, 84)), square(34, 14, 10, (150, 122, 181)), square(4, 24, 20, (86, 142, 197)),
                square(24, 24, 20, (113, 170, 99))]


def sample(layers, x, y):
    for paint in reversed(layers):
        colour = paint(x, y)
        if colour:
            return (*colour, 255)
    return 0, 0, 0, 0


def point(layers, x, y):
    """The mean of a point's samples, weighted by how opaque they are."""
    samples = [sample(layers, x + (i + 0.5) / FINE, y + (j + 0.5) / FINE) for i in range(FINE) for j in range(FINE)]
    opaque = sum(alpha for *_, alpha in samples)
    colour = [round(sum(one[k] * one[3] for one in samples) / opaque) if opaque else 0 for k in range(3)]
    return bytes(colour + [round(opaque / len(samples))])


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(layers):
    rows = b"".join(b"\0" + b"".join(point(layers, x, y) for x in range(SIZE)) for y in range(SIZE))
    header = struct.pack(">2I5B", SIZE, SIZE, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


if __name__ == "__main__":
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent)
    for name, layers in (("critical_points", CRITICAL_POINTS), ("morse_smale", MORSE_SMALE), ("segmentation", SEGMENTATION),
                         ("merge_tree", MERGE_TREE), ("simplified_field", SIMPLIFIED_FIELD)):
        (folder / f"{name}.png").write_bytes(png(layers))
