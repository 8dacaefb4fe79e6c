"""Series: the files and the report of each step are those of its input alone, whatever came before it."""
import json
import unittest
import xml.etree.ElementTree

import gale


def pvd(*steps):
    files = "".join(f'<DataSet timestep="{time}" part="0" file="{file}"/>' for time, file in steps)
    return f'<VTKFile type="Collection" version="0.1"><Collection>{files}</Collection></VTKFile>'


@gale.needs_vtk
class Series(gale.CommandTest):
    def setUp(self):
        super().setUp()
        for step, threshold in enumerate(("2%", "5%", "20%")):
            self.succeed("simplify-field", "grid:16", "--persistence", threshold, "-o", f"f{step}.vtu")
        self.succeed("generate", "grid:12", "-o", "other.vtu")
        self.succeed("generate", "plane:20", "-o", "plane.vtu")

    def named_by(self, file):
        root = xml.etree.ElementTree.parse(self.folder / file).getroot()
        return [(float(one.get("timestep")), one.get("file")) for one in root.iter("DataSet")]

    def expect_steps(self, inputs, files):
        """Has all that several commands write of the inputs be what they write of each of the files."""
        for command, outputs in (("critical-points", [".vtp"]), ("persistence-diagram", [".vtu"]), ("simplify-field", [".vtu"]),
                                 ("morse-smale", ["_critical_points.vtp", "_separatrices1.vtp", "_segmentation.vtu"])):
            with self.subTest(command=command):
                out = outputs[0] if len(outputs) == 1 else ""
                steps = self.report(command, *inputs, "-o", f"all{out}")["steps"]
                self.assertEqual(len(steps), len(files))
                for k, (step, file) in enumerate(zip(steps, files)):
                    alone = self.report(command, file, "-o", f"alone{out}")
                    self.assertEqual((step["result"], alone["steps"]), (alone["result"], None))
                    for ending in outputs:
                        name, extension = ending.split(".")
                        self.assertEqual((self.folder / f"all{name}_{k:04}.{extension}").read_bytes(),
                                         (self.folder / f"alone{ending}").read_bytes())
                for ending in outputs:
                    name, extension = ending.split(".")
                    self.assertEqual([file for _, file in self.named_by(f"all{name}.pvd")],
                                     [f"all{name}_{k:04}.{extension}" for k in range(len(files))])

    def test_as_vtkhdf_is_named_by_a_series_of_files(self):
        self.write("f.pvd", pvd((3, "f2.vtu"), (-1e-3, "f1.vtu"), (0.25, "f0.vtu")))
        self.succeed("critical-points", "f.pvd", "-o", "all.vtkhdf")
        self.succeed("morse-smale", "f.pvd", "-o", "all", "--format", "vtkhdf")
        for name in ("all", "all_critical_points", "all_separatrices1", "all_segmentation"):
            files = json.loads((self.folder / f"{name}.vtkhdf.series").read_text())["files"]
            self.assertEqual(files, [{"name": f"{name}_{k:04}.vtkhdf", "time": time} for k, time in enumerate((-1e-3, 0.25, 3))])
            self.assertFalse((self.folder / f"{name}.pvd").exists())
        again = self.report("critical-points", "all_segmentation.vtkhdf.series", "--array", "field")
        once = self.report("critical-points", "f.pvd")
        for one, other in zip(again["steps"], once["steps"]):
            self.assertEqual((one["time"], one["result"]), (other["time"], other["result"]))

    def test_of_several_files(self):
        self.expect_steps(["f0.vtu", "f1.vtu", "f2.vtu"], ["f0.vtu", "f1.vtu", "f2.vtu"])

    def test_whose_mesh_changes(self):
        self.expect_steps(["f0.vtu", "other.vtu", "f1.vtu", "plane.vtu"], ["f0.vtu", "other.vtu", "f1.vtu", "plane.vtu"])

    def test_that_a_file_names_is_in_the_order_of_time(self):
        self.write("f.pvd", pvd((3, "f2.vtu"), (-1e-3, "f1.vtu"), (0.25, "f0.vtu")))
        self.expect_steps(["f.pvd"], ["f1.vtu", "f0.vtu", "f2.vtu"])
        self.assertEqual([time for time, _ in self.named_by("all.pvd")], [-1e-3, 0.25, 3])
        steps = self.report("critical-points", "f.pvd")["steps"]
        self.assertEqual([(step["time"], step["input"]) for step in steps],
                         [(time, str(self.folder.resolve() / file)) for time, file in ((-1e-3, "f1.vtu"), (0.25, "f0.vtu"), (3, "f2.vtu"))])
        for whole in ("read", "segment", "initialize", "run", "write"):
            self.assertGreaterEqual(min(step["seconds"][whole] for step in steps), 0)

    def test_in_json(self):
        self.write("f.vtu.series", json.dumps({"file-series-version": "1.0", "files": [
            {"name": "f1.vtu", "time": 2}, {"name": "f0.vtu", "time": 0.5}]}))
        run = self.gale("critical-points", "f.vtu.series", "--report", "report.json")
        if "without nlohmann_json" in run.stderr:
            self.skipTest("this gale reads no JSON")
        steps = json.loads((self.folder / "report.json").read_text())["steps"]
        self.assertEqual([step["time"] for step in steps], [0.5, 2])
        for content in ("", "[]", "{}", '{"files": {}}', '{"files": []}', '{"files": [{"time": 1}]}', '{"files": [{"name": "f0.vtu", "time": "1"}]}'):
            self.refuse(1, "critical-points", self.write("bad.vtu.series", content), naming="bad.vtu.series")

    def test_a_mesh_is_divided_once(self):
        seconds = [step["seconds"]["segment"] for step in self.report("critical-points", "f0.vtu", "f1.vtu", "other.vtu")["steps"]]
        self.assertGreater(seconds[0], 0)
        self.assertEqual(seconds[1], 0)
        self.assertGreater(seconds[2], 0)

    def test_of_some_steps(self):
        for times, files in (("first", ["f0.vtu"]), ("last", ["f2.vtu"]), ("1:2", ["f1.vtu", "f2.vtu"]), ("all", ["f0.vtu", "f1.vtu", "f2.vtu"])):
            steps = self.report("critical-points", "f0.vtu", "f1.vtu", "f2.vtu", "--times", times)["steps"]
            self.assertEqual([step["input"] for step in steps], files)
        for times in ("2:1", "-1:1", "1", "1:", "x", "1:2:3", "3:3", "0:99999999999999999999"):
            self.refuse(2, "critical-points", "f0.vtu", "f1.vtu", "f2.vtu", f"--times={times}", naming=f"{times}")
        self.refuse(2, "critical-points", "f0.vtu", "--times", "first", naming="f0.vtu' is no series")

    def test_are_the_first_step_for_commands_that_take_one(self):
        self.write("f.pvd", pvd((1, "f1.vtu"), (0, "f0.vtu")))
        self.assertIn("took the first of 2 time steps", self.succeed("info", "f.pvd"))
        self.succeed("generate", "f.pvd", "-o", "first.vtu")
        self.succeed("generate", "f0.vtu", "-o", "f0_again.vtu")
        self.assertEqual((self.folder / "first.vtu").read_bytes(), (self.folder / "f0_again.vtu").read_bytes())

    def test_write_all_or_nothing(self):
        self.write("f.pvd", pvd((0, "f0.vtu"), (1, "missing.vtu")))
        before = self.names()
        self.refuse(1, "critical-points", "f.pvd", "-o", "cp.vtp", naming="missing.vtu")
        self.assertEqual(self.names(), before)
        (self.folder / "cp_0001.vtp").mkdir()
        self.refuse(1, "critical-points", "f0.vtu", "f1.vtu", "-o", "cp.vtp", naming="cp_0001.vtp")
        self.assertEqual(self.names(), sorted(before + ["cp_0001.vtp"]))
        self.refuse(2, "simplify-field", "f0.vtu", "f.vtu", "-o", "f.vtu", "--report", "f_0001.vtu", naming="f_0001.vtu")
        self.succeed("generate", "grid:4", "-o", "g_0000.vtu")
        self.refuse(2, "simplify-field", "g_0000.vtu", "f0.vtu", "-o", "g.vtu", naming="g_0000.vtu")

    def test_keep_steps_that_are_not_chosen(self):
        self.write("f.pvd", pvd((0, "f0.vtu"), (1, "f1.vtu"), (2, "f2.vtu")))
        before = (self.folder / "f0.vtu").read_bytes()
        self.refuse(2, "simplify-field", "f.pvd", "--times", "last", "--report", "f0.vtu", naming="f0.vtu")
        self.refuse(2, "generate", "f.pvd", "-o", "f1.vtu", naming="f1.vtu")
        self.succeed("generate", "grid:4", "-o", "g_0000.vtu")
        self.refuse(2, "simplify-field", "f0.vtu", "g_0000.vtu", "--times", "0:0", "-o", "g.vtu", naming="g_0000.vtu")
        self.assertEqual((self.folder / "f0.vtu").read_bytes(), before)

    def test_refuses_what_is_none(self):
        self.write("f.pvd", pvd((0, "f0.vtu")))
        self.refuse(1, "critical-points", "f.pvd", "f0.vtu", naming="f.pvd")
        for content in ("", pvd(), pvd((0, "f0.vtu"), (0, "f1.vtu")), pvd(("x", "f0.vtu")), pvd(("nan", "f0.vtu")), pvd((0, "")),
                        pvd((0, "/etc/passwd.vtu")), pvd((0, "../f0.vtu")), pvd((0, "bad.pvd")), pvd((0, "f0.txt"))):
            self.refuse(1, "critical-points", self.write("bad.pvd", content), naming="bad.pvd")


if __name__ == "__main__":
    unittest.main()
