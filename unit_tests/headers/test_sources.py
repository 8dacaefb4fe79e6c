"""Does each source of a library compile alone? Builds that compile several at a time (GALE_ENABLE_CHEAP_BUILD) don't say
so when one lacks an include that another has. What is only parsed takes half a second a source.
usage test_sources.py COMPILER FOLDER --standard YEAR [--flag=FLAG...] --define NAME... --include DIRECTORY... --common <HEADER>... --source FILE..."""
import argparse
import concurrent.futures
import os
import subprocess
import sys
import tempfile
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("compiler")
parser.add_argument("folder", type=Path)
parser.add_argument("--standard", required=True)
parser.add_argument("--flag", action="append", default=[])
for name in ("--define", "--include", "--common", "--source"):
    parser.add_argument(name, nargs="*", default=[])
options = parser.parse_args()


def compiler(*more):
    command = [options.compiler, f"-std=c++{options.standard}", "-w", "-fopenmp", *options.flag] + [f"-D{one}" for one in options.define if one]
    command += [f"-I{one}" for one in options.include if one not in ("", "/usr/include")]
    return subprocess.run(command + list(more), capture_output=True, text=True, check=False)


def errors_of(source, common):
    done = compiler("-include", common, "-fsyntax-only", options.folder / source)
    return done.returncode and f"{source}: {done.stderr}"


with tempfile.TemporaryDirectory() as folder:
    common = Path(folder, "common.hpp")
    common.write_text("".join(f"#include {one}\n" for one in options.common))
    made = compiler("-x", "c++-header", common, "-o", f"{common}.gch")
    if made.returncode:
        sys.exit(made.stderr)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
        wrong = [found for found in threads.map(lambda one: errors_of(one, common), options.source) if found]
sys.exit("\n".join(wrong) if wrong or not options.source else 0)
