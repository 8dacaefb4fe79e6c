"""Does the C++ in the documents compile? A block with a main() is a program by itself; any other is a part of one, and
stands here in a function that has what the pages speak of (FRAME). What is only parsed takes some seconds.
usage test_documents.py COMPILER --standard YEAR [--flag=FLAG...] --define NAME... --include DIRECTORY... --page FILE..."""
import argparse
import concurrent.futures
import re
import subprocess
import sys
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("compiler")
parser.add_argument("--standard", required=True)
parser.add_argument("--flag", action="append", default=[])
for name in ("--define", "--include", "--page"):
    parser.add_argument(name, nargs="*", default=[])
options = parser.parse_args()

FRAME = """
#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/gathered_gradient.hpp>
#include <gale/algorithms/merge_tree.hpp>
#include <gale/algorithms/persistence.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/algorithms/simplify.hpp>
#include <gale/mesh/make_mesh.hpp>
#include <gale/relations/faces.hpp>
#include <gale/runtime/device_sweep.hpp>
#include <gale/runtime/graph_of.hpp>
#include <gale/runtime/make_structure.hpp>
#ifdef WITH_MPI
#include <gale/distributed/distributed_mesh.hpp>
#endif
struct Functor {
  template <class Team, class Rows>
  KOKKOS_FUNCTION void operator()(const Team&, const Rows&) const {}
};
template <class... Any>
KOKKOS_FUNCTION void use(const Any&...) {}
"""
GIVEN = """int argc, char** argv, int provided, const gale::WorkerSpace& space, const gale::Mesh& mesh, gale::Structure* structure,
    Kokkos::View<double* [3], Kokkos::HostSpace> points, Kokkos::View<std::int64_t* [4], Kokkos::HostSpace> tetrahedra,
    Kokkos::View<std::int64_t*, Kokkos::HostSpace> vertex_ids, Kokkos::View<std::int64_t*, Kokkos::HostSpace> cell_ids,
    Kokkos::View<double*, Kokkos::HostSpace> values, Kokkos::View<double*> field, gale::NamedSimplices named, Functor functor,
    gale::Id vertex, gale::Id tetrahedron, double threshold"""


def blocks_of(page):
    """The C++ of a page, each with the line after which it begins."""
    text = Path(page).read_text()
    for block in re.finditer(r"^(?:```cpp|\\code\{\.cpp\})\n(.*?)^(?:```|\\endcode)$", text, re.MULTILINE | re.DOTALL):
        yield f'#line {text[: block.start(1)].count(chr(10)) + 1} "{page}"\n{block[1]}'


def errors_of(source):
    command = [options.compiler, f"-std=c++{options.standard}", "-w", "-fopenmp", "-fsyntax-only", "-x", "c++", *options.flag]
    command += [f"-D{one}" for one in options.define if one]
    command += [f"-I{one}" for one in options.include if one not in ("", "/usr/include")]
    done = subprocess.run([*command, "-"], input=source, capture_output=True, text=True, check=False)
    return done.returncode and done.stderr


if any(page.endswith("many_ranks.md") for page in options.page):
    options.define.append("WITH_MPI")
blocks = [block for page in options.page for block in blocks_of(page)]
programs = [block for block in blocks if "int main(" in block]
parts = [block for block in blocks if block not in programs]
functions = [f"void part_{i}({GIVEN}) {{ {{\n{part}}} }}\n" for i, part in enumerate(parts)]
with concurrent.futures.ThreadPoolExecutor() as threads:
    wrong = [found for found in threads.map(errors_of, ["".join([FRAME, *functions]), *programs]) if found]
print(f"{len(programs)} programs and {len(parts)} parts of programs on {len(options.page)} pages")
sys.exit("\n".join(wrong) if wrong or not programs or not parts else 0)
