"""Volumes and grids on several ranks, each of which has some layers as a grid of its own: the files of one rank, and of the cells written out."""
import random
import unittest

import gale
import ranks


@ranks.needs_mpi
@gale.needs_vtk
class GridsOnRanks(ranks.ComplexTest):
    def volume(self, name, dims, percent, levels, kind="float", gap=()):
        """A volume of few values, of which so many of a hundred are above 0, none in some layers."""
        chance = random.Random(sum(dims) + percent)
        values = {}

        def value(x, y, z):
            is_there = chance.randrange(100) < percent and z not in gap
            return values.setdefault((x, y, z), 1 + chance.randrange(levels) if is_there else 0)

        return self.write(name, gale.Volume(dims, value, kind).mha())

    def expect_same(self, count, source):
        """Critical points, gradient, complex, diagram and tree on so many ranks."""
        for command in ("critical-points", "discrete-gradient"):
            self.succeed(command, *source, "-o", "one.vtp")
            self.report_of(count, command, *source, "-o", "all.pvtp")
            key = "ttkVertexScalarField" if command == "critical-points" else ("CellDimension", "CellId")
            self.assertEqual(self.by_key(self.pieces("all.pvtp"), key), self.by_key([gale.XmlFile(self.folder / "one.vtp")], key))
        self.expect_complex_of_one_rank(count, *source)
        for command, options in (("persistence-diagram", ()), ("merge-tree", ("--type", "contour"))):
            expected = self.report(command, *source, *options)["result"]
            self.assertEqual(self.report_of(count, command, *source, *options)["result"], expected)

    def by_key(self, files, key):
        found = {}
        for file in files:
            arrays = file.point_arrays
            keys = arrays[key] if isinstance(key, str) else list(zip(*(arrays[name] for name in key)))
            for i, one in enumerate(keys):
                self.assertNotIn(one, found)
                found[one] = (file.points[i], {name: values[i] for name, values in arrays.items()})
        return found

    def test_masks_and_ties(self):
        self.volume("gap.mha", (9, 8, 14), 97, 8, gap=(5, 6, 7))
        self.expect_same(4, ("gap.mha", "--above", "0"))

    def test_thin_grids_and_planes(self):
        self.volume("thin.mha", (30, 14, 3), 99, 90)
        self.volume("plane.mha", (25, 22, 1), 92, 6)
        self.expect_same(3, ("thin.mha", "--above", "0"))
        self.expect_same(2, ("plane.mha", "--above", "0"))

    def test_cells_written_out_have_the_same_results(self):
        self.volume("volume.mha", (10, 9, 11), 95, 50, "double")
        for source in (("grid:12",), ("volume.mha", "--above", "0")):
            self.report("morse-smale", *source, "-o", "one")
            self.report_of(3, "morse-smale", *source, "--mesh", "written", "-o", "all")
            self.expect_files("all")


if __name__ == "__main__":
    unittest.main()
