"""What docs/first_hour.md says to type into Python does what it says."""
import contextlib
import inspect
import io
import re
import unittest
from pathlib import Path

import gale
import numpy as np

PAGE = Path(__file__).parents[3] / "docs" / "first_hour.md"


class FirstHour(unittest.TestCase):
    def test_python(self):
        try:
            import pyvista
            import scipy
        except ImportError as missing:
            self.skipTest(str(missing))
        arrays, relations, files = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
        names, said = {}, io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(io.StringIO()):
            exec(arrays + relations, names)
        self.assertEqual(said.getvalue().splitlines()[:2], ["[0 4]", "[1 1 1 2 2 1 2 1 1]"])
        np.testing.assert_array_equal(names["mesh"].relation_matrix("VV").sum(axis=1), [3, 4, 4, 4, 3])
        files = re.sub(r'gale.read\(.*\)', 'gale.read("grid:9")', files).replace(".plot()", "")
        with contextlib.redirect_stderr(io.StringIO()):
            exec(files, names)
        self.assertIsInstance(names["complex"], gale.MorseSmaleComplex)


class Parameters(unittest.TestCase):
    def test_help_says_of_each_what_it_is(self):
        methods = [getattr(gale.Mesh, name) for name in vars(gale.Mesh) if not name.startswith("_")]
        for function in [gale.read, *filter(callable, methods)]:
            for name in inspect.signature(function).parameters:
                if name != "self":
                    self.assertRegex(function.__doc__, rf"(?m)^:param {name}: (?!None\.)", function.__name__)


if __name__ == "__main__":
    unittest.main()
