"""Volumes and grids that compute their cells: every file is that of the cells written out."""
import random
import unittest

import gale

# A command's arguments, and what it writes.
RUNS = [
    (["critical-points", "-o", "points.vtp"], ["points.vtp"]),
    (["discrete-gradient", "-o", "simplices.vtp", "--arrows", "arrows.vtp"], ["simplices.vtp", "arrows.vtp"]),
    (["morse-smale", "-o", "complex"],
     ["complex_critical_points.vtp", "complex_separatrices1.vtp", "complex_segmentation.vtu"]),
    (["morse-smale", "--persistence", "10%", "-o", "simple"],
     ["simple_critical_points.vtp", "simple_separatrices1.vtp", "simple_segmentation.vtu"]),
    (["persistence-diagram", "-o", "diagram.vtu"], ["diagram.vtu"]),
    (["merge-tree", "-o", "tree"], ["tree_nodes.vtp", "tree_arcs.vtp", "tree_segmentation.vtu"]),
    (["simplify-field", "--persistence", "10%", "-o", "field.vtu"], ["field.vtu"]),
    (["generate", "-o", "mesh.vtu"], ["mesh.vtu"]),
    (["segment", "-o", "segments.vtu"], ["segments.vtu"]),
]


@gale.needs_vtk
class Grids(gale.CommandTest):
    def contents(self, mesh, source, arguments, files, *more):
        out = self.succeed(arguments[0], *source, *arguments[1:], "--mesh", mesh, "-t", "2", *more)
        said = [line for line in out.splitlines() if not any(word in line for word in ("segment", "second", "memory", "MB"))]
        contents = []
        for name in files:
            path = self.folder / name
            contents.append(path.read_bytes())
            path.unlink()
        return said[:2], contents

    def expect_same(self, source):
        for arguments, files in RUNS:
            with self.subTest(source=source, arguments=arguments):
                _, computed = self.contents("computed", source, arguments, files)
                _, written = self.contents("written", source, arguments, files)
                for name, one, other in zip(files, computed, written):
                    self.assertEqual(one, other, name)

    def volume(self, dims, percent, levels):
        chance = random.Random(sum(dims) + percent)
        values = {}

        def value(x, y, z):
            return values.setdefault((x, y, z), 1 + chance.randrange(levels) if chance.randrange(100) < percent else 0)

        return self.write(f"volume{percent}.mha", gale.Volume(dims, value).mha())

    def test_synthetic_grids(self):
        self.expect_same(["grid:12"])
        self.expect_same(["plane:25"])
        self.expect_same(["ball:14"])

    def test_volumes_with_holes_and_pinches(self):
        for percent in (100, 92, 78):
            self.expect_same([self.volume((11, 9, 8), percent, 50), "--above", "0"])
        self.expect_same([self.volume((70, 3, 2), 95, 5), "--above", "0"])

    def test_walls(self):
        arguments = ["morse-smale", "--separatrices2", "-o", "complex"]
        files = RUNS[2][1] + ["complex_separatrices2.vtp"]
        self.assertEqual(*(self.contents(mesh, ["grid:10"], arguments, files)[1] for mesh in ("computed", "written")))

    def test_all_structures(self):
        for structure in gale.STRUCTURES:
            for arguments, files in RUNS[:2]:
                with self.subTest(structure=structure):
                    found = [self.contents(mesh, ["grid:9"], arguments, files, "--structure", structure)[1]
                             for mesh in ("computed", "written")]
                    self.assertEqual(*found)

    def test_given_segments_are_those_of_the_command(self):
        mesh = self.report("critical-points", "grid:8", "--segments", "random:7")["mesh"]
        self.assertEqual(mesh["segments"], 7)
        mesh = self.report("critical-points", "grid:8", "--capacity", "100")["mesh"]
        self.assertEqual(mesh["segments"], 6)


if __name__ == "__main__":
    unittest.main()
