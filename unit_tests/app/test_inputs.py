"""What the command reads: volumes and meshes, good and bad."""
import gzip
import json
import math
import re
import unittest

import gale

# One tetrahedron, and a second one on its triangle 1 2 3.
POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
TETRAHEDRA = [[0, 1, 2, 3], [1, 2, 3, 4]]
HEIGHT = {"height": ("float", range(5))}


@gale.needs_vtk
class Volumes(gale.CommandTest):
    # VTK takes an NRRD file's first axis for components where it is short, so make it 10 voxels.
    SLOPE = gale.Volume((10, 3, 4), lambda x, y, z: 1 + x + 20 * y + 100 * z)

    def write_slope(self):
        """Writes one volume in every format."""
        raw = self.SLOPE
        self.write("slope.raw", raw.data)
        return [self.write("slope.nrrd", raw.nrrd()), self.write("slope.mha", raw.mha()), self.write("slope.vti", raw.vti()),
                self.write("slope.mhd", raw.mha(data_file="slope.raw")), self.write("slope.nii", raw.nii()),
                self.write("slope.nii.gz", gzip.compress(raw.nii())), self.write("SLOPE.NRRD", raw.nrrd())]

    def test_a_slope_has_a_lowest_and_a_highest_corner(self):
        for name in self.write_slope():
            with self.subTest(name=name):
                report = self.report("critical-points", name, "--above", "0", "-o", "points.vtp")
                self.assertEqual(report["mesh"]["vertices"], 10 * 3 * 4)
                self.assertEqual(report["mesh"]["tetrahedra"], 9 * 2 * 3 * 6)
                self.assertEqual(list(report["result"].values()), [1, 0, 0, 1, 0])
                self.assertEqual(gale.vtk_xml_header(self.folder / "points.vtp")[0], 2)

    def test_above_keeps_cubes_whose_eight_corners_all_are(self):
        self.write("slope.nrrd", self.SLOPE.nrrd())
        self.assertEqual(self.report("info", "slope.nrrd", "--above", "100.5")["mesh"]["tetrahedra"], 9 * 2 * 2 * 6)
        # 101 is the value of voxel (0, 0, 1): the cube there goes, and with it the voxel.
        mesh = self.report("info", "slope.nrrd", "--above", "101")["mesh"]
        self.assertEqual((mesh["vertices"], mesh["tetrahedra"]), (10 * 3 * 3 - 1, (9 * 2 * 2 - 1) * 6))
        self.refuse(1, "info", "slope.nrrd", "--above", "1000", naming="slope.nrrd")

    def test_voxels_that_are_not_numbers_are_outside(self):
        hole = gale.Volume((4, 4, 4), lambda x, y, z: math.nan if (x, y, z) == (0, 0, 0) else x + 4 * y + 16 * z)
        self.write("hole.mha", hole.mha())
        for above in ([], ["--above", "-1"]):
            mesh = self.report("info", "hole.mha", *above)["mesh"]
            self.assertEqual((mesh["vertices"], mesh["tetrahedra"]), (63, 26 * 6))

    def test_a_bump_has_a_maximum(self):
        bump = gale.Volume((5, 5, 5), lambda x, y, z: -((x - 2) ** 2 + 1.1 * (y - 2) ** 2 + 1.3 * (z - 2) ** 2 + 0.01 * x * y))
        self.assertEqual(self.counts(self.write("bump.mha", bump.mha()))[3], 1)

    def test_voxels_that_lie_nowhere_are_refused(self):
        for spacing in ("nan 1 1", "1 inf 1", "1e308 1 1"):
            self.write("nowhere.mha", self.SLOPE.mha().replace(b"Spacing = 1 1 1", f"Spacing = {spacing}".encode()))
            for mesh in ("computed", "written"):
                self.refuse(1, "critical-points", "nowhere.mha", "--mesh", mesh, naming="nowhere.mha")

    def test_one_component_of_several(self):
        vectors = self.SLOPE.vti().decode().replace('Name="values"', 'Name="values" NumberOfComponents="2"')
        values = " ".join(map(str, self.SLOPE.values))
        doubled = " ".join(f"0 {value}" for value in self.SLOPE.values)
        name = self.write("vectors.vti", vectors.replace(values, doubled).replace(' Scalars="values"', ""))
        for command, output in (("info", []), ("segment", []), ("generate", ["-o", "mesh.vtu"]), ("critical-points", [])):
            with self.subTest(command=command):
                report = self.report(command, name, "-a", "values_1", "--above", "0", *output)
                self.assertEqual(report["mesh"]["vertices"], 10 * 3 * 4)
                self.refuse(1, command, name, *output, naming="values_1")

    def test_damaged_files(self):
        volumes = {"cut.nrrd": self.SLOPE.nrrd()[:-8], "cut.mha": self.SLOPE.mha()[:-8], "cut.nii": self.SLOPE.nii()[:-8],
                   "cut.nii.gz": gzip.compress(self.SLOPE.nii())[:-20], "cut.vti": self.SLOPE.vti()[:-40],
                   "noise.nrrd": b"\x00\xff" * 100, "noise.nii": b"\x00\xff" * 300, "noise.vtu": b"<VTKFile", "empty.vti": b"",
                   "noise.vtk": b"\x00\xff" * 100, "empty.mha": b""}
        for name, content in volumes.items():
            with self.subTest(name=name):
                self.refuse(1, "info", self.write(name, content), naming=name)


