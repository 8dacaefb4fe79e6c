"""Runs the command with random options on mutated and on whole files: it must end with 0, or with 1 or 2 and one line,
in time, and leave the files it says or none.

usage: GALE=COMMAND fuzz_command.py CORPUS [--count N] [--from I] [--finds FOLDER]
"""
import argparse
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

GALE = os.environ["GALE"]
COMMANDS = ["info", "segment", "critical-points", "discrete-gradient", "morse-smale", "persistence-diagram", "merge-tree", "simplify-field", "track", "relations", "generate"]
VALUES = ["0", "1", "-1", "2", "3", "1000", "2147483648", "99999999999999999999", "nan", "inf", "", "x", "1e3", "5%", "0.5", "1k"]
OUTPUTS = ["out.vtp", "out.vtu", "out.vtk", "out", "missing/out.vtp", ".", "out.json", "/dev/null", "/dev/full", "input.vtu"]
OPTIONS = {
    "--structure": ["gale", "inline", "explicit", "task-parallel", "fast"], "--threads": ["1", "2", "3", "0", "1025"],
    "--capacity": VALUES, "--segments": ["field", "ids", "nothing"], "--above": VALUES, "--height": ["x", "y", "z", "w"], "--array": ["field", "pairs", "pairs_1", "no"],
    "--host-memory": ["1k", "64k", "1MiB", "0", "1GiB"], "--device-memory": ["1MiB"], "--blocks-per-request": VALUES,
    "--threads-per-block": ["1", "32"], "--threads-per-segment": ["1", "32"], "--report": OUTPUTS, "-o": OUTPUTS, "--output": OUTPUTS,
    "--relation": ["VV", "VT", "EF", "FF", "TT", "EE", "XX", "vv"], "--dump": OUTPUTS, "--arrows": OUTPUTS, "--table": OUTPUTS, "--lift": ["x", "z:2", "w", "z:"],
    "--persistence": ["1", "5%", "0", "-1", "nan", "101%"], "--formulation": ["stars", "cells"], "--type": ["join", "split", "contour", "oak"], "--arc-samples": VALUES, "--cores": ["1", "2"]}
FLAGS = ["--quiet", "--verify", "--cells=tetrahedra", "--cells=simplices", "--separatrices2", "--no-saddle-connectors", "--no-descending-separatrices",
         "--no-ascending-segmentation", "--help", "--bogus"]


def mutated(content, choice):
    """Some bytes of it changed, its end cut: the in-process fuzzer has the finer ways."""
    content = bytearray(content)
    for _ in range(choice.choice([0, 0, 0, 1, 2, 5])):
        if content:
            content[choice.randrange(len(content))] = choice.choice(b"0123456789-.<>\"\n \x00\xff")
    return bytes(content[:choice.randrange(len(content))]) if content and choice.random() < 0.1 else bytes(content)


def command_line(seeds, folder, choice):
    line = [choice.choice(COMMANDS)]
    if choice.random() < 0.3:
        line.append(choice.choice(["grid:4", "grid:9", "plane:7", "plane:x", "grid:1", "grid:x", "grid:99999", "missing.vtu"]))
    else:
        seed = choice.choice(seeds)
        name = "input" + ("." + seed.name.split(".", 1)[1] if seed.suffix != ".vtk" else ".vtk")
        (folder / name).write_bytes(mutated(seed.read_bytes(), choice))
        companion = Path(f"{seed}.raw")
        if companion.exists():
            (folder / "input.raw").write_bytes(companion.read_bytes())
        line.append(name)
    for _ in range(choice.randrange(5)):
        option = choice.choice(list(OPTIONS))
        line += [option, choice.choice(OPTIONS[option])]
    line += choice.sample(FLAGS, choice.choice([0, 0, 1, 1, 2]))
    if line[0] == "relations" and choice.random() < 0.8:
        line += ["--relation", choice.choice(OPTIONS["--relation"])]
    return line


def complaint_about(line, folder):
    before = set(path.name for path in folder.rglob("*"))
    try:
        run = subprocess.run([GALE, *line], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", timeout=20)
    except subprocess.TimeoutExpired:
        return "it took more than 20 s"
    left = set(path.name for path in folder.rglob("*")) - before
    if run.returncode not in (0, 1, 2):
        return f"it ended with {run.returncode}: {run.stderr[-300:]}"
    if run.returncode == 0 and run.stderr:
        return f"it succeeded but said {run.stderr!r}"
    if run.returncode != 0 and not re.fullmatch(r"gale: [^\n]+\n", run.stderr):
        return f"it failed and said {run.stderr!r}"
    if any(name.endswith(".part") for name in left) or (run.returncode != 0 and left):
        return f"it ended with {run.returncode} and left {sorted(left)}"
    return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("corpus", type=Path)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--from", type=int, default=0, dest="first")
    parser.add_argument("--finds", type=Path, default=Path("finds"))
    options = parser.parse_args()
    seeds = sorted(path for path in options.corpus.iterdir() if path.suffix != ".raw")
    finds = 0
    for number in range(options.first, options.first + options.count):
        with tempfile.TemporaryDirectory(prefix="gale_fuzz_") as name:
            folder = Path(name)
            line = command_line(seeds, folder, random.Random(number))
            complaint = complaint_about(line, folder)
            if complaint:
                finds += 1
                shutil.copytree(folder, options.finds / f"command_{number}", dirs_exist_ok=True)
                print(f"{number}: gale {' '.join(map(repr, line))}: {complaint}", flush=True)
    print(f"{options.count} command lines tried from number {options.first}, {finds} finds")
    return 1 if finds else 0


if __name__ == "__main__":
    sys.exit(main())
