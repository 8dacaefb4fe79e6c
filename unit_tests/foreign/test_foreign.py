"""Exodus and VTKHDF files, which gale-vtk-reader reads: the same results as from a .vtu, and one line for bad files."""
import os
import random
import shutil
import subprocess
import unittest
from pathlib import Path

import gale  # of the command's tests


class Foreign(gale.CommandTest):
    def convert(self, source, to, *times):
        subprocess.run([os.environ["GALE_WRITE_FOREIGN"], source, to, *times], cwd=self.folder, check=True, timeout=60)
        return to

    def mesh(self, size, to):
        self.succeed("generate", f"grid:{size}", "-o", "mesh.vtu")
        return self.convert("mesh.vtu", to)

    def test_results_are_those_of_the_same_mesh_in_a_vtu(self):
        self.succeed("generate", "grid:12", "-o", "mesh.vtu")
        self.succeed("critical-points", "mesh.vtu", "-o", "expected.vtp")
        expected = gale.read_vtp(self.folder / "expected.vtp")
        for name in ("mesh.e", "mesh.ex2", "mesh.exo", "mesh.vtkhdf"):
            with self.subTest(name):
                self.succeed("critical-points", self.convert("mesh.vtu", name), "-o", "found.vtp")
                self.assertEqual(gale.read_vtp(self.folder / "found.vtp"), expected)

    def test_of_several_times_the_first_is_read_and_the_others_noted(self):
        self.mesh(12, "once.e")
        self.convert("mesh.vtu", "often.e", "3")
        for name, notices in (("once.e", []), ("often.e", ["left out all but the first of 3 time steps"])):
            report = self.report("critical-points", name, "-o", f"{name}.vtp")
            self.assertEqual(report["notices"], notices)
        self.assertEqual(gale.read_vtp(self.folder / "often.e.vtp"), gale.read_vtp(self.folder / "once.e.vtp"))

    def test_image_is_split(self):
        self.convert("5", "image.vtkhdf")
        self.assertIn("ramp", self.succeed("info", "image.vtkhdf"))
        self.assertEqual(self.counts("image.vtkhdf"), [1, 0, 0, 1, 0])
        report = self.report("info", "image.vtkhdf", "--above", "8")
        # Of 125 points x + 2y + 3z is above 8 in these.
        above = sum(x + 2 * y + 3 * z > 8 for x in range(5) for y in range(5) for z in range(5))
        self.assertLessEqual(report["mesh"]["vertices"], above)
        self.assertGreater(report["mesh"]["vertices"], 60)

    def test_files_of_another_kind_are_refused(self):
        self.write("text.e", "no mesh")
        self.refuse(1, "info", "text.e", naming="it is no Exodus II file")
        self.write("text.hdf", "no mesh")
        self.refuse(1, "info", "text.hdf", naming="it is no VTKHDF file")
        self.write("empty.e", "")
        self.refuse(1, "info", "empty.e", naming="empty.e")
        self.refuse(1, "info", "absent.vtkhdf", naming="absent.vtkhdf")

    def test_damaged_files_end_in_one_line_or_a_mesh(self):
        random.seed(17)
        outcomes = set()
        for name in ("mesh.e", "mesh.vtkhdf"):
            content = (self.folder / self.mesh(5, name)).read_bytes()
            for turn in range(30):
                bad = bytearray(content)
                if turn % 3 == 0:
                    del bad[random.randrange(len(bad)):]
                for _ in range(turn):
                    if bad:
                        bad[random.randrange(len(bad))] = random.choice((0, 255, random.randrange(256)))
                file = self.write(f"bad{Path(name).suffix}", bytes(bad))
                run = self.gale("info", file)
                outcomes.add(run.returncode)
                if run.returncode == 0:
                    self.assertEqual(run.stderr, "")
                else:
                    self.assertEqual(run.returncode, 1, run.stderr)
                    self.assertRegex(run.stderr, r"\Agale: [^\n]+\n\Z")  # also about a coordinate that isn't finite
        self.assertEqual(outcomes, {0, 1})

    def test_program_is_looked_for_beside_the_command(self):
        alone = shutil.copy(gale.GALE, self.folder)
        self.mesh(4, "mesh.e")
        run = subprocess.run([alone, "info", "mesh.e"], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertRegex(run.stderr, r"\Agale: cannot read 'mesh.e': such files are read by gale-vtk-reader, which isn't [^\n]+\n\Z")
        shutil.copy(Path(gale.GALE).parent / "gale-vtk-reader", self.folder)
        subprocess.run([alone, "info", "mesh.e"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL, timeout=60)


if __name__ == "__main__":
    unittest.main()
