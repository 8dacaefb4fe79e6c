"""Files of the command: all of them whole or none, whatever ends it."""
import os
import resource
import signal
import subprocess
import tempfile
import time
import unittest
import xml.etree.ElementTree
from pathlib import Path

import gale
from meshes_in_pieces import pvtu

# Commands that write several files, and their names.
MANY = ["morse-smale", "grid:24", "-o", "p", "--separatrices2", "--report", "report.json", "--quiet"]
FILES = ["p_critical_points.vtp", "p_segmentation.vtu", "p_separatrices1.vtp", "p_separatrices2.vtp", "report.json"]


def no_larger_files_than(size):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


class Outputs(gale.CommandTest):
    def start(self, *arguments, **options):
        return subprocess.Popen([gale.GALE, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, **options)

    @gale.needs_vtk
    def test_all_files_in_base64_are_xml(self):
        for command, *options in (MANY, ["critical-points", "grid:12", "-o", "c.vtp"], ["segment", "grid:12", "-o", "s.vtu"],
                                  ["discrete-gradient", "grid:12", "-o", "g.vtp", "--arrows", "a.vtp"],
                                  ["persistence-diagram", "grid:12", "-o", "d.vtu"], ["merge-tree", "grid:12", "-o", "t"],
                                  ["simplify-field", "grid:12", "-o", "f.vtu"], ["generate", "grid:12", "-o", "m.vtu"]):
            self.succeed(command, *options, "--encoding", "base64")
        names = [name for name in self.names() if name.endswith((".vtp", ".vtu"))]
        self.assertEqual(len(names), 14)
        for name in names:
            arrays = xml.etree.ElementTree.parse(self.folder / name).getroot().iter("DataArray")
            self.assertEqual({array.get("format") for array in arrays}, {"binary"}, name)

    def begun(self, process):
        """How many files without a name yet, or with a hidden one, a process has begun."""
        count = sum(name.endswith(".part") for name in self.names())
        for file in Path(f"/proc/{process}/fd").glob("*"):
            try:
                count += os.readlink(file).startswith(f"{self.folder}/#")
            except FileNotFoundError:
                pass
        return count

    @gale.needs_vtk
    def test_a_signal_leaves_no_files_and_ends_the_process(self):
        for which in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL if self.has_unnamed_files() else signal.SIGHUP):
            for temporaries in (1, 2, 4):
                with self.subTest(signal=which, temporaries=temporaries):
                    run = self.start(*MANY)
                    while run.poll() is None and self.begun(run.pid) < temporaries:
                        time.sleep(0.0005)
                    run.send_signal(which)
                    output = run.communicate(timeout=300)
                    if run.returncode != 0:  # it was not faster
                        self.assertEqual((run.returncode, *output), (-which, "", ""))
                        self.assertEqual(self.names(), [])
                    for name in self.names():
                        (self.folder / name).unlink()

    def test_an_ignored_signal_stays_ignored(self):
        run = self.start("critical-points", "grid:24", "--quiet", "--report", "report.json",
                         preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        time.sleep(0.05)
        run.send_signal(signal.SIGHUP)
        run.communicate(timeout=300)
        self.assertEqual(run.returncode, 0)
        self.assertEqual(self.names(), ["report.json"])

    @gale.needs_vtk
    def test_a_file_that_cannot_be_whole_keeps_all_others_away(self):
        self.succeed(*MANY)
        sizes = sorted((self.folder / name).stat().st_size for name in self.names())
        for name in self.names():
            (self.folder / name).unlink()
        self.write("p_segmentation.vtu", "old")
        for size in (0, sizes[0], sizes[1], sizes[2], sizes[3]):
            with self.subTest(size=size):
                run = self.start(*MANY, preexec_fn=no_larger_files_than(size))
                output = run.communicate(timeout=300)
                self.assertEqual(run.returncode, 1)
                self.assertEqual(output[0], "")
                self.assertRegex(output[1], r"\Agale: cannot write '(p_\w+\.vt[pu]|report\.json)': File too large\n\Z")
                self.assertEqual(self.names(), ["p_segmentation.vtu"])
                self.assertEqual((self.folder / "p_segmentation.vtu").read_text(), "old")

    def test_a_text_file_says_why_it_cannot_be_whole(self):
        run = self.start("relations", "grid:8", "--relation", "VV", "--dump", "rows.txt", "--quiet",
                         preexec_fn=no_larger_files_than(1000))
        self.assertEqual(run.communicate(timeout=300), ("", "gale: cannot write 'rows.txt': File too large\n"))
        self.assertEqual((run.returncode, self.names()), (1, []))

    def expect_nothing_written(self, run, before):
        """The run failed in one line, since standard output took nothing more, and all files are as before."""
        error = run.communicate(timeout=300)[1]
        self.assertEqual(run.returncode, 1, error)
        self.assertRegex(error, r"\Agale: cannot write to standard output[^\n]*\n\Z")
        self.assertEqual({name: (self.folder / name).read_bytes() for name in self.names()}, before)

    @unittest.skipUnless(os.path.exists("/dev/full"), "there is no /dev/full")
    def test_a_summary_that_cannot_be_printed_leaves_no_files(self):
        before = {"c.vtp": b"old"}
        self.write("c.vtp", "old")
        with open("/dev/full", "w") as full:
            for line in ("critical-points grid:6 -o c.vtp --report r.json", "discrete-gradient grid:6 -o g.vtp --arrows a.vtp",
                         "morse-smale grid:6 -o p", "persistence-diagram grid:6 -o d.vtu --curve c.csv", "segment grid:6 -o s.vtu",
                         "merge-tree grid:6 -o t", "simplify-field grid:6 --persistence 9% -o f.vtu",
                         "relations grid:6 --relation VV --dump rows.txt", "generate grid:6 -o m.vtu", "info grid:6 --report r.json"):
                for closed in (False, True):
                    with self.subTest(line=line, closed=closed):
                        run = subprocess.Popen([gale.GALE, *line.split()], cwd=self.folder, stdin=subprocess.DEVNULL,
                                               stdout=None if closed else full, stderr=subprocess.PIPE, text=True,
                                               preexec_fn=(lambda: os.close(1)) if closed else None)
                        self.expect_nothing_written(run, before)
        for option in ("--help", "--version"):
            with self.subTest(option=option), open("/dev/full", "w") as full:
                self.expect_nothing_written(subprocess.Popen([gale.GALE, option], cwd=self.folder, stdout=full,
                                                             stderr=subprocess.PIPE, text=True), before)

    def test_a_summary_of_which_a_part_is_printed_leaves_no_files(self):
        """Even where only the lines are missing that say what was written."""
        line, limit = ["critical-points", "grid:6", "-o", "c.vtp", "--report", "r.json"], 1 << 16
        whole = self.succeed(*line)
        (self.folder / "r.json").unlink()
        self.write("c.vtp", "old")
        before = {"c.vtp": b"old"}
        for room in (1, whole.index("time"), whole.index("wrote") - 8, whole.index("wrote"), whole.index("wrote") + 8):
            with self.subTest(room=room), tempfile.NamedTemporaryFile("a") as said:
                said.write(" " * (limit - room))
                said.flush()
                run = subprocess.Popen([gale.GALE, *line], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=said,
                                       stderr=subprocess.PIPE, text=True, preexec_fn=no_larger_files_than(limit))
                self.expect_nothing_written(run, before)

    @gale.needs_vtk
    def test_an_output_that_is_a_file_of_the_input_is_refused(self):
        self.succeed("generate", "grid:4", "-o", "part.vtu")
        self.write("parts.pvtu", pvtu(["part.vtu"]))
        volume = gale.Volume((4, 4, 4), lambda x, y, z: x + 5 * y + 7 * z)
        self.write("part.raw", volume.data)
        self.write("volume.mhd", volume.mha("part.raw"))
        self.write("volume.nhdr.nrrd", volume.nrrd().split(b"\n\n")[0] + b"\ndata file: part.raw\n\n")
        (self.folder / "folder").mkdir()
        for name in ("link.vtu", "link.vtp", "link.csv", "link.txt", "p_segmentation.vtu"):
            (self.folder / name).symlink_to("part.vtu")
        os.link(self.folder / "part.vtu", self.folder / "hard.vtu")
        before = {name: (self.folder / name).read_bytes() for name in self.names() if name != "folder"}
        lines = [f"generate parts.pvtu -o {name}" for name in ("part.vtu", "folder/../part.vtu", self.folder / "part.vtu", "link.vtu",
                                                               "hard.vtu")]
        lines += ["segment parts.pvtu -o part.vtu", "critical-points parts.pvtu -o link.vtp", "discrete-gradient parts.pvtu -o link.vtp",
                  "discrete-gradient parts.pvtu --arrows link.vtp", "morse-smale parts.pvtu -o p",
                  "persistence-diagram parts.pvtu -o link.vtu", "persistence-diagram parts.pvtu --curve link.csv",
                  "merge-tree parts.pvtu -o p", "simplify-field parts.pvtu -o part.vtu",
                  "relations parts.pvtu --relation VV --dump link.txt"]
        for command in ("info", "segment", "critical-points", "discrete-gradient", "morse-smale", "persistence-diagram", "merge-tree", "simplify-field"):
            lines.append(f"{command} parts.pvtu --report part.vtu")
        lines += ["info volume.mhd --report part.raw", "info volume.nhdr.nrrd --report part.raw"]
        for line in lines:
            with self.subTest(line=line):
                self.refuse(1, *line.split(), naming="is to be written")
        for line in ("generate part.vtu -o hard.vtu", "generate link.vtu -o part.vtu", "info parts.pvtu --report ./parts.pvtu",
                     "info grid:4 --report grid:4"):
            with self.subTest(line=line):
                self.refuse(2, *line.split(), naming="is named for two files")
        self.assertEqual({name: (self.folder / name).read_bytes() for name in self.names() if name != "folder"}, before)

    def test_two_outputs_that_a_link_makes_one_are_refused(self):
        (self.folder / "link.vtp").symlink_to("there.vtp")
        (self.folder / "there.vtp").symlink_to("end.vtp")
        for other in ("end.vtp", "there.vtp"):
            self.refuse(2, "critical-points", "grid:4", "-o", "link.vtp", "--report", other, naming="is named for two files")
        self.assertEqual(self.names(), ["link.vtp", "there.vtp"])
        self.succeed("critical-points", "grid:4", "-o", "link.vtp")
        self.assertEqual(self.names(), ["end.vtp", "link.vtp", "there.vtp"])

    @gale.needs_vtk
    def test_files_of_before_are_replaced_together(self):
        for name in FILES:
            self.write(name, "old")
        self.succeed(*MANY)
        self.assertEqual(self.names(), FILES)
        for name in FILES:
            self.assertGreater((self.folder / name).stat().st_size, 3)

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_a_folder_that_takes_no_files(self):
        self.folder.chmod(0o500)
        self.refuse(1, "info", "grid:4", "--report", "report.json", naming="Permission denied")

    def test_a_limit_of_memory_says_where(self):
        if self.report("critical-points", "grid:4")["device"] is not None:
            self.skipTest("the device's driver takes more of the address space")
        run = self.start("critical-points", "grid:200", "--mesh", "written", "--quiet", "--threads", "1",
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (700 << 20, 700 << 20)))
        output = run.communicate(timeout=300)
        self.assertEqual((run.returncode, output[0]), (1, ""))
        self.assertRegex(output[1], r"\Agale: out of memory[^\n]+\n\Z")


if __name__ == "__main__":
    unittest.main()
