"""Meshes on the ranks of MPI, by mpi4py; on_ranks.py compares."""
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import gale

HERE = Path(__file__).parent


@unittest.skipUnless(hasattr(gale._gale, "DistributedMesh"), "gale is built without MPI")
@unittest.skipUnless(shutil.which("mpirun"), "there is no mpirun")
class OnRanks(unittest.TestCase):
    def said_by(self, ranks, script, *arguments):
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                           OMPI_MCA_rmaps_base_oversubscribe="1", OMP_NUM_THREADS="1")
        run = subprocess.run(["mpirun", "-n", str(ranks), sys.executable, "-B", str(script), *arguments], env=environment,
                             capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout.splitlines()

    def require(self, name):
        done = subprocess.run([sys.executable, "-c", f"import {name}"], capture_output=True, text=True)  # not here: it starts MPI
        if done.returncode != 0:
            self.skipTest(done.stderr.strip().splitlines()[-1])

    def test_results_are_those_of_one_rank(self):
        self.require("mpi4py")
        for ranks in (1, 3):
            self.assertEqual(self.said_by(ranks, HERE / "on_ranks.py"), ["equal"] * ranks)

    def test_a_simulation_is_analysed_alike_on_any_ranks(self):
        self.require("dolfinx")
        script = HERE.parents[2] / "docs" / "gallery" / "simulation_on_ranks.py"
        alone = self.said_by(1, script, "6", "1")
        self.assertEqual(len(alone), 2)
        self.assertRegex(alone[0], r"step 0: [1-9]\d* minima")
        self.assertEqual(self.said_by(3, script, "6", "1"), alone)


if __name__ == "__main__":
    unittest.main()
