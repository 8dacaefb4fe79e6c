"""A command whose calls fail where they are told to."""
import os
import shutil
import subprocess
import tempfile
from collections import namedtuple
from pathlib import Path

GALE = os.environ["GALE"]
SHIM = os.environ["GALE_FAULT_SHIM"]

Run = namedtuple("Run", "how code calls failed output names")


class FaultyCommand:
    """Runs one command line again and again, each time with another fault and in an empty folder, but for `files`: their
    names and contents."""

    def __init__(self, arguments, files=None):
        self.folder = Path(tempfile.mkdtemp(prefix="gale_faults_", dir="/dev/shm" if os.path.isdir("/dev/shm") else None))
        self.files = files or {}
        self.work = self.folder / "work"
        requests, self.to_server = os.pipe()
        from_server, answers = os.pipe()

        def arrange():  # descriptors 3 and 4, in whatever order they have numbers
            low, high = os.dup2(requests, 100), os.dup2(answers, 101)
            os.dup2(low, 3)
            os.dup2(high, 4)

        environment = dict(os.environ, GALE_FAULT_SERVER="1", LD_PRELOAD=SHIM, OMP_WAIT_POLICY="passive", OMP_PROC_BIND="false")
        self.server = subprocess.Popen([GALE, *map(str, arguments)], env=environment, stdin=subprocess.DEVNULL,
                                       preexec_fn=arrange, pass_fds=(3, 4, requests, answers))
        os.close(requests)
        os.close(answers)
        self.answers = os.fdopen(from_server)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.to_server)
        self.server.wait(timeout=60)
        self.answers.close()
        shutil.rmtree(self.folder)

    def run(self, kind="none", at=1, more=0, error=0, seconds=20):
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir()
        for name, content in self.files.items():
            (self.work / name).write_bytes(content)
        os.write(self.to_server, f"{kind} {at} {more} {error} {seconds} {self.work}\n".encode())
        how, code, calls, failed = self.answers.readline().split()
        output = Path(f"{self.work}.txt").read_text(errors="replace")
        return Run(how, int(code), int(calls), int(failed), output, sorted(path.name for path in self.work.iterdir()))

    def content(self, name):
        return (self.work / name).read_bytes()
