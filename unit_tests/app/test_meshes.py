"""gale info, segment and generate, and that what they write can be read again."""
import unittest

import gale


class Info(gale.CommandTest):
    def test_says_how_large_a_mesh_is(self):
        printed = self.succeed("info", "grid:8")
        for fact in ("grid:8", "512", "2,058", "field"):
            self.assertIn(fact, printed)
        report = self.report("info", "grid:8")
        self.assertEqual((report["mesh"]["vertices"], report["mesh"]["tetrahedra"]), (8 ** 3, 6 * 7 ** 3))


class Segment(gale.CommandTest):
    def test_no_segment_has_more_than_the_capacity(self):
        for capacity in (1, 7, 100, 512, 1000000):
            with self.subTest(capacity=capacity):
                report = self.report("segment", "grid:8", "--capacity", capacity)
                self.assertGreaterEqual(report["mesh"]["segments"] * capacity, 512)
                self.assertLessEqual(report["result"]["largest"], capacity)
        self.assertEqual(report["mesh"]["segments"], 1)
        self.assertEqual(report["result"]["external_tetrahedra"], 0)

    @gale.needs_vtk
    def test_segments_are_found_again_in_what_it_writes(self):
        for name in ("mesh.vtu", "mesh.vtk"):
            with self.subTest(name=name):
                segments = self.report("segment", "grid:8", "--capacity", "20", "-o", name)["mesh"]["segments"]
                self.assertGreater(segments, 25)
                self.assertEqual(self.report("critical-points", name)["mesh"]["segments"], segments)
                self.assertEqual(self.report("critical-points", name, "--capacity", "1000")["mesh"]["segments"], 1)
        self.assertEqual(sorted(gale.vtk_xml_header(self.folder / "mesh.vtu")[1]), ["field", "ttkCompactTriangulationIndex"])


@gale.needs_vtk
class Generate(gale.CommandTest):
    def test_writes_the_mesh_that_an_input_stands_for(self):
        counts = self.counts("grid:12")
        for name in ("mesh.vtu", "mesh.vtk"):
            with self.subTest(name=name):
                self.succeed("generate", "grid:12", "-o", name)
                mesh = self.report("info", name)["mesh"]
                self.assertEqual((mesh["vertices"], mesh["tetrahedra"]), (12 ** 3, 6 * 11 ** 3))
                self.assertEqual(self.counts(name), counts)

    def test_a_volume_above_a_value(self):
        volume = gale.Volume((3, 3, 3), lambda x, y, z: x)
        self.succeed("generate", self.write("volume.mha", volume.mha()), "--above", "0", "-o", "mesh.vtu")
        mesh = self.report("info", "mesh.vtu")["mesh"]
        self.assertEqual((mesh["vertices"], mesh["tetrahedra"]), (2 * 3 * 3, 4 * 6))


if __name__ == "__main__":
    unittest.main()
