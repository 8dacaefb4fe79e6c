"""Writes Exodus files of NetCDF's classic forms whose structure is wrong at random: variables removed, misnamed, of other types
and shapes, where others are, and with values that they shouldn't have.

usage: exodus_files.py COUNT FOLDER
"""
import copy
import random
import struct
import sys
from pathlib import Path

TYPES = {"b": 1, "c": 2, "h": 3, "i": 4, "f": 5, "d": 6, "B": 7, "H": 8, "I": 9, "q": 10, "Q": 11}
LIMITS = {"b": 127, "B": 255, "h": 32767, "H": 65535, "i": 2**31 - 1, "I": 2**32 - 1, "q": 2**63 - 1, "Q": 2**64 - 1}
POINTS = [[0, 1, 0, 0, 1, 2], [0, 0, 1, 0, 1, 0], [0, 0, 0, 1, 1, 1]]
CORNERS = [1, 2, 3, 4, 2, 3, 4, 5, 2, 5, 4, 6]
FIELD = [0.5, 3, 1, 4, -1, 5]


def padded(data):
    return data + bytes(-len(data) % 4)


class Variable:
    def __init__(self, name, dimensions, code, values, attributes=None):
        self.name, self.dimensions, self.code, self.values = name, dimensions, code, values
        self.attributes, self.shift = attributes or {}, 0

    def data(self):
        code = self.code.replace("c", "B")
        if code in LIMITS:
            most, least = LIMITS[code], -LIMITS[code] - 1 if code.islower() else 0
            values = [0 if v != v else max(least, min(most, int(max(-1e18, min(1e18, v))))) for v in self.values]
        else:
            values = [float(v) for v in self.values]
        return struct.pack(f">{len(values)}{code}", *values)


