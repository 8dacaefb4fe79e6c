"""How the command takes its arguments and how it ends."""
import os
import re
import shlex
import shutil
import subprocess
import unittest

import gale

COMMANDS = ("info", "segment", "critical-points", "discrete-gradient", "morse-smale", "persistence-diagram", "merge-tree",
            "simplify-field", "track", "relations", "generate")


class Usage(gale.CommandTest):
    def test_version(self):
        version, commit, kokkos, parts, compiler = self.succeed("--version").splitlines()
        self.assertEqual(version, f"gale {gale.VERSION}")
        self.assertRegex(commit, "^commit ([0-9a-f]{40}|unknown)$")
        self.assertRegex(kokkos, r"^Kokkos \d+\.\d+\.\d+: (Cuda|HIP|OpenMP|Threads|Serial)")
        self.assertEqual("VTK" in parts, gale.HAVE_VTK)
        self.assertRegex(compiler, r"^by \w+ \d+\.")

    def options_of(self, *command):
        """The long options that a help text lists."""
        return set(re.findall(r"^  (?:-\w,)?(--[a-z0-9-]+)", self.succeed(*command, "--help"), re.MULTILINE))

    def test_the_manual_has_all_commands_and_options(self):
        manual = self.succeed("--manual")
        self.assertTrue(manual.startswith(".TH GALE 1"))
        sections = dict(re.findall(r"^\.SH GALE (.*)\n((?:(?!\.SH).*\n)*)", manual.replace("\\-", "-"), re.MULTILINE))
        self.assertEqual({name.lower() for name in sections}, set(COMMANDS))
        for name, text in sections.items():
            self.assertEqual(set(re.findall(r"^\.TP\n\\fB.*?(--[a-z0-9-]+)", text, re.MULTILINE)), self.options_of(name.lower()))

    def complete(self, *words):
        """What bash offers for the last of these words."""
        script = self.succeed("--completions", "bash") + f"""
            COMP_WORDS=({" ".join(shlex.quote(word) for word in words)}) COMP_CWORD={len(words) - 1}
            _gale
            printf '%s\\n' "${{COMPREPLY[@]}}"
            """
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, cwd=os.path.dirname(__file__))
        self.assertEqual(done.returncode, 0, done.stderr)
        return set(done.stdout.split())

    @unittest.skipUnless(shutil.which("bash"), "there is no bash")
    def test_bash_completes_what_there_is(self):
        self.assertEqual(self.complete("gale", ""), {*COMMANDS, *self.options_of(), "-h"})
        self.assertEqual(self.complete("gale", "mo"), {"morse-smale"})
        for name in COMMANDS:
            offered = self.complete("gale", name, "--")
            self.assertEqual(offered, self.options_of(name))
        self.assertEqual(self.complete("gale", "merge-tree", "grid:8", "--type", ""), {"contour", "join", "split"})
        self.assertEqual(self.complete("gale", "info", "test_us"), {"test_usage.py"})
        self.assertEqual(self.complete("gale", "segment", "-o", "test_us"), {"test_usage.py"})
        self.assertEqual(self.complete("gale", "info", "grid:8", "--threads", "t"), set())

    @unittest.skipUnless(shutil.which("zsh"), "there is no zsh")
    def test_zsh_takes_its_completions(self):
        done = subprocess.run(["zsh", "-n"], input=self.succeed("--completions", "zsh"), capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_other_shells_are_refused(self):
        self.refuse(2, "--completions", "fish", naming="fish not in {bash,zsh}")

    def test_help_names_all_commands_and_options(self):
        text = self.succeed("--help")
        for command in ("info", "segment", "critical-points", "discrete-gradient", "morse-smale", "generate"):
            self.assertIn(command, text)
        for command in ("critical-points", "discrete-gradient", "merge-tree", "simplify-field", "morse-smale"):
            text = self.succeed(command, "--help")
            for option in ("--above", "--array", "--output", "--threads", "--structure", "--capacity", "--segments",
                           "--blocks-per-request", "--threads-per-block", "--threads-per-segment", "--host-memory",
                           "--device-memory", "--report", "--quiet", "--cells"):
                self.assertIn(option, text)
        for option in ("--no-descending-separatrices", "--no-ascending-separatrices", "--no-saddle-connectors", "--separatrices2",
                       "--no-descending-segmentation", "--no-ascending-segmentation", "--persistence", "--render"):
            self.assertIn(option, text)
        self.assertIn("--arrows", self.succeed("discrete-gradient", "--help"))

    def test_wrong_usage(self):
        for arguments in (["critical-points"], ["critical-points", "grid:4", "--nonsense"],
                          ["info", "grid:4", "grid:5"],
                          ["segment", "grid:4", "--capacity", "5", "--segments", "part"]):
            with self.subTest(arguments=arguments):
                self.refuse(2, *arguments)

    def test_no_or_an_unknown_command_names_those_that_there_are(self):
        for arguments, naming in (([], "no command"), (["bogus"], "unknown command 'bogus'"), (["bogus", "grid:4"], "'bogus'"),
                                  (["--bogus"], "--bogus")):
            with self.subTest(arguments=arguments):
                self.refuse(2, *arguments, naming=naming)
                self.refuse(2, *arguments, naming="the commands are info, segment, critical-points, discrete-gradient, morse-smale, persistence-diagram, merge-tree, simplify-field, track, relations, generate")

    def test_values_that_options_do_not_take(self):
        for option, value in (("--structure", "fast"), ("--capacity", "0"), ("--capacity", "many"), ("--threads", "0"), ("--threads", "1025"),
                              ("--threads", "-1"), ("--above", "zero"), ("--above", "nan"), ("--above", "inf"), ("--above", "1e400"),
                              ("--above", "0x1"), ("--above", " 1"), ("--host-memory", "8 apples"),
                              ("--host-memory", "-1"), ("--blocks-per-request", "0"), ("--threads-per-block", "-32"),
                              ("--threads-per-segment", "0"), ("--threads-per-segment", "1025"),
                              ("--blocks-per-request", "1048577"), ("--host-memory", "0"), ("--host-memory", "0.1"),
                              ("--host-memory", "1.5.5G"), ("--host-memory", "MiB"), ("--host-memory", ""),
                              ("--host-memory", "9" * 400), ("--device-memory", "0x10"), ("--device-memory", "1Gi")):
            with self.subTest(option=option, value=value):
                self.refuse(2, "critical-points", "grid:4", option, value, naming=option)

    def test_empty_values(self):
        for option in ("--output", "-o", "--report", "--array", "--segments", "--above", "--render"):
            with self.subTest(option=option):
                self.refuse(2, "critical-points", "grid:4", option, "", naming=f"{option}: '' is nothing")
        self.refuse(2, "generate", "grid:4", "-o", "", naming="-o: '' is nothing")
        self.refuse(2, "info", "grid:4", "--report=", "--quiet", naming="--report: there is nothing after '='")
        self.refuse(2, "info", "", "grid:4", naming="'' is no argument")
        self.assertEqual(self.names(), [])

    def test_sizes_of_memory(self):
        for size in ("512MiB", "1.5GiB", "8G", "1000000", "64 mb", "2k"):
            with self.subTest(size=size):
                self.succeed("critical-points", "grid:4", "--host-memory", size)

    def test_output_of_another_kind(self):
        for command, name in (("critical-points", "points.vtu"), ("discrete-gradient", "points.vtu"), ("simplify-field", "mesh.vtp"), ("segment", "mesh.vtp"), ("generate", "mesh.stl")):
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
        for command in ("info", "segment", "critical-points", "discrete-gradient", "morse-smale", "merge-tree", "simplify-field"):
            self.assertEqual(self.succeed(command, "grid:4", "--quiet"), "")

    def test_report_where_there_is_no_place(self):
        self.refuse(1, "info", "grid:4", "--quiet", "--report", "missing/report.json", naming="'missing/report.json'")
        self.refuse(1, "info", "missing.vtu", "--report", ".", naming="'.'")  # before the input is looked at

    def test_report_of_a_name_that_is_not_utf_8(self):
        name = b"\xff.vtu"
        self.succeed("generate", "grid:4", "-o", os.fsdecode(name))
        if gale.HAVE_VTK:
            self.assertEqual(self.report("info", os.fsdecode(name))["input"], "\ufffd.vtu")

    def test_output_where_there_is_no_place(self):
        for command, name in (("critical-points", "missing/points.vtp"), ("segment", "missing/mesh.vtu"), ("simplify-field", "missing/mesh.vtk"),
                              ("generate", "missing/mesh.vtk")):
            with self.subTest(command=command):
                self.refuse(1, command, "grid:4", "-o", name, naming=name)
                self.refuse(1, command, "missing.vtu", "-o", name, naming=name)  # before the input is looked at
        self.assertEqual(self.names(), [])

    @gale.needs_vtk
    def test_extensions_count_in_either_case(self):
        self.succeed("generate", "grid:4", "-o", "MESH.VTU")
        self.succeed("critical-points", "MESH.VTU", "-o", "points.Vtp")
        self.assertEqual(self.names(), ["MESH.VTU", "points.Vtp"])

    @unittest.skipIf(gale.HAVE_VTK, "this gale was built with VTK")
    def test_files_without_vtk(self):
        self.write("mesh.vtu", "")
        self.refuse(1, "info", "mesh.vtu", naming="without VTK")
        self.succeed("generate", "grid:4", "-o", "mesh.vtu")
        self.assertIn(b'NumberOfPoints="64"', (self.folder / "mesh.vtu").read_bytes())


if __name__ == "__main__":
    unittest.main()
