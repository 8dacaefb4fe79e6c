"""Bars, and what they show."""
import io
import subprocess
import sys
import unittest
from unittest import mock

import gale


class Bars(unittest.TestCase):
    def setUp(self):
        self.mesh, arrays = gale.read("grid:20")
        self.field = arrays["field"]

    def test_true_shows_a_bar_where_tqdm_is(self):
        try:
            import tqdm
        except ImportError:
            self.skipTest("there is no tqdm")
        with mock.patch("sys.stderr", io.StringIO()) as shown:
            self.mesh.critical_points(self.field, progress=True)
            self.mesh.morse_smale(self.field, progress=True)
        last = [line.split("\r")[-1] for line in shown.getvalue().strip().split("\n")]
        self.assertRegex(last[0], f"^critical-points: 100%.* {self.mesh.segments}/{self.mesh.segments} ")
        self.assertRegex(last[1], f"^morse-smale: 100%.* {self.mesh.segments}/{self.mesh.segments} ")

    def test_true_shows_nothing_where_tqdm_is_not(self):
        with mock.patch.dict(sys.modules, {"tqdm": None, "tqdm.auto": None}), \
                mock.patch("sys.stderr", io.StringIO()) as shown:
            self.mesh.critical_points(self.field, progress=True)
        self.assertEqual(shown.getvalue(), "")

    def test_functions_are_told_of_relations_until_all_is_done(self):
        for name in "VT", "FE", "EE", "FF", "VV":
            told = []
            self.mesh.relation(name, progress=lambda done, of: told.append((done, of)))
            self.assertTrue(all(0 < done <= of for done, of in told), (name, told))
            self.assertEqual(*told[-1], name)

    def test_what_a_function_raises_ends_a_relation(self):
        class Enough(Exception):
            pass

        def stop(done, of):
            raise Enough

        for name in "VT", "FE", "EE", "VV":
            with self.assertRaises(Enough):
                self.mesh.relation(name, progress=stop)

    def test_false_is_none(self):
        self.mesh.relation("VT", progress=False)


class Types(unittest.TestCase):
    def test_are_those_that_the_stub_says(self):
        try:
            import mypy
        except ImportError:
            self.skipTest("there is no mypy")
        use = __file__.replace("test_progress.py", "typed_use.py")
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--no-incremental", use], capture_output=True,
                              text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)


if __name__ == "__main__":
    unittest.main()