class NetCdf:
    """`dimensions`: name to length, of which 0 is the unlimited one, `records` long."""

    def __init__(self, version, dimensions, variables, records, word=8, large=True):
        self.version, self.dimensions, self.variables, self.records, self.word, self.large = version, dimensions, variables, records, word, large

    def number(self, value):
        return struct.pack(">Q" if self.version == 5 else ">I", value % (2**64 if self.version == 5 else 2**32))

    def text(self, text):
        return self.number(len(text)) + padded(text.encode())

    def attributes(self, values):
        if not values:
            return struct.pack(">I", 0) + self.number(0)
        data = struct.pack(">I", 12) + self.number(len(values))
        for name, value in values.items():
            data += self.text(name)
            if isinstance(value, str):
                data += struct.pack(">I", 2) + self.text(value)
            else:
                code = "i" if isinstance(value, int) else "f"
                data += struct.pack(">I", TYPES[code]) + self.number(1) + struct.pack(">" + code, value)
        return data

    def header(self, begins):
        names = list(self.dimensions)
        data = b"CDF" + bytes([self.version]) + self.number(self.records)
        data += struct.pack(">I", 10) + self.number(len(names))
        for name in names:
            data += self.text(name) + self.number(self.dimensions[name])
        data += self.attributes({"api_version": 5.2, "version": 5.2, "floating_point_word_size": self.word, "file_size": int(self.large), "title": "seed"})
        data += struct.pack(">I", 11) + self.number(len(self.variables))
        for variable, begin in zip(self.variables, begins):
            data += self.text(variable.name) + self.number(len(variable.dimensions))
            for name in variable.dimensions:
                data += self.number(names.index(name))
            data += self.attributes(variable.attributes) + struct.pack(">I", TYPES[variable.code]) + self.number(len(variable.data()))
            data += struct.pack(">I" if self.version == 1 else ">Q", begin % 2**32 if self.version == 1 else begin)
        return data

    def is_in_records(self, variable):
        return bool(variable.dimensions) and self.dimensions[variable.dimensions[0]] == 0

    def content(self):
        begins, at, data = [0] * len(self.variables), len(self.header([0] * len(self.variables))), b""
        rows = [[] for _ in range(self.records)]
        for k, variable in enumerate(self.variables):
            values = variable.data()
            if self.is_in_records(variable):
                step = -(-len(values) // max(1, self.records))
                begins[k] = sum(len(row) for row in rows[0]) if rows else 0
                for r, row in enumerate(rows):
                    row.append(padded(values[r * step:(r + 1) * step]))
            else:
                begins[k] = at + len(data)
                data += padded(values)
        for k, variable in enumerate(self.variables):
            begins[k] += (at + len(data) if self.is_in_records(variable) else 0) + variable.shift
        return self.header([max(0, begin) for begin in begins]) + data + b"".join(b"".join(row) for row in rows)


def exodus(version=2, real="d", times=2, names=("field", "other"), large=True):
    """Three tetrahedra of six points."""
    dimensions = {"len_string": 33, "len_name": 33, "time_step": 0, "num_dim": 3, "num_nodes": 6, "num_elem": 3, "num_el_blk": 2,
                  "num_el_in_blk1": 2, "num_nod_per_el1": 4, "num_el_in_blk2": 1, "num_nod_per_el2": 4, "num_nod_var": len(names)}
    variables = [Variable("time_whole", ["time_step"], "d", range(times)), Variable("eb_prop1", ["num_el_blk"], "i", [7, 9])]
    if large:
        variables += [Variable(f"coord{axis}", ["num_nodes"], real, values) for axis, values in zip("xyz", POINTS)]
    else:
        variables.append(Variable("coord", ["num_dim", "num_nodes"], real, sum(POINTS, [])))
    variables += [Variable("connect1", ["num_el_in_blk1", "num_nod_per_el1"], "i", CORNERS[:8], {"elem_type": "TETRA"}),
                  Variable("connect2", ["num_el_in_blk2", "num_nod_per_el2"], "i", CORNERS[8:], {"elem_type": "tet4"}),
                  Variable("name_nod_var", ["num_nod_var", "len_name"], "c", b"".join(name.encode().ljust(33, b"\0") for name in names))]
    fields = [[10 * k + value for value in FIELD] for k in range(len(names))]
    if large:
        variables += [Variable(f"vals_nod_var{k + 1}", ["time_step", "num_nodes"], real, field * times) for k, field in enumerate(fields)]
    else:
        variables.append(Variable("vals_nod_var", ["time_step", "num_nod_var", "num_nodes"], real, sum(fields, []) * times))
    return NetCdf(version, dimensions, variables, times, 8 if real == "d" else 4, large)


def exodus_shells():
    """Two quads and a triangle of six points, in a block each."""
    file = exodus()
    file.dimensions["num_nod_per_el2"] = 3
    blocks = {"connect1": ([1, 2, 5, 3, 2, 6, 5, 4], "SHELL4"), "connect2": ([6, 3, 1], "TRI3")}
    for variable in file.variables:
        if variable.name in blocks:
            variable.values, element = blocks[variable.name]
            variable.attributes = {"elem_type": element}
    return file


def change(file, choice):
    """One thing of it."""
    variable, other = choice.choice(file.variables), choice.choice(file.variables)
    dimension, second = choice.choice(list(file.dimensions)), choice.choice(list(file.dimensions))
    what = choice.randrange(10)
    if what == 0:
        file.variables.remove(variable)
    elif what == 1:
        length = file.dimensions[dimension]
        file.dimensions[dimension] = choice.choice([0, 1, length + 1, abs(length - 1), 2 * length, 2**20, 2**31 - 1, 2**32 - 1])
    elif what == 2:
        variable.name, other.name = other.name, variable.name
    elif what == 3:
        file.dimensions[dimension], file.dimensions[second] = file.dimensions[second], file.dimensions[dimension]
    elif what == 4:
        variable.code = choice.choice(list(TYPES) if file.version == 5 else list("bchifd"))
    elif what == 5:
        variable.values = list(variable.values)
        if variable.values:
            variable.values[choice.randrange(len(variable.values))] = choice.choice([float("nan"), float("inf"), -1, 0, 1e9, 1e18])
    elif what == 6:
        variable.shift = choice.choice([4, -4, 48, -200, 10**6, 2**31, -10**9])
    elif what == 7:
        file.records = choice.choice([0, 1, 3, 1000])
    elif what == 8:
        variable.dimensions = choice.choice([variable.dimensions[:1], variable.dimensions + [dimension], [dimension], []])
    else:
        variable.attributes = choice.choice([{}, {"elem_type": "HEX8"}, {"elem_type": 4.0}, {"elem_type": "SUPER"}, {"elem_type": "foo"}])


def main():
    count, folder = int(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    kinds = [exodus(version, real, large=large) for version in (1, 2, 5) for real in "fd" for large in (True, False)]
    kinds.append(exodus_shells())
    for number in range(count):
        choice = random.Random(number)
        file = copy.deepcopy(choice.choice(kinds))
        for _ in range(choice.choice([1, 1, 1, 2, 3])):
            if file.variables:
                change(file, choice)
        content = file.content()
        if choice.random() < 0.1:
            content = content[:choice.randrange(len(content))]
        (folder / f"strange_{number}.e").write_bytes(content)


if __name__ == "__main__":
    main()
