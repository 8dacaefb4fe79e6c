"""How the command takes its arguments and how it ends."""
import unittest

import gale


class Usage(gale.CommandTest):
    def test_version(self):
        self.assertEqual(self.succeed("--version"), f"gale {gale.VERSION}\n")

    def test_help_names_all_commands_and_options(self):
        text = self.succeed("--help")
        for command in ("info", "segment", "critical-points", "generate"):
            self.assertIn(command, text)
        text = self.succeed("critical-points", "--help")
        for option in ("--above", "--array", "--output", "--threads", "--structure", "--capacity", "--segments",
                       "--blocks-per-request", "--threads-per-block", "--threads-per-segment", "--host-memory",
                       "--device-memory", "--report", "--quiet", "--tetrahedralize"):
            self.assertIn(option, text)

    def test_wrong_usage(self):
        for arguments in ([], ["critical-points"], ["nonsense", "grid:4"], ["critical-points", "grid:4", "--nonsense"],
                          ["critical-points", "grid:4", "grid:5"]):
            with self.subTest(arguments=arguments):
                self.refuse(2, *arguments)

    def test_values_that_options_do_not_take(self):
        for option, value in (("--structure", "fast"), ("--capacity", "0"), ("--capacity", "many"), ("--threads", "0"),
                              ("--threads", "-1"), ("--above", "zero"), ("--host-memory", "8 apples"),
                              ("--host-memory", "-1"), ("--blocks-per-request", "0"), ("--threads-per-block", "-32"),
                              ("--threads-per-segment", "0")):
            with self.subTest(option=option, value=value):
                self.refuse(2, "critical-points", "grid:4", option, value, naming=option)

    def test_output_of_another_kind(self):
        for command, name in (("critical-points", "points.vtu"), ("segment", "mesh.vtp"), ("generate", "mesh.stl")):
            with self.subTest(command=command):
                self.refuse(2, command, "grid:4", "-o", name, naming=name)
        self.assertEqual(self.names(), [])

    def test_generate_needs_an_output(self):
        self.refuse(2, "generate", "grid:4", naming="--output")

    def test_inputs_that_are_not_there(self):
        for name in ("missing.vtu", "missing.nii.gz", "folder.vtu", "grid:", "grid:1", "grid:x", "grid:4x", "grid:-4",
                     "grid:100000", "mesh.stl", "mesh"):
            with self.subTest(name=name):
                (self.folder / "folder.vtu").mkdir(exist_ok=True)
                self.refuse(1, "info", name, naming=name)

    def test_quiet_prints_nothing(self):
        for command in ("info", "segment", "critical-points"):
            self.assertEqual(self.succeed(command, "grid:4", "--quiet"), "")

    def test_report_where_there_is_no_place(self):
        self.refuse(1, "info", "grid:4", "--quiet", "--report", "missing/report.json", naming="missing/report.json")

    @gale.needs_vtk
    def test_output_where_there_is_no_place(self):
        for command, name in (("critical-points", "missing/points.vtp"), ("segment", "missing/mesh.vtu"),
                              ("generate", "missing/mesh.vtk")):
            with self.subTest(command=command):
                self.refuse(1, command, "grid:4", "-o", name, naming=name)
        self.assertEqual(self.names(), [])

    @unittest.skipIf(gale.HAVE_VTK, "this gale was built with VTK")
    def test_files_without_vtk(self):
        self.write("mesh.vtu", "")
        self.refuse(1, "info", "mesh.vtu", naming="without VTK")
        self.refuse(1, "generate", "grid:4", "-o", "mesh.vtu", naming="without VTK")


if __name__ == "__main__":
    unittest.main()
