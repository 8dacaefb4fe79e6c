"""Files of the command: all of them whole or none, whatever ends it."""
import os
import resource
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

import gale

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
                                  ["persistence-diagram", "grid:12", "-o", "d.vtu"], ["generate", "grid:12", "-o", "m.vtu"]):
            self.succeed(command, *options, "--encoding", "base64")
        names = [name for name in self.names() if name.endswith((".vtp", ".vtu"))]
        self.assertEqual(len(names), 10)
        for name in names:
            arrays = xml.etree.ElementTree.parse(self.folder / name).getroot().iter("DataArray")
            self.assertEqual({array.get("format") for array in arrays}, {"binary"}, name)

    @gale.needs_vtk
    def test_a_signal_leaves_no_files_and_ends_the_process(self):
        for which in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            for temporaries in (1, 2, 4):
                with self.subTest(signal=which, temporaries=temporaries):
                    run = self.start(*MANY)
                    while run.poll() is None and sum(name.endswith(".part") for name in self.names()) < temporaries:
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
        run = self.start("critical-points", "grid:200", "--quiet", "--threads", "1",
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (700 << 20, 700 << 20)))
        output = run.communicate(timeout=300)
        self.assertEqual((run.returncode, output[0]), (1, ""))
        self.assertRegex(output[1], r"\Agale: out of memory[^\n]+\n\Z")


if __name__ == "__main__":
    unittest.main()
