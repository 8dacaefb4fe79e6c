"""Runs programs several times, and keeps what they say."""
import json
import os
import re
import statistics
import subprocess
import tempfile
import time
from pathlib import Path


class Machine:
    """What runs experiments: the programs, and by experiment the rows that came out of them."""

    def __init__(self, options=None):
        self.options = options
        self.size = options.size if options else None
        self.cores = len(os.sched_getaffinity(0))
        self.threads = options.threads or self.cores if options else None
        self.about = {}
        self.rows = {}
        self.missing = []
        self.began = time.time()
        self.environment = dict(os.environ, OMP_PROC_BIND="false", OMP_WAIT_POLICY="passive")

    def begin(self, experiment):
        self.experiment = experiment
        self.rows[experiment] = []

    def add(self, **row):
        self.rows[self.experiment].append(row)

    def miss(self, what, why):
        """Remembers what could not be run."""
        self.missing.append({"experiment": self.experiment, "what": what, "why": why.strip().splitlines()[-1] if why.strip() else "?"})

    def run(self, *arguments):
        """What a program prints; nothing if it fails, which is remembered."""
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

    @property
    def sizes(self):
        from experiments import SIZES
        return SIZES[self.size]

    def save(self, file):
        file.write_text(json.dumps({"size": self.size, "cores": self.cores, "threads": self.threads, "about": self.about,
                                    "seconds": time.time() - self.began, "missing": self.missing, "rows": self.rows}, indent=1))

    @classmethod
    def load(cls, file):
        machine = cls()
        data = json.loads(file.read_text())
        machine.size, machine.cores, machine.threads = data["size"], data["cores"], data["threads"]
        machine.about, machine.missing, machine.rows = data["about"], data["missing"], data["rows"]
        return machine


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
