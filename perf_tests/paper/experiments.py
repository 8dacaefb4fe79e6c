"""The experiments. Each adds rows to its machine."""
import statistics

from runs import medians, spread

ALGORITHMS = {"critical points": "critical-points", "discrete gradient": "discrete-gradient", "Morse-Smale complex": "morse-smale"}
WAYS = ["gale", "leaders", "inline", "explicit", "task-parallel"]
STAGES = ["push", "queue", "preparation", "kernel_and_transfer", "integration"]
SEVEN = ["EF", "ET", "FT", "VF", "VV", "VE", "VT"]


def meshes(machine):
    for name, mesh in machine.sizes["meshes"].items():
        for report in machine.reports("discrete-gradient", mesh, "--structure", "inline", "-t", machine.threads, runs=1):
            counts = report["mesh"]
            info = machine.reports("relations", mesh, "--relation", "FE", runs=1)
            faces = info[0]["mesh"] if info else counts
            machine.add(mesh=name, input=mesh, vertices=counts["vertices"], edges=faces["edges"], triangles=faces["triangles"],
                        tetrahedra=counts["tetrahedra"], segments=counts["segments"])


def add_run(machine, reports, **row):
    if not reports:
        return
    seconds = {phase: medians(reports, "seconds", phase) for phase in ("segment", "initialize", "run", "total")}
    machine.add(**row, way_taken=reports[0]["way"], consumers_on=reports[0]["consumers"], seconds=seconds,
                peak_bytes=medians(reports, "memory", "host_peak_bytes"), result=reports[0]["result"])


def algorithms(machine):
    """Time by phase and memory: three algorithms, all meshes, all ways."""
    for title, command in ALGORITHMS.items():
        for name, mesh in machine.sizes["meshes"].items():
            for way in WAYS:
                add_run(machine, machine.reports(command, mesh, "--structure", way, "-t", machine.threads), algorithm=title,
                        mesh=name, way=way, consumers=machine.threads)
            if machine.about.get("device"):
                add_run(machine, machine.reports(command, mesh, "--consumers", "host", "-t", machine.threads),
                        algorithm=title, mesh=name, way="gale, host's consumers", consumers=machine.threads)


def stent(machine):
    return machine.sizes["meshes"]["Stent"]


def consumers(machine):
    """How each way scales with consumers."""
    for title in ("critical points", "discrete gradient"):
        for way in ("gale", "leaders", "task-parallel", "explicit"):
            for count in machine.sizes["consumers"]:
                more = ["--consumers", "host"] if way == "gale" and machine.about.get("device") else []
                add_run(machine, machine.reports(ALGORITHMS[title], stent(machine), "--structure", way, "-t", count, *more),
                        algorithm=title, mesh="Stent", way=way, consumers=count)


def waiting(machine):
    """What consumers wait for, in five stages, the longest of any consumer, as in the paper; of each; and how many
    requests leaders found waiting."""
    for title, command in ALGORITHMS.items():
        for count in machine.sizes["consumers"]:
            reports = machine.reports(command, stent(machine), "--structure", "leaders", "-t", count)
            if not reports:
                continue
            each = [report["waiting"]["stages_of_each"] for report in reports]
            stages = {stage: spread([max(one[stage] for one in run) if run else 0 for run in each]) for stage in STAGES + ["total"]}
            lengths = [leader["queue_lengths"] for report in reports for leader in report["waiting"]["leaders"]]
            machine.add(algorithm=title, consumers=count, requests=medians(reports, "waiting", "requests"),
                        seconds=medians(reports, "seconds", "run"), stages=stages, of_each=each[0],
                        queue_lengths={key: statistics.mean(one[key] for one in lengths) for key in ("mean", "median", "deviation")})


def queues(machine):
    """A queue for each kernel, which makes several relations, and a queue for each relation."""
    for title, command in ALGORITHMS.items():
        for kind in ("kernel", "relation"):
            reports = machine.reports(command, stent(machine), "--structure", "leaders", "--queues", kind, "-t", machine.threads)
            if reports:
                machine.add(algorithm=title, queue_for_each=kind, seconds=medians(reports, "seconds", "run"),
                            queues=len(reports[0]["waiting"]["leaders"]), requests=medians(reports, "waiting", "requests"))


def segment_threads(machine):
    """Threads for a segment, seven relations: the kernels alone, over the whole mesh."""
    if machine.options.relation_rates is None:
        return machine.miss("seven relations by threads a segment", "--relation-rates was not given")
    size = stent(machine).split(":")[1]
    for relation in SEVEN:
        printed = machine.run(machine.options.relation_rates, size, 64, relation)
        for line in (printed or "").splitlines():
            words = line.split()
            if words and words[0] == relation:
                machine.add(relation=relation, threads=int(words[1]), milliseconds=float(words[5]))


def studied(machine, option, values):
    for name in machine.sizes["studied"]:
        for value in values[:machine.sizes["values"]]:
            reports = machine.reports("critical-points", machine.sizes["meshes"][name], "--structure", "leaders", "-t",
                                      machine.threads, option, value)
            if reports:
                machine.add(mesh=name, value=value, seconds=medians(reports, "seconds", "run"),
                            peak_bytes=medians(reports, "memory", "host_peak_bytes"))


def block_threads(machine):
    studied(machine, "--threads-per-block", [32, 64, 128, 256, 512, 1024])


def blocks(machine):
    studied(machine, "--blocks-per-request", [1, 2, 4, 8, 16, 32])


def ttk(machine):
    """TTK's own modules, on TTK's explicit triangulation and on GALE's."""
    if machine.options.ttk_modules is None:
        return machine.miss("TTK's modules", "--ttk-modules was not given")
    pattern = (r"setup (?P<setup>[\d.]+) precondition (?P<precondition>[\d.]+) run (?P<run>[\d.]+) total (?P<total>[\d.]+) s, "
               r"of processors (?P<processors>[\d.]+) s; peak (?P<peak>[\d.]+) MB")
    for title, command in ALGORITHMS.items():
        for name, mesh in machine.sizes["meshes"].items():
            for kind in ("explicit", "gale"):
                found = machine.numbers(pattern, machine.options.ttk_modules, mesh, command, kind, machine.threads)
                if found:
                    machine.add(algorithm=title, mesh=name, triangulation=kind,
                                **{key: spread(values) for key, values in found.items()})


def actopo(machine):
    """ACTOPO's repository on grid:N, half of the threads producers."""
    if machine.options.actopo is None:
        return machine.miss("ACTOPO", "--actopo was not given")
    pattern = r"precond (?P<precondition>[\d.]+) run (?P<run>[\d.]+) total (?P<total>[\d.]+) s \| peak (?P<peak>[\d.]+) MB"
    half = max(machine.threads // 2, 1)
    for title, short in (("critical points", "cp"), ("discrete gradient", "dg")):
        for kind, threads, producers in (("explicit", machine.threads, 1), ("actopo", half, 1)):
            found = machine.numbers(pattern, machine.options.actopo, stent(machine), kind, short, threads, producers)
            if found:
                machine.add(algorithm=title, mesh="Stent", structure=kind, **{key: spread(values) for key, values in found.items()})
