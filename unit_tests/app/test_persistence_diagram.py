"""gale persistence-diagram: counts that other programs find too; its files against each other; what it refuses."""
import ast
import csv
import os
import struct
import subprocess
import unittest
import zipfile

import gale

INIA = "/usr/share/mricron/templates/inia19-t1-brain.nii.gz"


class DiagramTest(gale.CommandTest):
    def result(self, *arguments):
        result = self.report("persistence-diagram", *arguments)["result"]
        self.assertEqual(list(result), ["pairs", "essential"])
        return result["pairs"], result["essential"]


class Counts(DiagramTest):
    def test_of_a_grid(self):
        for structure in [*gale.STRUCTURES, "task-parallel"]:
            for threads in ("1", "3"):
                with self.subTest(structure=structure, threads=threads):
                    self.assertEqual(self.result("grid:64", "--structure", structure, "-t", threads), ([133, 223, 40], [1, 0, 0, 0]))

    def test_add_up_to_the_critical_simplices(self):
        pairs, essential = self.result("grid:32")
        critical = self.report("discrete-gradient", "grid:32")["result"]["critical"]
        ends = [pairs[0], pairs[0] + pairs[1], pairs[1] + pairs[2], pairs[2]]
        self.assertEqual([a + b for a, b in zip(ends, essential)], critical)

    @gale.needs_vtk
    @unittest.skipUnless(os.path.exists(INIA), "needs Debian's mricron-data")
    def test_of_a_volume(self):
        known = {"0": [20443, 44535, 13979], "1%": [5310, 9265, 540], "30%": [0, 4, 0]}
        for threshold, pairs in known.items():
            with self.subTest(threshold=threshold):
                self.assertEqual(self.result(INIA, "--above", "0", "--persistence", threshold), (pairs, [1, 0, 0, 0]))

    def test_are_printed(self):
        printed = self.succeed("persistence-diagram", "grid:64")
        for line in ("minimum-saddle +133", "saddle-saddle +223", "saddle-maximum +40", "essential +1, 0, 0, 0"):
            self.assertRegex(printed, rf"(?m)^{line}$")

    def test_are_optimal_for_simplified_complexes_of_a_grid(self):
        for threshold in ("0.5%", "1%", "3%", "10%", "30%"):
            with self.subTest(threshold=threshold):
                pairs, essential = self.result("grid:64", "--persistence", threshold)
                result = self.report("morse-smale", "grid:64", "--persistence", threshold)["result"]
                ends = [pairs[0], pairs[0] + pairs[1], pairs[1] + pairs[2], pairs[2]]
                self.assertEqual(result["critical"], [a + b for a, b in zip(ends, essential)])
                self.assertEqual(result["kept_below"], {"several_paths": 0, "no_path": 0})