@gale.needs_vtk
class Meshes(gale.CommandTest):
    def mesh(self, points=POINTS, cells=TETRAHEDRA, arrays=HEIGHT):
        return self.write("mesh.vtk", gale.vtk_mesh(points, cells, arrays))

    def test_two_tetrahedra(self):
        self.assertEqual(self.counts(self.mesh()), [1, 0, 0, 1, 0])

    def test_cells_of_lower_dimension_are_left_out_with_a_notice(self):
        name = self.mesh(cells=TETRAHEDRA + [[0, 1], [1, 2, 3], [4]])
        self.assertEqual(self.succeed("critical-points", name).count("left out"), 1)
        for command in ("info", "critical-points"):  # without a structure and with one
            report = self.report(command, name)
            self.assertEqual(report["mesh"]["tetrahedra"], 2)
            self.assertEqual(report["notices"], ["left out 3 cells of a dimension below 3"])

    def test_notices_are_those_that_are_printed(self):
        name = self.mesh(cells=TETRAHEDRA + [[4]], arrays={"_index": ("float", [7, 7, 3, 7, 12])})
        for command in ("info", "critical-points"):
            printed = self.succeed(command, name, "--report", "report.json")
            notices = json.loads((self.folder / "report.json").read_text())["notices"]
            self.assertEqual(len(notices), 2)
            self.assertEqual(re.findall("(?m)^note +(.*)$", printed), notices)

    def test_nothing_is_noted_where_there_is_nothing_to_note(self):
        for command, *output in (["info"], ["segment"], ["critical-points"], ["discrete-gradient"], ["morse-smale"],
                                 ["relations", "--relation", "VV"], ["generate", "-o", "same.vtu"]):
            with self.subTest(command=command):
                self.assertEqual(self.report(command, self.mesh(), *output)["notices"], [])

    def test_other_solids_are_refused_unless_split(self):
        cube = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        name = self.mesh(points=cube, cells=[[0, 1, 3, 2, 4, 5, 7, 6]], arrays={"height": ("float", range(8))})
        self.refuse(1, "info", name, "--cells", "tetrahedra", naming="tetrahedra alone are wanted")
        self.assertEqual(self.report("info", name)["mesh"]["tetrahedra"], 6)

    def test_bad_meshes(self):
        for what, naming, mesh in (("a vertex twice", "1", dict(cells=[[0, 1, 2, 3], [1, 2, 2, 4]])),
                                   ("a tetrahedron twice", "0 and 2", dict(cells=TETRAHEDRA + [[2, 1, 0, 3]])),
                                   ("no triangles", "mesh.vtk", dict(cells=[[0, 1]])),
                                   ("NaN", "3", dict(arrays={"height": ("float", [0, 1, 2, "nan", 4])})),
                                   ("no array", "array", dict(arrays={}))):
            with self.subTest(what=what):
                self.refuse(1, "critical-points", self.mesh(**mesh), naming=naming)

    def test_array_by_name(self):
        name = self.mesh(arrays={**HEIGHT, "depth": ("int", [4, 3, 2, 1, 0]), "flat": ("double", [7] * 5)})
        self.succeed("critical-points", name, "--array", "depth", "-o", "points.vtp")
        self.assertEqual(gale.vtk_xml_header(self.folder / "points.vtp")[0], 2)
        self.assertEqual(self.counts(name, "-a", "flat"), [1, 0, 0, 1, 0])  # ties go by vertex
        self.refuse(1, "critical-points", name, "--array", "width", naming="width")

    def test_order_array_is_used(self):
        """By height alone the ends of the two tetrahedra are minimum and maximum; by its order, both are minima."""
        name = self.mesh(arrays={**HEIGHT, "height_Order": ("int", [0, 2, 3, 4, 1])})
        self.assertEqual(self.counts(name)[0], 2)
        self.assertIn("'height_Order' orders the vertices, though it contradicts 'height': vertex 1 comes after vertex 4",
                      self.succeed("critical-points", name))
        self.refuse(1, "critical-points", self.mesh(arrays={**HEIGHT, "height_Order": ("int", [0, 1, 2, 2, 4])}),
                  naming="height_Order")

    def test_infinities_are_values(self):
        self.assertEqual(self.counts(self.mesh(arrays={"height": ("double", ["-inf", 1, 2, 3, "inf"])})), [1, 0, 0, 1, 0])

    def test_segments_of_the_file(self):
        for name in ("ttkCompactTriangulationIndex", "_index"):
            with self.subTest(name=name):
                mesh = self.mesh(arrays={**HEIGHT, name: ("int", [7, 7, -3, 7, 12])})
                self.assertEqual(self.report("segment", mesh)["mesh"]["segments"], 3)
                self.assertEqual(self.report("critical-points", mesh)["mesh"]["segments"], 3)
        mesh = self.mesh(arrays={**HEIGHT, "part": ("int", [0, 1, 0, 1, 0])})
        self.assertEqual(self.report("critical-points", mesh)["mesh"]["segments"], 1)
        self.assertEqual(self.report("critical-points", mesh, "--segments", "part")["mesh"]["segments"], 2)
        self.refuse(1, "critical-points", mesh, "--segments", "parts", naming="parts")

    def test_arrays_that_cannot_be_segments_are_not_used_as_such(self):
        mesh = self.mesh(arrays={**HEIGHT, "_index": ("float", [7, 7, 3, 7, 12])})
        self.assertIn("_index", self.succeed("segment", mesh))
        self.assertEqual(self.report("segment", mesh)["mesh"]["segments"], 1)
        self.refuse(1, "segment", mesh, "--segments", "_index", naming="_index")

    def test_array_is_an_option_of_every_command(self):
        for command, name in (("info", ""), ("segment", ""), ("generate", "mesh.vtu")):
            with self.subTest(command=command):
                output = ["-o", name] if name else []
                self.succeed(command, self.mesh(), "-a", "height", *output)
                self.refuse(1, command, self.mesh(), "-a", "width", *output, naming="width")

    def test_a_field_is_selected_once(self):
        """Whoever selects one says so."""
        name = self.mesh(arrays={**HEIGHT, "depth": ("int", [4, 3, 2, 1, 0])})
        for command in ("critical-points", "discrete-gradient", "morse-smale"):
            for array, selected in (([], "height"), (["-a", "depth"], "depth")):
                with self.subTest(command=command, array=array):
                    printed = self.succeed(command, name, *array)
                    self.assertEqual(re.findall("(?m)^field +(.*)$", printed), [selected])

    def test_info_counts_what_is_not_a_number(self):
        name = self.mesh(arrays={"height": ("float", ["nan", 3, 2, "nan", 4]), "none": ("float", ["nan"] * 5)})
        arrays = self.report("info", name)["result"]["arrays"]
        self.assertEqual([(array["range"], array["nan"]) for array in arrays], [([2, 4], 2), (None, 5)])

    def test_isolated_vertices_are_legal(self):
        """A vertex without neighbours has no component below or above: degenerate."""
        mesh = self.mesh(points=POINTS + [(9, 9, 9)], arrays={"height": ("float", range(6))})
        self.assertEqual(self.counts(mesh), [1, 0, 0, 1, 1])


if __name__ == "__main__":
    unittest.main()
