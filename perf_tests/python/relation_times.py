"""Relations of grid:N as numpy arrays beside `gale relations`, which writes nothing.

    relation_times.py --command build/bin/gale [-n N] [--turns TURNS] [--threads THREADS] [--warm GIB] [RELATION...]

Python and the command run in turns, each in a process of its own; medians are printed. By the clock Python counts from
points and tetrahedra in memory to the arrays, and the command what it reports as seconds.total, without reading. In
processor seconds, with the system's, the command counts whole, less what it says it reads. `again` is the same relation
of the same mesh once more.

--warm has another process touch so much memory before each turn. Some virtual machines give free memory back to their
host within seconds, and take up to six times as long to touch it first as memory that they have.
"""

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ALL = "VV VE VF VT EV EE EF ET FV FE FF FT TV TE TF TT"


def spent(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def make_input(n, file):
    """Writes the points, tetrahedra and field of grid:N as numpy has them."""
    import gale
    import numpy

    mesh, arrays = gale.read(f"grid:{n}")
    _, tetrahedra = mesh.relation("TV")
    numpy.savez(file, points=mesh.points, tetrahedra=tetrahedra.reshape(-1, 4), field=arrays["field"])


def one_relation(name, threads, file):
    """Prints the seconds of the first call, its processor seconds and those of the next, and the peak in MiB."""
    import gale
    import numpy

    given = numpy.load(file)
    points, tetrahedra = given["points"], given["tetrahedra"]
    gale.Mesh(points[:4], [[0, 1, 2, 3]])  # begins Kokkos
    before, begin = spent(resource.RUSAGE_SELF), time.perf_counter()
    mesh = gale.Mesh(points, tetrahedra)
    rows = mesh.relation(name, threads=threads)
    clock, first = time.perf_counter() - begin, spent(resource.RUSAGE_SELF) - before
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    del rows
    before = spent(resource.RUSAGE_SELF)
    mesh.relation(name, threads=threads)
    print(clock, first, spent(resource.RUSAGE_SELF) - before, peak)


def turn_of_python(name, options, file):
    call = [sys.executable, __file__, "--one", name, "--threads", str(options.threads), "--file", file]
    return [float(word) for word in subprocess.run(call, check=True, capture_output=True, text=True).stdout.split()]


def turn_of_command(name, options):
    with tempfile.NamedTemporaryFile() as report:
        call = [options.command, "relations", f"grid:{options.n}", "--relation", name, "--report", report.name]
        before = spent(resource.RUSAGE_CHILDREN)
        subprocess.run(call + ["--quiet", "--threads", str(options.threads)], check=True)
        seconds = spent(resource.RUSAGE_CHILDREN) - before
        with open(report.name) as file:  # the command has put a new one there
            said = json.load(file)
    told = said["seconds"]
    return [told["total"], seconds - told["read"], said["memory"]["host_peak_bytes"] / 2**20]


def touch_memory(gibibytes):
    if gibibytes > 0:
        subprocess.run([sys.executable, "-c", f"bytearray(b'1') * ({gibibytes} << 30)"], check=True)


def medians(turns):
    return [statistics.median(values) for values in zip(*turns)]


def measure(options, file):
    print(f"grid:{options.n}, {options.threads} threads, medians of {options.turns} turns")
    print("| | mesh to arrays | the command's total | of its speed | processor seconds | the command's | of its speed "
          "| again | peaks, MiB |\n|---|---|---|---|---|---|---|---|---|")
    for name in options.relations:
        python, command = [], []
        for turn in range(options.turns):
            for way in ("python", "command") if turn % 2 else ("command", "python"):
                touch_memory(options.warm)
                if way == "python":
                    python.append(turn_of_python(name, options, file))
                else:
                    command.append(turn_of_command(name, options))
        clock, whole, again, peak = medians(python)
        command_clock, command_whole, command_peak = medians(command)
        print(f"| {name} | {clock:.2f} s | {command_clock:.2f} s | {100 * command_clock / clock:.0f} % | {whole:.2f} "
              f"| {command_whole:.2f} | {100 * command_whole / whole:.0f} % | {again:.2f} "
              f"| {peak:.0f}, {command_peak:.0f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relations", nargs="*", default=ALL.split(), metavar="RELATION")
    parser.add_argument("--command", default="gale")
    parser.add_argument("-n", type=int, default=120)
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--warm", type=int, default=0, metavar="GIB")
    parser.add_argument("--make", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--one", help=argparse.SUPPRESS)
    parser.add_argument("--file", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.make:
        return make_input(options.n, options.file)
    if options.one:
        return one_relation(options.one, options.threads, options.file)
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "input.npz")
        subprocess.run([sys.executable, __file__, "--make", "-n", str(options.n), "--file", file], check=True)
        measure(options, file)


if __name__ == "__main__":
    main()
