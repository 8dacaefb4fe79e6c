"""The script of the paper's experiments, at its smallest size, and what it makes of them."""
import csv
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import gale

SCRIPT = Path(__file__).parents[2] / "perf_tests" / "paper" / "paper.py"


def paper(*arguments):
    return subprocess.run([sys.executable, "-B", SCRIPT, *map(str, arguments)], capture_output=True, text=True, timeout=300)


class Paper(gale.CommandTest):
    def rows(self, name):
        with open(self.folder / f"{name}.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_all_that_the_command_can_run(self):
        run = paper("--gale", gale.GALE, "--size", "smallest", "--out", self.folder)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        data = json.loads((self.folder / "results.json").read_text())

        self.assertEqual([row["vertices"] for row in self.rows("meshes")], ["512", "1000"])
        ways = {row["way"] for row in self.rows("algorithms")}
        explicit = os.environ["GALE_ENABLE_KOKKOS_KERNELS"] == "1"
        device = data["about"].get("device")
        self.assertEqual(ways, {"gale", "leaders", "inline", "task-parallel"} | ({"explicit"} if explicit else set())
                         | ({"gale, host's consumers"} if device else set()))
        results = {}  # one for all ways of an algorithm on a mesh
        for row in data["rows"]["algorithms"] + data["rows"]["consumers"]:
            self.assertEqual(results.setdefault((row["algorithm"], row["mesh"]), row["result"]), row["result"])
            self.assertGreater(row["seconds"]["total"]["median"], 0)
        self.assertEqual(len(results), 6)
        for row in data["rows"]["waiting"]:
            self.assertEqual(len(row["of_each"]), row["consumers"])
            for stage, longest in row["stages"].items():
                self.assertEqual(longest["median"], max(one[stage] for one in row["of_each"]))
        self.assertEqual({row["queue_for_each"] for row in self.rows("queues")}, {"kernel", "relation"})
        self.assertEqual([row["value"] for row in self.rows("blocks")], ["1", "2"])

        missing = {one["what"] for one in data["missing"]}
        self.assertLessEqual({"TTK's modules", "ACTOPO", "seven relations by threads a segment"}, missing)
        self.assertGreater(data["took"]["algorithms"]["processor_seconds"], 0)
        page = (self.folder / "results.md").read_text()
        for title in ("Three algorithms on all meshes", "What consumers wait for", "Not run"):
            self.assertIn(f"## {title}", page)

        again = self.folder / "again"
        run = paper("--from", self.folder / "results.json", "--out", again, "--no-pictures")
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        self.assertEqual((again / "results.md").read_text(), page)

    def test_says_what_cannot_be_run_and_why(self):
        broken = self.folder / "broken"
        broken.write_text("#!/bin/sh\necho 'no such thing' >&2\nexit 3\n")
        broken.chmod(0o755)
        run = paper("--gale", gale.GALE, "--size", "smallest", "--only", "ttk", "--ttk-modules", broken, "--out", self.folder)
        self.assertEqual(run.returncode, 0)
        missing = json.loads((self.folder / "results.json").read_text())["missing"]
        self.assertEqual({one["why"] for one in missing}, {"no such thing"})
        self.assertIn("| ttk | smooth:8 critical-points explicit", (self.folder / "results.md").read_text())

    def test_parts_of_it_are_put_together(self):
        for name, limit in (("meshes", "100"), ("blocks", "0.000001")):
            run = paper("--gale", gale.GALE, "--size", "smallest", "--only", name, "--runs", 2, "--time-limit", limit, "--out",
                        self.folder / name)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
        whole = self.folder / "whole"
        files = [self.folder / name / "results.json" for name in ("meshes", "blocks")]
        self.assertEqual(paper("--from", *files, "--out", whole).returncode, 0)
        page = (whole / "results.md").read_text()
        self.assertIn("| Stent | grid:10 | 1000 |", page)
        self.assertIn("the 1e-06 seconds were over", page)
        self.assertFalse((whole / "blocks.csv").exists())


if __name__ == "__main__":
    unittest.main()
