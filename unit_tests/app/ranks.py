"""What the tests of the command on several ranks share."""
import json
import os
import subprocess
import unittest
import xml.etree.ElementTree

import gale

MPIEXEC = os.environ.get("MPIEXEC")
RANKS = (2, 3, 7)

needs_mpi = unittest.skipUnless(MPIEXEC, "this gale was built without MPI")


class RanksTest(gale.CommandTest):
    def launcher(self, ranks):
        return [MPIEXEC, "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1",
                "-n", str(ranks), gale.GALE]

    def launch(self, ranks, *arguments):
        return subprocess.run([*self.launcher(ranks), *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=300)

    def report_of(self, ranks, *arguments):
        run = self.launch(ranks, *arguments, "--report", "ranks.json")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return json.loads((self.folder / "ranks.json").read_text())

    def expect_one_line(self, run, code, naming):
        lines = [line for line in run.stderr.split("\n") if line.startswith("gale: ")]
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertEqual(len(lines), 1, run.stderr)
        self.assertIn(naming, lines[0])

    def pieces(self, name):
        """The pieces that a .pvtp or .pvtu names. They have the arrays that it says, in its order."""
        file = xml.etree.ElementTree.parse(self.folder / name).getroot()[0]
        pieces = [gale.XmlFile(self.folder / piece.get("Source")) for piece in file.findall("Piece")]
        for kind in ("PointData", "CellData"):
            types = {array.get("Name"): array.get("type") for array in file.find("P" + kind) or ()}
            for piece in pieces:
                self.assertEqual(list(piece.types(kind).items()), list(types.items()))
        return pieces
