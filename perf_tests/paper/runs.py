"""Runs programs several times, and keeps what they say."""
import json
import os
import re
import resource
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

from sizes import SIZES


class Machine:
    """What runs experiments: the programs, and by experiment the rows that came out of them."""

    def __init__(self, options=None):
        self.options = options
        self.size = options.size if options else None
        self.sizes = dict(SIZES[self.size]) if options else {}
        if options and options.runs:
            self.sizes["runs"] = options.runs
        self.cores = len(os.sched_getaffinity(0))
        self.threads = options.threads or self.cores if options else None
        self.about = {}
        self.rows = {}
        self.missing = []
        self.took = {}  # by experiment: seconds, and processor seconds of all that ran
        self.began = time.time()
        self.environment = dict(os.environ, OMP_PROC_BIND="false", OMP_WAIT_POLICY="passive")

    def do(self, experiment, action):
        """Runs an experiment, which adds its rows, and remembers what it took."""
        self.experiment = experiment
        self.rows[experiment] = []
        began, used = time.time(), processor_seconds()
        action(self)
        self.took[experiment] = {"seconds": time.time() - began, "processor_seconds": processor_seconds() - used}

    def add(self, **row):
        self.rows[self.experiment].append(row)

    def miss(self, what, why):
        """Remembers what could not be run."""
        self.missing.append({"experiment": self.experiment, "what": what, "why": why.strip().splitlines()[-1] if why.strip() else "?"})

    def run(self, *arguments):
        """What a program prints; nothing if it fails, or if the time is over, which is remembered."""
        if self.options.time_limit and time.time() - self.began > self.options.time_limit:
            self.miss(" ".join(map(str, arguments[1:])), f"the {self.options.time_limit:g} seconds were over")
            return None
        done = subprocess.run([str(argument) for argument in arguments], capture_output=True, text=True, env=self.environment)
        if done.returncode == 0:
            return done.stdout
        self.miss(" ".join(map(str, arguments[1:])), done.stderr or f"exit code {done.returncode}")
        return None

    def reports(self, command, mesh, *arguments, runs=None):
        """The reports of several runs of the command on a mesh; none if one fails."""
        reports = []
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "report.json"
            for _ in range(runs or self.sizes["runs"]):
                if self.run(self.options.gale, command, mesh, "--quiet", "--report", file, *arguments) is None:
                    return []
                reports.append(json.loads(file.read_text()))
        for key in ("gale", "kokkos", "backend", "device"):
            self.about[key] = reports[0][key]
        return reports

    def numbers(self, pattern, *arguments, runs=None):
        """The named groups of a pattern in what several runs of a program print, as lists; none if one fails."""
        found = []
        for _ in range(runs or self.sizes["runs"]):
            printed = self.run(*arguments)
            match = printed is not None and re.search(pattern, printed)
            if not match:
                return {}
            found.append(match.groupdict())
        return {key: [float(one[key]) for one in found] for key in found[0]}

    def save(self, file):
        file.write_text(json.dumps({"size": self.size, "cores": self.cores, "threads": self.threads, "about": self.about,
                                    "took": self.took, "missing": self.missing, "rows": self.rows}, indent=1))

    @classmethod
    def load(cls, files):
        """What several runs on one machine saved, as one."""
        machine = cls()
        for file in files:
            data = json.loads(file.read_text())
            machine.size, machine.cores, machine.threads = data["size"], data["cores"], data["threads"]
            machine.about.update(data["about"])
            machine.took.update(data["took"])
            machine.missing += data["missing"]
            for experiment, rows in data["rows"].items():
                machine.rows.setdefault(experiment, []).extend(rows)
        return machine


def processor_seconds():
    """Processor seconds of all programs that this one has run: what else the machine does counts less there."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def spread(values):
    """Median, and how far the others are."""
    return {"median": statistics.median(values), "least": min(values), "most": max(values), "runs": len(values)}


def medians(reports, *path):
    """spread() of a number in reports."""
    values = []
    for report in reports:
        for key in path:
            report = report[key]
        values.append(report)
    return spread(values)
