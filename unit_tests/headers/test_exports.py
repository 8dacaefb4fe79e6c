"""What is marked GALE_EXPORT, against what has to be where symbols are hidden, as in shared libraries: all that public
headers declare and sources define, and what one library or the command takes of another.
usage test_exports.py SOURCE_DIR NM --public HEADER... --linked NAME FILE... [--linked ...]"""
import argparse
import re
import subprocess
import sys
import unittest
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("source", type=Path)
parser.add_argument("nm")
parser.add_argument("--public", nargs="+")
parser.add_argument("--linked", nargs="+", action="append", default=[])
arguments = parser.parse_args()


def statements(header):
    """What a header has at the level of namespaces, one by one and without comments: each up to its ; or {."""
    lines = re.sub(r"///?.*", "", (arguments.source / header).read_text()).split("\n")
    begins = [i for i, line in enumerate(lines) if re.match(r"[A-Za-z[]", line)]
    return [re.match(r"[^;{]*[;{]?", "\n".join(lines[i:j])).group() for i, j in zip(begins, begins[1:] + [len(lines)])]


def declares_function(statement):
    return statement.endswith(";") and "(" in statement and not re.match(r"(using|inline|static|enum|friend|KOKKOS_)", statement)


def class_of(statement):
    """The class that a statement begins the definition of, if it does."""
    match = re.match(r"(?:class|struct)\s+(?:GALE_EXPORT\s+)?(\w+)[^;]*\{\Z", statement)
    return match and match.group(1)


def marked():
    """The names of functions and of classes that are marked, in any header."""
    functions, classes = set(), set()
    for header in arguments.source.rglob("*.hpp"):
        text = header.read_text()
        functions.update(re.findall(r"\bGALE_EXPORT\b[^;{(]*?\b(\w+)\(", text))
        classes.update(re.findall(r"\b(?:class|struct)\s+GALE_EXPORT\s+(\w+)", text))
    return functions, classes


def names_in(symbol):
    """The names in a mangled one: gale, Mesh, vertices."""
    rest, names = re.sub(r"\A_ZT?[VIST]?(Th\w+?_)?N?K?", "", symbol), []
    while match := re.match(r"\d+", rest):
        end = match.end() + int(match.group())
        names.append(rest[match.end():end])
        rest = rest[end:]
    return names


def symbols(files, option):
    """Those of ours that are defined in files, or that these lack."""
    output = subprocess.run([arguments.nm, option, *files], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"\b(_Z\w*?4gale\w+)$", output, re.M))


class Exports(unittest.TestCase):
    def test_functions_of_public_headers_are_marked(self):
        functions = [s for header in arguments.public for s in statements(header) if declares_function(s)]
        self.assertGreater(len(functions), 30)
        inline = {"gather"}  # declared, and defined below in the header
        self.assertEqual([f for f in functions if "GALE_EXPORT" not in f and not re.search(r"(\w+)\(", f).group(1) in inline], [])

    def test_classes_of_public_headers_are_marked(self):
        sources = "\n".join(source.read_text() for source in arguments.source.rglob("*.cpp"))
        with_sources = [name for header in arguments.public for name in map(class_of, statements(header))
                        if name and re.search(rf"\b{name}::(~?\w+|operator\S+)\(", sources)]
        self.assertGreater(len(with_sources), 5)
        self.assertEqual(sorted(set(with_sources) - marked()[1]), [])

    def test_what_is_linked_between_libraries_is_marked(self):
        functions, classes = marked()
        defined = {name: symbols(files, "--defined-only") for name, *files in arguments.linked}
        taken = 0
        for name, *files in arguments.linked:
            of_others = set().union(*(defined[other] for other in defined if other != name))
            for symbol in symbols(files, "--undefined-only") & of_others - defined[name]:
                with self.subTest(by=name, symbol=symbol):
                    names = names_in(symbol)
                    self.assertTrue(names and (names[-1] in functions or classes & set(names)), names)
                taken += 1
        self.assertGreater(taken, 10)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
