"""Mesh and critical points of grid:N from arrays of Python's, beside `gale critical-points grid:N --mesh written`.

    mesh_times.py --command build/bin/gale [-n N] [--turns TURNS] [--device]

Python and the command run in turns, each in a process of its own; medians and extremes are printed, in seconds by the
clock: from points, tetrahedra and field in memory to the points found, and what the command reports as seconds.total.
--device has Python's arrays in a device's memory too (libcudart is needed for that, and a GALE with CUDA).
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))


def one_run(where, file):
    """Prints the seconds that the mesh takes, and those of its critical points."""
    import gale
    import numpy

    given = numpy.load(file)
    points, tetrahedra, field = given["points"], given["tetrahedra"], given["field"]
    gale.Mesh(points[:4], [[0, 1, 2, 3]]).critical_points(field[:4])  # begins Kokkos
    if where == "device":
        sys.path.insert(0, os.path.join(HERE, "../../bindings/python/tests"))
        from test_device import OnDevice, cuda_runtime

        runtime = cuda_runtime()
        points, tetrahedra, field = (OnDevice(runtime, array) for array in (points, tetrahedra, field))
    begin = time.perf_counter()
    mesh = gale.Mesh(points, tetrahedra)
    middle = time.perf_counter()
    mesh.critical_points(field)
    print(middle - begin, time.perf_counter() - middle)


def turn_of_python(where, file):
    call = [sys.executable, __file__, "--one", where, "--file", file]
    return [float(word) for word in subprocess.run(call, check=True, capture_output=True, text=True).stdout.split()]


def turn_of_command(options):
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.json")
        call = [options.command, "critical-points", f"grid:{options.n}", "--mesh", "written", "--quiet", "--report", report]
        subprocess.run(call, check=True)
        with open(report) as file:
            return [json.load(file)["seconds"]["total"]]


def told(seconds):
    return f"{statistics.median(seconds):.4f} ({min(seconds):.4f} to {max(seconds):.4f})"


def measure(options, file):
    ways = {"the command": lambda: turn_of_command(options), "numpy": lambda: turn_of_python("host", file)}
    if options.device:
        ways["device"] = lambda: turn_of_python("device", file)
    turns = {name: [] for name in ways}
    for _ in range(options.turns):
        for name, turn in ways.items():
            turns[name].append(turn())
    print(f"grid:{options.n}, {options.turns} turns\n| | mesh | critical points | both | of the command's |\n|---|---|---|---|---|")
    command = statistics.median(seconds for seconds, in turns["the command"])
    for name, taken in turns.items():
        both = [sum(seconds) for seconds in taken]
        parts = [told(seconds) for seconds in zip(*taken)] if name != "the command" else ["", ""]
        print(f"| {name} | {parts[0]} | {parts[1]} | {told(both)} | {statistics.median(both) / command:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--command", default="gale")
    parser.add_argument("-n", type=int, default=128)
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--device", action="store_true")
    parser.add_argument("--one", help=argparse.SUPPRESS)
    parser.add_argument("--file", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.one:
        return one_run(options.one, options.file)
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "input.npz")
        make = [sys.executable, os.path.join(HERE, "relation_times.py"), "--make", "-n", str(options.n), "--file", file]
        subprocess.run(make, check=True)
        measure(options, file)


if __name__ == "__main__":
    main()
