"""gale critical-points: the same counts whatever the structure, the segments and the threads; the report; the output."""
import itertools
import unittest
from pathlib import Path

import gale

GRID_32 = [26, 76, 88, 39, 6]
GRID_64 = [134, 383, 387, 127, 22]
BRAIN = Path("/usr/share/mricron/templates/inia19-t1-brain.nii.gz")
BRAIN_COUNTS = [20444, 55084, 50300, 14924, 7766]


class Counts(gale.CommandTest):
    def test_of_a_small_grid(self):
        for structure in gale.STRUCTURES:
            for capacity in (1, 7, 100, 1000000):
                for threads in (1, 2, 8):
                    with self.subTest(structure=structure, capacity=capacity, threads=threads):
                        self.assertEqual(self.counts("grid:32", "--structure", structure, "--capacity", capacity,
                                                     "--threads", threads), GRID_32)

    def test_with_a_producer_for_each_consumer(self):
        for capacity, threads in ((7, 2), (100, 1), (100, 8), (1000000, 2)):
            with self.subTest(capacity=capacity, threads=threads):
                self.assertEqual(self.counts("grid:32", "--structure", "task-parallel", "--capacity", capacity, "--threads", threads), GRID_32)

    def test_of_a_larger_grid(self):
        for structure in gale.STRUCTURES:
            with self.subTest(structure=structure):
                self.assertEqual(self.counts("grid:64", "--structure", structure), GRID_64)

    def test_with_other_launches_and_tiny_budgets(self):
        for options in (["--blocks-per-request", 1, "--threads-per-block", 32, "--threads-per-segment", 32],
                        ["--blocks-per-request", 64, "--threads-per-block", 256, "--threads-per-segment", 128],
                        ["--host-memory", "1MiB", "--device-memory", "16MiB"], ["--host-memory", "2GiB"]):
            with self.subTest(options=options):
                self.assertEqual(self.counts("grid:32", *options), GRID_32)

    @gale.needs_vtk
    @unittest.skipUnless(BRAIN.exists(), f"there is no {BRAIN}")
    def test_of_a_brain(self):
        settings = ((1, 2), (7, 8), (100, 1), (1000000, 2))
        for (capacity, threads), structure in zip(settings, itertools.cycle(gale.STRUCTURES)):
            with self.subTest(structure=structure, capacity=capacity, threads=threads):
                report = self.report("critical-points", BRAIN, "--above", "0", "--structure", structure,
                                     "--capacity", capacity, "--threads", threads)
                self.assertEqual(list(report["result"].values()), BRAIN_COUNTS)
                self.assertEqual(report["mesh"]["vertices"], 873572)
                self.assertEqual(report["mesh"]["tetrahedra"], 5008230)

    @unittest.skipIf("explicit" in gale.STRUCTURES, "this gale has Kokkos-Kernels")
    def test_explicit_needs_kokkos_kernels(self):
        self.refuse(1, "critical-points", "grid:4", "--structure", "explicit", naming="Kokkos-Kernels")


class Consumers(gale.CommandTest):
    def setUp(self):
        super().setUp()
        self.has_device = self.report("critical-points", "grid:4")["device"] is not None

    def test_are_where_they_are_told_to_be(self):
        report = self.report("critical-points", "grid:32", "--consumers", "host")
        self.assertEqual((list(report["result"].values()), report["consumers"]), (GRID_32, "host"))
        if not self.has_device:
            return self.refuse(2, "critical-points", "grid:4", "--consumers", "device", naming="has no device")
        for options in ([], ["--consumers", "device"], ["--device-memory", "1MiB"], ["--capacity", 1000000], ["--capacity", 1],
                        ["--threads-per-segment", 32]):
            with self.subTest(options=options):
                report = self.report("critical-points", "grid:32", *options)
                self.assertEqual((list(report["result"].values()), report["consumers"]), (GRID_32, "device"))
        self.refuse(2, "critical-points", "grid:4", "--consumers", "device", "--structure", "inline", naming="inline")

    def test_write_the_same_file_on_either_side(self):
        for consumers in ("host", "device") if self.has_device else ("host",):
            self.report("critical-points", "grid:32", "--consumers", consumers, "-o", f"{consumers}.vtp")
            self.assertEqual((self.folder / f"{consumers}.vtp").read_bytes(), (self.folder / "host.vtp").read_bytes())

    def test_of_another_kind_are_refused(self):
        self.refuse(2, "critical-points", "grid:4", "--consumers", "gpu", naming="gpu")