@gale.needs_vtk
class Files(DiagramTest):
    def diagram(self, *arguments):
        self.succeed("persistence-diagram", *arguments, "-o", "diagram.vtu")
        return gale.XmlFile(self.folder / "diagram.vtu")

    def test_have_a_line_for_each_pair_and_the_diagonal(self):
        diagram = self.diagram("grid:32")
        points, cells = diagram.point_arrays, diagram.cell_arrays
        self.assertEqual(list(points), ["Coordinates", "ttkVertexScalarField", "CriticalType"])
        self.assertEqual(diagram.types("CellData"), {"PairIdentifier": "Int32", "PairType": "Int8", "Persistence": "Float32", "Birth": "Float32", "IsFinite": "UInt8"})
        lines = diagram.cells("Cells")
        self.assertEqual(cells["PairIdentifier"], [*range(len(lines) - 1), -1])
        self.assertEqual(cells["PairType"].count(0), self.result("grid:32")[0][0] + 1)
        for line, kind, persistence, birth, finite in list(zip(lines, *(cells[name] for name in ("PairType", "Persistence", "Birth", "IsFinite"))))[:-1]:
            (x0, y0, _), (x1, y1, _) = (diagram.points[p] for p in line)
            self.assertEqual((x0, y0, x1), (birth, birth, birth))
            self.assertEqual(persistence, gale.to_float(y1 - y0))
            self.assertEqual([points["CriticalType"][p] for p in line], [kind, kind + 1 if finite else 3])
        for vertex, place in zip(points["ttkVertexScalarField"], points["Coordinates"]):
            self.assertEqual(place, (vertex % 32, vertex // 32 % 32, vertex // 32 ** 2))

    def column(self, npy):
        """The numbers in a file of NumPy's."""
        size = struct.unpack("<H", npy[8:10])[0]
        header = ast.literal_eval(npy[10:10 + size].decode())
        self.assertEqual((npy[:8], (10 + size) % 64, npy[9 + size:10 + size]), (b"\x93NUMPY\1\0", 0, b"\n"))
        values = struct.unpack(f"<{header['shape'][0]}{ {'<i4': 'i', '<f8': 'd'}[header['descr']] }", npy[10 + size:])
        return [float(value) for value in values]

    def test_agree_on_what_persists(self):
        self.succeed("persistence-diagram", "grid:32", "--curve", "curve.csv")
        with open(self.folder / "curve.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.succeed("persistence-diagram", "grid:32", "--curve", "curve.npz")
        with zipfile.ZipFile(self.folder / "curve.npz") as archive:
            self.assertIsNone(archive.testzip())
            for name in archive.namelist():
                self.assertEqual(self.column(archive.read(name)), [float(row[name[:-4]]) for row in rows])
        self.assertEqual(archive.namelist(), [f"{name}.npy" for name in rows[0]])
        for row in rows[:: max(1, len(rows) // 7)]:
            pairs, _ = self.result("grid:32", "--persistence", row["Persistence"])
            self.assertEqual([int(row[name]) for name in ("MinimumSaddle", "SaddleSaddle", "SaddleMaximum", "All")], pairs + [sum(pairs)])


class Pictures(gale.DrawingTest):
    @gale.needs_vtk
    def test_are_drawn_on_a_display_that_no_one_sees(self):
        self.expect_drawn((1200, 560), "persistence-diagram", "grid:16")

    def test_are_refused_where_they_cannot_be(self):
        self.expect_refused("persistence-diagram")

    def test_are_drawn_by_a_module_beside_the_command(self):
        alone = self.copy_of_command()
        run = subprocess.run([alone, "persistence-diagram", "grid:4", "--render", "picture.png"], cwd=self.folder, capture_output=True,
                             text=True, timeout=60)
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r"\Agale: pictures \(--render\) are drawn by gale-drawing.so, which isn't beside [^\n]+\n\Z")
        module = self.folder / "gale-drawing.so"
        module.write_text("no library")
        run = subprocess.run([alone, "persistence-diagram", "grid:4", "--render", "picture.png"], cwd=self.folder, capture_output=True,
                             text=True, timeout=60)
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r"\Agale: cannot draw \(--render\): [^\n]*gale-drawing.so: [^\n]+\n\Z")
        self.assertEqual(self.names(), ["gale", "gale-drawing.so"])


class Refusals(DiagramTest):
    def test_of_other_extensions(self):
        self.refuse(2, "persistence-diagram", "grid:4", "-o", "diagram.vtp", naming=".vtu")
        self.refuse(2, "persistence-diagram", "grid:4", "--curve", "curve.txt", naming=".csv")

    def test_of_what_is_no_persistence(self):
        for value in ("-1", "x", "1%%", "nan"):
            self.refuse(2, "persistence-diagram", "grid:4", f"--persistence={value}", naming="--persistence")

    def test_of_one_file_for_two(self):
        self.refuse(2, "persistence-diagram", "grid:4", "--curve", "a.csv", "--report", "a.csv", naming="a.csv")

    def test_of_extrema_only_without_persistence(self):
        self.refuse(2, "morse-smale", "grid:4", "--extrema-only", naming="--extrema-only")


if __name__ == "__main__":
    unittest.main()
