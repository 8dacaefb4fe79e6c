"""A process that may have so much memory and no more: it ends right or says so, whatever the limit."""
import os
import resource
import subprocess
import tempfile
import unittest
from pathlib import Path

import commands

GALE = os.environ["GALE"]
STEP = 1 << 20 if os.environ.get("GALE_ALL_FAULTS") else 16 << 20


class Memory(unittest.TestCase):
    def run_with(self, limit, line, folder):
        return subprocess.run([GALE, *line], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60,
                              env=dict(os.environ, OMP_WAIT_POLICY="passive"),
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))

    def least(self, line, folder):
        """The least limit, roughly, with which the program gets as far as to load its libraries."""
        limit = 64 << 20
        while self.run_with(limit, ["--version"], folder).returncode != 0:
            limit += STEP
        return limit

    def test_limits(self):
        for line in (["critical-points", "grid:30", "--structure", "inline"], ["relations", "grid:20", "--relation", "FF"],
                     ["morse-smale", "grid:20", "--separatrices2", "-o", "out"],
                     ["merge-tree", "grid:30", "-o", "out"], ["simplify-field", "plane:150", "--persistence", "5%", "-o", "out.vtk"],
                     ["generate", "grid:20", "-o", "out.vtk"]):
            with self.subTest(line=line), tempfile.TemporaryDirectory() as folder:
                limit = self.least(line, folder)
                code = 1
                while code != 0:
                    run = self.run_with(limit, line + commands.ONE[:1] + ["--threads", "2"], folder)
                    code = run.returncode
                    if code != 0:
                        self.assertEqual((code, run.stdout), (1, ""), (limit, run.stderr))
                        self.assertRegex(run.stderr, r"\A(gale: [^\n]+|\nlibgomp: [^\n]+)\n\Z", limit)
                        self.assertEqual(list(Path(folder).iterdir()), [])
                    else:
                        self.assertEqual(any(Path(folder).iterdir()), "-o" in line)
                    limit += STEP


if __name__ == "__main__":
    unittest.main()
