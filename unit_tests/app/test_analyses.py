"""What outputs/analyses.hpp says of each analysis, against its doors: the command, Python, VTK's filters and ParaView."""
import ast
import json
import re
import unittest
import xml.etree.ElementTree
from pathlib import Path

import gale

ROOT = Path(__file__).parents[2]
FILTERS = ROOT / "bindings" / "vtk" / "filters"
DOCUMENTS = "".join(page.read_text() for page in (ROOT / "docs").glob("*.md"))
OF_ALL = {"field", "name", "threads", "progress", "order"}  # arguments in Python
THRESHOLD = {"Simplify": "0", "Persistence": "1", "PersistenceIsPercent": "1"}  # what filters have for a threshold


def methods():
    """The methods of gale.Mesh, and what else its module has, by name."""
    module = ast.parse((ROOT / "bindings" / "python" / "gale" / "_mesh.py").read_text())
    mesh = next(one for one in module.body if isinstance(one, ast.ClassDef) and one.name == "Mesh")
    return {one.name: one for one in module.body + mesh.body if isinstance(one, ast.FunctionDef)}


def arguments(method):
    """The arguments of a method but for the first, which is self or the steps, and their defaults."""
    names = [one.arg for one in method.args.args[1:]]
    defaults = [ast.literal_eval(one) for one in method.args.defaults]
    return dict(zip(names, [None] * (len(names) - len(defaults)) + defaults))


def arrays(analysis):
    return [array["name"] for result in analysis["results"] for array in result["point_arrays"] + result["cell_arrays"]]


class Analyses(gale.CommandTest):
    def setUp(self):
        super().setUp()
        self.analyses = json.loads(self.succeed("--analyses"))

    def each(self):
        for analysis in self.analyses:
            with self.subTest(analysis=analysis["name"]):
                yield analysis

    def test_the_command_has_their_options(self):
        common = set(re.findall(r"--[\w-]+", self.succeed("segment", "--help") + self.succeed("relations", "--help")))
        common |= {"--consumers", "--times", "--render", "--curve", "--format", "--formulation"}  # where rows are read; of the command alone
        for analysis in self.each():
            help_text = self.succeed(analysis["name"], "--help")
            words = " ".join(help_text.split())
            self.assertIn(analysis["help"], words)
            expected = set()
            for option in analysis["options"]:
                said = option["help"]
                if option["is_on"]:
                    said = "Without " + said[0].lower() + said[1:]
                name = ("--no-" if option["is_on"] else "--") + option["name"].replace("_", "-")
                expected.add(name)
                self.assertIn(said, words)
            own = set(re.findall(r"^ +(?:-\w,)?(--[\w-]+)", help_text, re.MULTILINE))
            self.assertEqual(own - common, expected)

    def test_python_has_their_options(self):
        all_methods = methods()
        for analysis in self.each():
            method = all_methods[analysis["name"].replace("-", "_")]
            given = arguments(method)
            options = {one["name"]: one for one in analysis["options"]
                       if not one["is_on"] and not one["has_own_file"] and one["kind"] != "axis"}  # users add that to points
            self.assertEqual(set(given) - OF_ALL, set(options))
            for name, option in options.items():
                defaults = {"flag": [False], "threshold": [None, 0], "choice": option["choices"][:1], "number": [0]}
                self.assertIn(given[name], defaults[option["kind"]])
                self.assertIn(f"`{name}`", ast.get_docstring(method))

    def test_python_has_the_results_of_tracking(self):
        tracking = next(one for one in self.analyses if one["name"] == "track")
        module = ast.parse((ROOT / "bindings" / "python" / "gale" / "results.py").read_text())
        tracks = next(one for one in module.body if isinstance(one, ast.ClassDef) and one.name == "Tracks")
        self.assertEqual([one.target.id for one in tracks.body if isinstance(one, ast.AnnAssign)],
                         [result["name"] for result in tracking["results"]])
        words = re.findall(r"\w+", " ".join(ast.get_docstring(tracks).split()).replace("the field", "NAME"))
        self.assertEqual(set(arrays(tracking)) - set(words), set())

    def test_filters_have_their_options(self):
        proxies = {proxy.get("class"): proxy for proxy in
                   xml.etree.ElementTree.parse(ROOT / "bindings" / "paraview" / "plugin" / "filters.xml").iter("SourceProxy")}
        headers = {header.stem: header.read_text() for header in FILTERS.glob("vtkGale*.h")}
        classes = {run[1]: name for name, text in headers.items() if (run := re.search(r'vtkGaleAlgorithm\("([\w-]+)"', text))}
        self.assertEqual(set(classes) - {one["name"] for one in self.analyses}, set())
        for analysis in self.each():
            if analysis["name"] not in classes:
                continue  # it is no filter
            of_class = classes[analysis["name"]]
            header = headers[of_class]
            properties = {one.get("name"): one for one in proxies[of_class] if one.tag.endswith("Property")}
            expected = {}
            for option in analysis["options"]:
                if option["kind"] == "threshold":
                    expected.update(THRESHOLD)
                elif option["kind"] != "flag":
                    expected[option["property"]] = "0"  # the first of a choice
                    self.assertEqual(properties[option["property"]].find("Documentation").text, option["help"] + ".")
                    self.assertIn(f'Ask{option["kind"].title()}("{option["name"]}", ', header)
                else:
                    expected[option["property"]] = "01"[option["is_on"]]
                    self.assertEqual(properties[option["property"]].find("Documentation").text, option["help"] + ".")
                    self.assertIn(f'AskFlag("{option["name"]}", this->{option["property"]})', header)
            self.assertEqual({name: one.get("default_values") for name, one in properties.items()}, expected)
            for name, default in expected.items():
                self.assertRegex(header, rf"vtkSet(?:Clamp)?Macro\({name},")
                value = re.search(rf"^  \w+ {name} = (\w+);$", header, re.MULTILINE)[1]
                self.assertEqual({"false": "0", "true": "1"}.get(value, value), default)
            ports = [result["shape"] for result in analysis["results"] if result["shape"] != "count"]
            self.assertEqual(len(proxies[of_class].findall("OutputPort")), len(ports))
            mesh_port = ports.index("mesh") if "mesh" in ports else -1
            self.assertIn(f'("{analysis["name"]}", {len(ports)}, {mesh_port})', header)

    def test_documents_name_their_arrays(self):
        for analysis in self.each():
            self.assertIn(f"`{analysis['name']}`", DOCUMENTS)
            for name in arrays(analysis):
                self.assertTrue(f"`{name}`" in DOCUMENTS or name.startswith("SeparatrixFunction"), name)


if __name__ == "__main__":
    unittest.main()
