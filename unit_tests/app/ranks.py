"""What the tests of the command on several ranks share."""
import json
import os
import random
import subprocess
import unittest
import xml.etree.ElementTree

import gale

MPIEXEC = os.environ.get("MPIEXEC")
RANKS = (2, 5)

needs_mpi = unittest.skipUnless(MPIEXEC, "this gale was built without MPI")


class RanksTest(gale.CommandTest):
    launcher = [MPIEXEC, "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1", "--mca",
                "odls_base_sigkill_timeout", "0"]

    def start(self, *command):
        return subprocess.run([*self.launcher, *map(str, command)], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=300)

    def launch(self, ranks, *arguments):
        return self.start("-n", ranks, gale.GALE, *arguments)

    def launch_each(self, *commands):
        """A rank for each command."""
        return self.start(*[word for command in commands for word in (":", "-n", "1", *command)][1:])

    def report_of(self, ranks, *arguments):
        run = self.launch(ranks, *arguments, "--report", "ranks.json")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return json.loads((self.folder / "ranks.json").read_text())

    def expect_one_line(self, run, code, naming):
        lines = [line for line in run.stderr.split("\n") if line.startswith("gale: ")]
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertEqual(len(lines), 1, run.stderr)
        self.assertIn(naming, lines[0])

    def pieces(self, name):
        """The pieces that a .pvtp or .pvtu names. They have the arrays that it says, in its order."""
        file = xml.etree.ElementTree.parse(self.folder / name).getroot()[0]
        pieces = [gale.XmlFile(self.folder / piece.get("Source")) for piece in file.findall("Piece")]
        for kind in ("PointData", "CellData"):
            types = {array.get("Name"): array.get("type") for array in file.find("P" + kind) or ()}
            for piece in pieces:
                self.assertEqual(list(piece.types(kind).items()), list(types.items()))
        return pieces

    def write_ties(self, grid, values=3, name="ties.vtk", type="float"):
        """The grid's mesh as ties.vtk, with a field of few values: most neighbours have equal ones. Or of so many, as `name`."""
        self.succeed("generate", grid, "-o", "whole.vtu")
        whole = gale.XmlFile(self.folder / "whole.vtu")
        chance = random.Random(3)
        arrays = {"height": (type, [chance.randrange(values) for _ in whole.points])}
        self.write(name, gale.vtk_mesh(whole.points, whole.cells("Cells"), arrays))


class ComplexTest(RanksTest):
    """Compares what several ranks wrote with what one did."""

    def simplices(self, files):
        """{(dimension, CellId): (point, values of arrays)} of critical simplices."""
        found = {}
        for file in files:
            arrays = file.point_arrays
            for i, key in enumerate(zip(arrays["CellDimension"], arrays["CellId"])):
                self.assertNotIn(key, found)
                found[key] = (file.points[i], {name: values[i] for name, values in arrays.items()})
        return found

    def cells(self, kind, files):
        """{SeparatrixId: its points with their arrays, and the arrays of each of its lines or polygons}."""
        found = {}
        for file in files:
            arrays, cells = file.cell_arrays, file.cells(kind)
            here = set(arrays["SeparatrixId"])
            self.assertFalse(here & set(found), "a separatrix in two pieces")
            for i, ends in enumerate(cells):
                points = [(file.points[k], *(values[k] for values in file.point_arrays.values())) for k in ends]
                found.setdefault(arrays["SeparatrixId"][i], []).append(
                    (points, {name: values[i] for name, values in arrays.items()}))
        return found

    def expect_segmentation(self, one, pieces):
        """Each vertex is no ghost in one piece, each cell is in one; in all, vertices have the values of one rank."""
        owned, simplices = set(), []
        for piece in pieces:
            arrays, ids = piece.point_arrays, piece.point_arrays["GlobalPointIds"]
            self.assertEqual(set(arrays), set(one.point_arrays) | {"vtkGhostType", "GlobalPointIds"})
            for i, vertex in enumerate(ids):
                self.assertEqual(piece.points[i], one.points[vertex])
                for name, values in one.point_arrays.items():
                    self.assertEqual(arrays[name][i], values[vertex], (name, vertex))
                if arrays["vtkGhostType"][i] == 0:
                    self.assertNotIn(vertex, owned)
                    owned.add(vertex)
            for cell, corners in zip(piece.cell_arrays["GlobalCellIds"], piece.cells("Cells")):
                simplices.append((cell, [ids[k] for k in corners]))
        self.assertEqual(owned, set(range(len(one.points))))
        cells = one.cell_arrays.get("GlobalCellIds", range(len(one.cells("Cells"))))  # several simplices may be of one
        self.assertEqual(sorted(simplices), sorted(zip(cells, one.cells("Cells"))))

    def expect_files(self, pieces_named, walls=False):
        kinds = ["critical_points.vtp", "separatrices1.vtp", "segmentation.vtu"] + ["separatrices2.vtp"] * walls
        read = {kind: gale.XmlFile(self.folder / f"one_{kind}") for kind in kinds}
        pieces = {kind: self.pieces(f"{pieces_named}_{kind.replace('.', '.p')}") for kind in read}
        self.assertEqual(self.simplices(pieces["critical_points.vtp"]), self.simplices([read["critical_points.vtp"]]))
        for name, kind in (("separatrices1.vtp", "Lines"), ("separatrices2.vtp", "Polys"))[:1 + walls]:
            self.assertEqual(self.cells(kind, pieces[name]), self.cells(kind, [read[name]]))
        self.expect_segmentation(read["segmentation.vtu"], pieces["segmentation.vtu"])

    def expect_complex_of_one_rank(self, count, source, *options):
        """The complex of an input on so many ranks, compared with that of one. `options` are those of the input, or switch off parts."""
        arguments = ("morse-smale", source, *options, "-o")
        expected = self.report(*arguments, "one")["result"]
        self.assertGreater(expected["separatrices"]["ascending"], 0)
        self.assertEqual(self.report_of(count, *arguments, "all")["result"], expected)
        self.expect_files("all", "--separatrices2" in options)
