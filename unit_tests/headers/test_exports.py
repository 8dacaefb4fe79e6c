"""What is marked GALE_EXPORT, against what has to be where symbols are hidden, as in shared libraries: all that public
headers declare and sources define, what one library or the command takes of another, and what a program takes that
instantiates every public template (unit_tests/install/every_template). Static libraries of a build with tests are
compiled so that each symbol says whether it is hidden.
usage test_exports.py SOURCE_DIR --public HEADER... [--readelf PROGRAM --linked NAME FILE... [--linked ...]] --program SOURCE_DIR"""
import argparse
import re
import subprocess
import sys
import unittest
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("source", type=Path)
parser.add_argument("--public", nargs="+")
parser.add_argument("--readelf")
parser.add_argument("--linked", nargs="+", action="append", default=[])
parser.add_argument("--program", type=Path)
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


def marked_classes():
    """The names of those that are marked, in any header."""
    texts = (header.read_text() for header in arguments.source.rglob("*.hpp"))
    return {name for text in texts for name in re.findall(r"\b(?:class|struct)\s+GALE_EXPORT\s+(\w+)", text)}


def public_templates(header):
    """The names of functions and classes of a public header that are templates, but for those that are nobody's to use."""
    text = (arguments.source / header).read_text()
    text = re.sub(r"^namespace detail \{.*?^\}  // namespace detail|^ private:.*?^\};", "", text, flags=re.M | re.S)
    declared = re.findall(r"^ *template <[^{;]*?>\s+(?!using|inline constexpr)([^;{]*)", re.sub(r"//.*", "", text), re.M)
    for _ in range(3):
        declared = [re.sub(r"<[^<>]*>", "", one) for one in declared]
    names = (re.match(r"(?:class|struct)\s+(\w+)|.*?(\w+)\(", one, re.S) for one in declared)
    return {name.group(1) or name.group(2) for name in names if name}


class Library:
    """The symbols of ours that files define or lack. Those that a shared library of them would hide are not in `shown`."""

    def __init__(self, files):
        output = subprocess.run([arguments.readelf, "--syms", "--wide", *files], capture_output=True, text=True, check=True).stdout
        rows = re.findall(r"(?:GLOBAL|WEAK|UNIQUE) +(\w+) +(\w+) (_Z\w*?4gale\w+)", output)
        self.defined = {name for _, where, name in rows if where != "UND"}
        self.lacking = {name for _, where, name in rows if where == "UND"} - self.defined
        self.shown = self.defined - {name for visibility, _, name in rows if visibility != "DEFAULT"}


class Exports(unittest.TestCase):
    def test_types_of_headers_have_names_of_their_own(self):
        """Link-time checks (scripts/test-compilers.sh) see those templates alone that the library makes, not what a program would."""
        headers = {}
        for header in sorted(arguments.source.rglob("*.hpp")):
            begins = r"^(?:class|struct)\s+(?:GALE_EXPORT\s+)?(\w+)(?:\s+final)?(?:\s*:[^:;{][^;{]*)?\s*\{"
            for name in re.findall(begins, header.read_text(), re.M):
                headers.setdefault(name, []).append(str(header.relative_to(arguments.source)))
        self.assertGreater(len(headers), 300)
        self.assertEqual({name: where for name, where in headers.items() if len(where) > 1}, {})

    def test_functions_of_public_headers_are_marked(self):
        functions = [s for header in arguments.public for s in statements(header) if declares_function(s)]
        self.assertGreater(len(functions), 30)
        inline = {"gather"}  # declared, and defined below in the header
        self.assertEqual([f for f in functions if "GALE_EXPORT" not in f and not re.search(r"(\w+)\(", f).group(1) in inline], [])

    def test_classes_of_public_headers_are_marked(self):
        sources = (source.read_text() for source in arguments.source.rglob("*.cpp"))
        defined = {name for text in sources for name in re.findall(r"\b(\w+)(?=::(?:~?\w+|operator\S+)\()", text)}
        with_sources = [name for header in arguments.public for name in map(class_of, statements(header)) if name in defined]
        self.assertGreater(len(with_sources), 5)
        self.assertEqual(sorted(set(with_sources) - marked_classes()), [])

    def test_the_program_names_every_public_template(self):
        program = "\n".join(source.read_text() for source in arguments.program.glob("*.cpp"))
        templates = set().union(*map(public_templates, arguments.public))
        self.assertGreater(len(templates), 20)
        self.assertEqual({name for name in templates if not re.search(rf"\b{name}\b", program)}, set())

    def test_what_others_link_is_exported(self):
        libraries = {name: Library(files) for name, *files in arguments.linked}
        self.assertGreater(sum(len(library.defined - library.shown) for library in libraries.values()), 100)
        taken = 0
        for name, library in libraries.items():
            for other in libraries.values():
                found = library.lacking & other.defined
                with self.subTest(by=name):
                    self.assertEqual(found - other.shown, set())
                taken += len(found)
        self.assertGreater(taken, 100)


if __name__ == "__main__":
    if not arguments.linked:
        del Exports.test_what_others_link_is_exported  # of libraries that don't say what they hide
    unittest.main(argv=sys.argv[:1])
