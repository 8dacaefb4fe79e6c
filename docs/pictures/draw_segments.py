"""Draws segments.svg, a mesh in four segments, and block.svg, the block of VV for one of them. usage: draw_segments.py FOLDER"""
import sys
from pathlib import Path

# Rows of points, each its place and GALE's id: 0 to 11 blue, 12 to 19 orange, 20 to 27 green, 28 to 39 red.
ROWS = [
    [(43, 29, 0), (117, 30, 1), (178, 37, 2), (272, 48, 3), (337, 32, 12), (401, 34, 13), (461, 29, 14), (532, 52, 15)],
    [(59, 119, 4), (128, 101, 5), (185, 114, 6), (266, 120, 7), (341, 98, 16), (403, 115, 17), (470, 101, 18), (539, 99, 19)],
    [(62, 190, 8), (121, 174, 9), (201, 182, 10), (271, 190, 11), (330, 178, 28), (403, 178, 29), (461, 175, 30), (549, 167, 31)],
    [(37, 254, 20), (114, 251, 21), (189, 246, 22), (274, 241, 23), (328, 242, 32), (404, 244, 33), (466, 257, 34), (535, 252, 35)],
    [(61, 309, 24), (108, 312, 25), (197, 323, 26), (253, 315, 27), (321, 319, 36), (387, 326, 37), (481, 333, 38), (547, 333, 39)],
]
BEGIN = [0, 12, 20, 28, 40]  # of the segments
DARK = ["#3259c8", "#d98a1f", "#2f9a57", "#c83232"]
LIGHT = ["#bcd3f2", "#f6d9a8", "#bfe3c6", "#f0c0c0"]
GREEN, RED = 2, 3

place = {id: (x, y) for row in ROWS for x, y, id in row}
triangles = []
for above, below in zip(ROWS, ROWS[1:]):
    for i in range(len(above) - 1):
        a, b, c, d = above[i][2], above[i + 1][2], below[i][2], below[i + 1][2]
        triangles += [(a, b, d), (a, c, d)]


def segment_of(vertex):
    return next(s for s in range(4) if vertex < BEGIN[s + 1])


def picture(width, height, shapes):
    return "\n".join([f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {width} {height}' width='{width}' height='{height}' font-family='sans-serif' font-size='14'>",
                      f"<rect width='{width}' height='{height}' fill='white'/>", *shapes, "</svg>\n"])


def text(x, y, words, more=""):
    return f"<text x='{x}' y='{y}' {more}>{words}</text>".replace(" >", ">")


def segments():
    shapes = []
    for triangle in triangles:
        corners = " ".join(f"{x},{y}" for x, y in map(place.get, triangle))
        shapes.append(f"<polygon points='{corners}' fill='{LIGHT[segment_of(min(triangle))]}' stroke='#888'/>")
    external = [t for t in triangles if segment_of(min(t)) != RED and any(segment_of(v) == RED for v in t)]
    for a, b in sorted({(min(u, v), max(u, v)) for t in external for u in t for v in t if u != v}):
        shapes.append("<line x1='{}' y1='{}' x2='{}' y2='{}' stroke='#c83232' stroke-width='2.5' stroke-dasharray='5 3'/>".format(*place[a], *place[b]))
    for vertex, (x, y) in sorted(place.items()):
        shapes.append(f"<circle cx='{x}' cy='{y}' r='11' fill='{DARK[segment_of(vertex)]}'/>" + text(x, y + 4, vertex, "text-anchor='middle' fill='white' font-size='11'"))
    shapes.append(text(30, 372, "Colours: four segments; a triangle has that of its lowest vertex."))
    shapes.append(text(30, 392, "Dashed: the triangles that are external to the red segment."))
    return picture(590, 405, shapes)


def block():
    vertices = range(BEGIN[GREEN], BEGIN[GREEN + 1])
    rows = [sorted({u for t in triangles if vertex in t for u in t} - {vertex}) for vertex in vertices]
    offsets = [sum(map(len, rows[:i])) for i in range(len(rows) + 1)]
    shapes = [text(15, 25, "The block of VV for the green segment, whose vertices are 20 to 27"), text(15, 73, "offsets"), text(15, 163, "ids")]
    left, wide, cell = 70, 40, 24
    for i, offset in enumerate(offsets):
        x = left + i * (wide + 52)
        entry = left + offset * cell
        if i < len(rows):
            shapes.append(text(x + wide / 2, 45, vertices[i], f"text-anchor='middle' font-size='12' fill='{DARK[GREEN]}'"))
        shapes.append(f"<line x1='{x + wide / 2}' y1='82' x2='{entry + (cell / 2 if i < len(rows) else 0)}' y2='142' stroke='#666'/>")
        shapes.append(f"<rect x='{x}' y='54' width='{wide}' height='28' fill='#eee' stroke='#666'/>" + text(x + wide / 2, 73, offset, "text-anchor='middle'"))
    for i, row in enumerate(rows):
        for k, vertex in enumerate(row):
            x = left + (offsets[i] + k) * cell
            shapes.append(f"<rect x='{x}' y='144' width='{cell}' height='28' fill='{LIGHT[segment_of(vertex)]}' stroke='#aaa'/>" + text(x + cell / 2, 162, vertex, "text-anchor='middle' font-size='12'"))
        shapes.append(f"<rect x='{left + offsets[i] * cell}' y='144' width='{len(row) * cell}' height='28' fill='none' stroke='#333' stroke-width='1.5'/>")
    at = vertices.index(22)
    neighbours = ", ".join(map(str, rows[at]))
    shapes.append(text(15, 202, f"Entries {offsets[at]} to {offsets[at + 1] - 1} are the row of vertex 22: its neighbours {neighbours}.", "font-size='13'"))
    shapes.append(text(15, 222, "All are GALE's ids, ascending, here in the colour of their segment. Nothing is padded.", "font-size='13'"))
    return picture(left + offsets[-1] * cell + 20, 236, shapes)


folder = Path(sys.argv[1])
(folder / "segments.svg").write_text(segments())
(folder / "block.svg").write_text(block())
