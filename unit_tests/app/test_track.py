"""gale track against bumps that move, merge, appear and vanish where a few lines of Python say so."""
import csv
import math
import unittest

import gale

SIDE, WIDTH = 21, 0.08  # points along a side of the unit square; of a bump


def bumps_at(step):
    """The places and heights of the bumps, by name: B meets A, C comes and goes."""
    bumps = {"A": (0.2 + 0.03 * step, 0.3, 1.0), "B": (max(0.74 - 0.06 * step, 0.28 + 0.03 * step), 0.3, 0.9)}
    if 1 <= step <= 3:
        bumps["C"] = (0.75, 0.8, 0.8)
    return bumps


def field(step):
    return [sum(height * math.exp(-((x / (SIDE - 1) - left) ** 2 + (y / (SIDE - 1) - low) ** 2) / (2 * WIDTH ** 2))
                for left, low, height in bumps_at(step).values())
            for y in range(SIDE) for x in range(SIDE)]


@gale.needs_vtk
class Track(gale.CommandTest):
    def setUp(self):
        super().setUp()
        for step in range(6):
            values = " ".join(map(repr, field(step)))
            self.write(f"f{step}.vtk", "# vtk DataFile Version 3.0\n\nASCII\nDATASET STRUCTURED_POINTS\n"
                       f"DIMENSIONS {SIDE} {SIDE} 1\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA {SIDE * SIDE}\n"
                       f"SCALARS height double\nLOOKUP_TABLE default\n{values}\n")
        self.files = [f"f{step}.vtk" for step in range(6)]

    def test_of_bumps(self):
        report = self.report("track", *self.files, "--persistence", "0.1", "-o", "t.vtp", "--table", "t.csv", "--lift", "z:2")
        with open(self.folder / "t.csv", newline="") as file:
            rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
        maxima = [row for row in rows if row["CriticalType"] == 3]

        def number(place):
            x, y, _ = place
            return round(x * (SIDE - 1)) + SIDE * round(y * (SIDE - 1))

        # Where two bumps are less than two widths apart they are one: A and B from step 4 on, 0.12 and 0.09 apart.
        by_first = {(row["FirstStep"], row["FirstVertex"]): row for row in maxima}
        a, b, c = (by_first[first, number(bumps_at(first)[name])] for first, name in ((0, "A"), (0, "B"), (1, "C")))
        self.assertEqual(len(maxima), 3)
        self.assertEqual((a["LastStep"], a["Begin"], a["End"], a["EndTrack"]), (5, 0, 0, -1))
        self.assertEqual((b["LastStep"], b["Begin"], b["End"], b["EndTrack"]), (4 - 1, 0, 1, a["TrackId"]))
        self.assertEqual((c["LastStep"], c["Begin"], c["BeginTrack"], c["End"], c["EndTrack"]), (3, 2, -1, 2, -1))
        self.assertEqual([row["TrackId"] for row in rows], list(range(len(rows))))
        self.assertEqual(report["result"]["tracks"], len(rows))
        self.assertEqual([step["result"]["maxima"] for step in report["steps"]], [2, 3, 3, 3, 1, 1])
        self.assertEqual(self.names().count("t.vtp"), 1)
        self.assertIn('Name="LinkType"', (self.folder / "t.vtp").read_bytes().decode(errors="replace"))

    def test_refuses(self):
        self.refuse(2, "track", "f0.vtk", naming="f0.vtk")
        self.succeed("generate", "plane:9", "-o", "other.vtk")
        before = self.names()
        self.refuse(1, "track", "f0.vtk", "f1.vtk", "other.vtk", "-a", "height", "-o", "t.vtp", naming="")
        self.refuse(2, "track", "f0.vtk", "f1.vtk", "-o", "t.vtu", naming="t.vtu")
        self.refuse(2, "track", "f0.vtk", "f1.vtk", "-o", "t.vtp", "--table", "t.csv", "--report", "t.csv", naming="t.csv")
        for lift in ("w", "z:", "z:1x", "zz", "z:inf"):
            self.refuse(2, "track", "f0.vtk", "f1.vtk", "--lift", lift, naming=lift)
        self.assertEqual(self.names(), before)


if __name__ == "__main__":
    unittest.main()
