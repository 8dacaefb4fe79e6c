"""gale under mpirun: the same results as on one rank, a piece of output a rank, and ends together."""
import os
import signal
import subprocess
import time
import unittest
from pathlib import Path

import gale
import ranks
from meshes_in_pieces import pvtu


@ranks.needs_mpi
class OnRanks(ranks.RanksTest):
    def points(self, name):
        """{vertex: (point, values of arrays)} of all pieces of a .pvtp, and the types of its arrays."""
        found, pieces = {}, self.pieces(name)
        for piece in pieces:
            self.add(piece.points, piece.point_arrays, found)
        return found, pieces[0].types("PointData")

    def add(self, points, arrays, found):
        for i, vertex in enumerate(arrays["ttkVertexScalarField"]):
            self.assertNotIn(vertex, found)
            found[vertex] = (points[i], {name: values[i] for name, values in arrays.items()})

    def test_counts_are_those_of_one_rank(self):
        for command in ("critical-points", "discrete-gradient"):
            expected = self.report(command, "grid:24")
            for count in ranks.RANKS:
                with self.subTest(command=command, ranks=count):
                    report = self.report_of(count, command, "grid:24")
                    self.assertEqual(report["result"], expected["result"])
                    self.assertEqual({**report["mesh"], "segments": None}, {**expected["mesh"], "segments": None})

    @gale.needs_vtk
    def test_pieces_have_the_points_of_one_rank(self):
        self.write_ties("grid:9")
        for source in ("grid:9", "ties.vtk"):
            self.succeed("critical-points", source, "-o", "one.vtp")
            expected = {}
            self.add(*gale.read_vtp(self.folder / "one.vtp"), expected)
            for count in ranks.RANKS:
                with self.subTest(source=source, ranks=count):
                    self.report_of(count, "critical-points", source, "-o", "all.pvtp")
                    found, types = self.points("all.pvtp")
                    self.assertEqual(found, expected)
                    self.assertEqual(types["ttkVertexScalarField"], "Int64")

    @gale.needs_vtk
    def test_arrays_of_a_file_travel_and_its_order_counts(self):
        points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1), (2, 2, 2)]
        cells = [[0, 1, 2, 3], [1, 2, 3, 4], [2, 3, 4, 5]]
        arrays = {"height": ("float", [1, 1, 1, 1, 1, 1]), "height_Order": ("int", [3, 5, 0, 4, 2, 1]), "weight": ("double", [6, 5, 4, 3, 2, 1])}
        self.write("small.vtk", gale.vtk_mesh(points, cells, arrays))
        self.succeed("critical-points", "small.vtk", "--array", "height", "-o", "one.vtp")
        expected = {}
        self.add(*gale.read_vtp(self.folder / "one.vtp"), expected)
        self.assertTrue({"height_Order", "weight"} <= set(next(iter(expected.values()))[1]))
        for count in ranks.RANKS:
            with self.subTest(ranks=count):
                self.report_of(count, "critical-points", "small.vtk", "--array", "height", "-o", "all.pvtp")
                self.assertEqual(self.points("all.pvtp")[0], expected)

    def test_the_report_has_what_differs_between_ranks(self):
        report = self.report_of(3, "critical-points", "grid:16")["ranks"]
        self.assertEqual(report["count"], 3)
        self.assertLessEqual(report["owned_vertices"]["least"], 16 ** 3 / 3)
        self.assertGreaterEqual(report["owned_vertices"]["most"], 16 ** 3 / 3)
        for key in ("tetrahedra", "host_peak_bytes", "sent_messages", "sent_bytes", "gathered_bytes", "reading", "initializing", "running", "writing",
                    "waiting"):
            with self.subTest(key=key):
                spread = report[key]
                self.assertEqual(list(spread), ["least", "median", "most"])
                self.assertTrue(0 <= spread["least"] <= spread["median"] <= spread["most"])
        self.assertGreater(report["sent_bytes"]["most"], 0)
        self.assertGreater(report["waiting"]["most"], 0)
        self.assertIsNone(self.report("critical-points", "grid:4")["ranks"])

    def test_what_ranks_send_is_small_beside_the_mesh(self):
        mesh = 12 * 48 ** 3 + 16 * 6 * 47 ** 3  # bytes of points and tetrahedra; what is sent grows with a side's square
        for most, arguments in ((0.003, ["critical-points"]), (0.018, ["morse-smale"]), (0.005, ["persistence-diagram"]),
                                (0.007, ["merge-tree"]), (0.005, ["merge-tree", "--type", "split"])):
            with self.subTest(arguments=arguments):
                sent = self.report_of(4, *arguments, "grid:48")["ranks"]["sent_bytes"]
                self.assertLess(sent["most"], most * mesh)

    def test_errors_are_one_line_and_leave_nothing(self):
        for code, naming, arguments in (
                (1, "nothing.vtu", ["critical-points", "nothing.vtu", "-o", "all.pvtp"]),
                (1, "N must be at least 2", ["critical-points", "grid:1"]),
                (1, "no point array 'height'", ["critical-points", "grid:8", "--array", "height"]),
                (2, ".pvtp", ["critical-points", "grid:8", "-o", "all.vtp"]),
                (2, "--segments", ["critical-points", "grid:8", "--segments", "field"]),
                (2, ".pvtp", ["discrete-gradient", "grid:8", "-o", "all.vtp"]),
                (2, "--formulation cells: not on several ranks", ["discrete-gradient", "grid:8", "--formulation", "cells"]),
                (1, "--render", ["morse-smale", "grid:8", "--render", "all.png"]),  # without a display
                (2, "--extrema-only: it goes with --persistence", ["morse-smale", "grid:8", "--extrema-only"]),
                (2, ".pvtu", ["simplify-field", "grid:8", "-o", "all.vtu"]),
                (2, "info works on one rank", ["info", "grid:8"]),
                (2, "--nonsense", ["critical-points", "grid:8", "--nonsense"])):
            with self.subTest(arguments=arguments):
                self.expect_one_line(self.launch(3, *arguments), code, naming)
                self.assertEqual(self.names(), [])

    def test_ranks_of_different_command_lines_end_together(self):
        line = ["critical-points", "grid:8", "-o", "all.pvtp"]
        for other, theirs, ours in (([*line, "--nonsense"], "'--nonsense'", "nothing more"),
                                    (["--help"], "'--help'", "'critical-points'"), ([], "nothing more", "'critical-points'"),
                                    ([*line[:3], "other.pvtp"], "'other.pvtp'", "'all.pvtp'")):
            with self.subTest(other=other):
                run = self.launch_each([gale.GALE, *line], [gale.GALE, *other])
                self.expect_one_line(run, 2, f"rank 1 has {theirs} where rank 0 has {ours}")
                self.assertEqual((run.stdout, self.names()), ("", []))

    def test_help_is_printed_once(self):
        run = self.launch(3, "--help")
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, self.succeed("--help"), ""))

    @gale.needs_vtk
    def test_an_output_that_is_a_file_of_the_input_is_refused(self):
        self.succeed("generate", "grid:4", "-o", "part.vtu")
        self.write("parts.pvtu", pvtu(["part.vtu"]))
        (self.folder / "all_1.vtp").symlink_to("part.vtu")
        before = {name: (self.folder / name).read_bytes() for name in self.names()}
        for code, options, naming in ((1, ["-o", "all.pvtp"], "'part.vtu' is to be written, as 'all_1.vtp'"),
                                      (2, ["--report", "parts.pvtu"], "'parts.pvtu' is named for two files")):
            with self.subTest(options=options):
                self.expect_one_line(self.launch(2, "critical-points", "parts.pvtu", *options), code, naming)
                self.assertEqual({name: (self.folder / name).read_bytes() for name in self.names()}, before)

    def test_a_summary_of_which_a_part_is_printed_leaves_no_files(self):
        """Where the first rank can't say what was written, by all ranks by then."""
        line, limit = [gale.GALE, "critical-points", "grid:6", "-o", "all.pvtp"], 16 * 512
        whole = self.launch_each(line, line).stdout
        for name in self.names():
            (self.folder / name).unlink()
        self.write("all_1.vtp", "old")
        self.write("said", " " * (limit - whole.index("wrote") - 8))
        run = self.launch_each(["sh", "-c", 'ulimit -f 16; exec "$0" "$@" >> said', *line], line)
        self.expect_one_line(run, 1, "cannot write to standard output: File too large")
        self.assertEqual(self.names(), ["all_1.vtp", "said"])
        self.assertEqual((self.folder / "all_1.vtp").read_text(), "old")

    def test_a_rank_that_fails_before_the_command_begins_ends_all(self):
        line = [gale.GALE, "critical-points", "grid:8", "-o", "all.pvtp"]
        run = self.launch_each(line, ["env", "KOKKOS_NUM_THREADS=many", *line])
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("KOKKOS_NUM_THREADS", run.stderr)
        self.assertEqual(self.names(), [])

    def test_a_rank_that_cannot_write_leaves_no_output_of_others(self):
        (self.folder / "all_1.vtp").mkdir()
        self.expect_one_line(self.launch(3, "critical-points", "grid:8", "-o", "all.pvtp"), 1, "all_1.vtp")
        self.assertEqual(self.names(), ["all_1.vtp"])

    def kill_one(self, line, *arguments):
        """Starts two ranks, kills the second when the first says a line that begins so, and returns what the launcher says."""
        run = subprocess.Popen([*self.launcher, "-n", "2", gale.GALE, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.communicate)
        self.addCleanup(run.kill)
        said = []
        while not said or (said[-1] and not said[-1].startswith(line)):
            said.append(run.stdout.readline())
        self.assertTrue(said[-1].startswith(line), said)
        children = Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
        os.kill(int(children[-1]), signal.SIGKILL)
        begin = time.monotonic()
        _, error = run.communicate(timeout=60)
        self.assertLess(time.monotonic() - begin, 30)
        self.assertNotEqual(run.returncode, 0)
        return error

    def test_a_rank_that_is_killed_in_any_phase_ends_all_without_results(self):
        for line, command, *outputs in (("input", "critical-points", "-o", "all.pvtp"), ("field", "merge-tree", "-o", "all"),
                                        ("field", "simplify-field", "-o", "all.pvtu", "--persistence", "1%"),
                                        ("minima", "morse-smale", "-o", "all")):
            with self.subTest(line=line, command=command, outputs=outputs):
                self.assertIn("signal 9", self.kill_one(line, command, "grid:128", *outputs))
                if self.has_unnamed_files():
                    self.assertEqual(self.names(), [])
                for name in self.names():
                    self.assertRegex(name, r"^\..*\.part$")  # the rank that was killed had begun it
                    (self.folder / name).unlink()


@unittest.skipIf(ranks.MPIEXEC, "this gale was built with MPI")
class WithoutMpi(gale.CommandTest):
    def test_refuses_to_be_one_of_several_ranks(self):
        run = subprocess.run([gale.GALE, "info", "grid:4"], env={**os.environ, "OMPI_COMM_WORLD_SIZE": "3"},
                             capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r"\Agale: it was started on 3 ranks, but built without MPI[^\n]*\n\Z")


if __name__ == "__main__":
    unittest.main()
