"""Meshes on the ranks of MPI, by mpi4py; on_ranks.py compares."""
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import gale


@unittest.skipUnless(hasattr(gale._gale, "DistributedMesh"), "gale is built without MPI")
@unittest.skipUnless(shutil.which("mpirun"), "there is no mpirun")
class OnRanks(unittest.TestCase):
    def test_results_are_those_of_one_rank(self):
        try:
            import mpi4py  # noqa: F401
        except ImportError as missing:
            self.skipTest(str(missing))
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                           OMPI_MCA_rmaps_base_oversubscribe="1", OMP_NUM_THREADS="1")
        for ranks in (1, 3):
            run = subprocess.run(["mpirun", "-n", str(ranks), sys.executable, "-B",
                                  str(Path(__file__).with_name("on_ranks.py"))],
                                 env=environment, capture_output=True, text=True, timeout=120)
            self.assertEqual((run.returncode, run.stdout.split()), (0, ["equal"] * ranks), run.stderr)


if __name__ == "__main__":
    unittest.main()