class Report(gale.CommandTest):
    def test_has_what_the_design_says(self):
        report = self.report("critical-points", "grid:16", "--capacity", "50", "--threads", "2")
        for key in ("gale", "kokkos", "backend", "device", "threads", "input", "mesh", "seconds", "wall", "memory", "waiting", "result"):
            self.assertIn(key, report)
        self.assertEqual((report["gale"], report["threads"], report["input"]), (gale.VERSION, 2, "grid:16"))
        self.assertRegex(report["kokkos"], r"\A\d+\.\d+\.\d+\Z")
        mesh = report["mesh"]
        self.assertEqual((mesh["vertices"], mesh["tetrahedra"]), (16 ** 3, 6 * 15 ** 3))
        self.assertEqual((mesh["edges"], mesh["triangles"]), (None, None))
        self.assertGreaterEqual(mesh["segments"], 16 ** 3 / 50)

    def test_total_is_segment_initialize_and_run(self):
        seconds = self.report("critical-points", "grid:16")["seconds"]
        self.assertEqual(list(seconds), ["read", "segment", "initialize", "run", "write", "total"])
        self.assertAlmostEqual(seconds["total"], seconds["segment"] + seconds["initialize"] + seconds["run"])
        self.assertGreater(min(seconds["read"], seconds["initialize"], seconds["run"]), 0)

    def test_parts_of_the_wall_clock_add_up(self):
        wall = self.report("critical-points", "grid:24", "-o", "points.vtp")["wall"]
        parts = ["start", "read", "compute", "make", "compress", "store", "other"]
        self.assertEqual(list(wall), parts + ["total", "processor"])
        self.assertGreaterEqual(min(wall.values()), 0)
        self.assertAlmostEqual(sum(wall[part] for part in parts), wall["total"])
        self.assertGreater(min(wall["compress"], wall["store"], wall["processor"]), 0)

    def test_memory(self):
        report = self.report("critical-points", "grid:16")
        self.assertGreater(report["memory"]["host_peak_bytes"], 1000000)
        self.assertEqual(report["memory"]["device_peak_bytes"] is None, report["device"] is None)

    def test_waiting_tells_who_computed(self):
        for structure in ("gale", "inline"):
            report = self.report("critical-points", "grid:16", "--mesh", "written", "--structure", structure,
                                 "--consumers", "host")
            batches = sum(leader["batches"] for leader in report["waiting"]["leaders"])
            with self.subTest(structure=structure):
                self.assertEqual(batches > 0, structure == "gale" and report["device"] is not None)
                waiting = report["waiting"]
                on_the_host = waiting["segments_computed_by_consumers"] + waiting["segments_computed_by_helpers"]
                self.assertEqual(on_the_host > 0, batches == 0)

    def test_counts_are_printed(self):
        printed = self.succeed("critical-points", "grid:32")
        for count in GRID_32:
            self.assertRegex(printed, rf"\b{count}\b")

    def test_is_written_completely_or_not_at_all(self):
        self.report("critical-points", "grid:8")
        self.assertEqual(self.names(), ["report.json"])


@gale.needs_vtk
class Output(gale.CommandTest):
    NAMES = ["CriticalType", "IsOnBoundary", "ttkVertexScalarField"]

    def test_has_the_points_and_all_arrays(self):
        self.succeed("critical-points", "grid:32", "-o", "points.vtp")
        count, arrays = gale.vtk_xml_header(self.folder / "points.vtp")
        self.assertEqual(count, sum(GRID_32))
        self.assertEqual(sorted(arrays), sorted(["field", *self.NAMES]))
        self.assertEqual(self.names(), ["points.vtp"])

    def test_is_the_same_whatever_computed_it(self):
        files = set()
        for structure in gale.STRUCTURES:
            for capacity, threads in ((1, 1), (7, 8), (1000000, 2)):
                self.succeed("critical-points", "grid:16", "-o", "points.vtp", "--structure", structure,
                             "--capacity", capacity, "--threads", threads)
                files.add((self.folder / "points.vtp").read_bytes())
        self.assertEqual(len(files), 1)

    def test_input_arrays_travel_along(self):
        arrays = {"height": ("float", range(5)), "weight": ("double", [1] * 5), "label": ("int", [7] * 5)}
        points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
        self.write("mesh.vtk", gale.vtk_mesh(points, [[0, 1, 2, 3], [1, 2, 3, 4]], arrays))
        self.succeed("critical-points", "mesh.vtk", "-o", "points.vtp")
        self.assertEqual(sorted(gale.vtk_xml_header(self.folder / "points.vtp")[1]), sorted([*arrays, *self.NAMES]))

    def test_replaces_an_older_file(self):
        self.write("points.vtp", "something else")
        self.succeed("critical-points", "grid:8", "-o", "points.vtp")
        self.assertIn("CriticalType", gale.vtk_xml_header(self.folder / "points.vtp")[1])


if __name__ == "__main__":
    unittest.main()
