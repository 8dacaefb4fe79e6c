"""Meshes in pieces (.pvtu), as simulations on many ranks write them."""
import unittest

import gale
from meshes_in_pieces import MeshWithIds, pvtu, vtu, xml_array


@gale.needs_vtk
class Pieces(gale.CommandTest):
    def setUp(self):
        super().setUp()
        self.succeed("generate", "grid:8", "-o", "whole.vtu")
        whole = gale.XmlFile(self.folder / "whole.vtu")
        self.points, self.cells, self.field = whole.points, whole.cells("Cells"), whole.point_arrays["field"]
        self.owner = [min(2, int(sum(self.points[v][0] for v in cell) / 4 // 2.5)) for cell in self.cells]
        self.assertEqual(set(self.owner), {0, 1, 2})

    def put_piece(self, rank, with_ids, with_ghosts, more_arrays=""):
        """Rank's cells and, as ghosts, those that share a point with them."""
        own = {v for cell, owner in zip(self.cells, self.owner) if owner == rank for v in cell}
        kept = [(cell, int(owner != rank)) for cell, owner in zip(self.cells, self.owner)
                if owner == rank or (with_ghosts and own & set(cell))]
        vertices = sorted({v for cell, _ in kept for v in cell}, key=lambda v: (v * 7919) % 1009)
        place = {v: i for i, v in enumerate(vertices)}
        arrays = xml_array("Float32", "field", [self.field[v] for v in vertices]) + more_arrays
        if with_ids:
            arrays += xml_array("Int64", "ids", [v + 10**12 for v in vertices])
        ghosts = xml_array("UInt8", "vtkGhostType", [ghost for _, ghost in kept]) if with_ghosts else ""
        self.write(f"part{rank}.vtu", vtu([self.points[v] for v in vertices], [[place[v] for v in cell] for cell, _ in kept],
                                          arrays, ghosts, "Float32"))

    def put(self, with_ids=False, with_ghosts=False, ranks=3, ids="ids"):
        for rank in range(ranks):
            self.put_piece(rank, with_ids, with_ghosts)
        self.write("parts.pvtu", pvtu([f"part{rank}.vtu" for rank in range(3)], ids if with_ids else ""))

    def types_at_points(self, mesh):
        self.succeed("critical-points", mesh, "--array", "field", "-o", "critical.vtp")
        points, arrays = gale.read_vtp(self.folder / "critical.vtp")
        return sorted(zip(points, arrays["CriticalType"], arrays["IsOnBoundary"], arrays["field"]))

    def test_pieces_are_one_mesh(self):
        expected = self.types_at_points("whole.vtu")
        self.assertGreater(len(expected), 5)
        for with_ids in (False, True):
            for with_ghosts in (False, True):
                with self.subTest(ids=with_ids, ghosts=with_ghosts):
                    self.put(with_ids, with_ghosts)
                    mesh = self.report("info", "parts.pvtu")["mesh"]
                    self.assertEqual((mesh["vertices"], mesh["tetrahedra"]), (len(self.points), len(self.cells)))
                    self.assertEqual(self.types_at_points("parts.pvtu"), expected)

    def test_points_and_cells_are_numbered_by_their_ids_whatever_the_pieces(self):
        mesh = MeshWithIds(self.points, self.cells)
        points, cells, heights, ids = mesh.in_order_of_ids()
        self.write("sorted.vtk", gale.vtk_mesh(points, cells, {"height": ("float", heights), "ids": ("int", ids)}))
        self.succeed("morse-smale", "sorted.vtk", "-o", "one")
        expected = {name: (self.folder / name).read_bytes() for name in self.names() if name.startswith("one_")}
        self.assertEqual(len(expected), 3)
        for count, seed in ((1, 1), (3, 2), (5, 3)):
            with self.subTest(pieces=count):
                for k, text in enumerate(mesh.pieces(count, seed)):
                    self.write(f"part{k}.vtu", text)
                self.write("parts.pvtu", pvtu([f"part{k}.vtu" for k in range(count)], "ids", "cell ids"))
                self.succeed("generate", "parts.pvtu", "-o", "joined.vtu")
                joined = gale.XmlFile(self.folder / "joined.vtu")
                self.assertTrue((joined.points, joined.cells("Cells")) == (points, cells))  # assertEqual takes minutes to say no
                self.assertTrue(list(joined.point_arrays.items()) == [("height", heights), ("ids", ids)])
                self.succeed("morse-smale", "parts.pvtu", "-o", "one")
                for name, content in expected.items():
                    self.assertTrue((self.folder / name).read_bytes() == content, name)

    def test_ids_that_are_none_are_named(self):
        tetrahedron = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [[0, 1, 2, 3]])
        self.write("parts.pvtu", pvtu(["part.vtu"], "ids", "cell ids"))
        fields = xml_array("Float32", "field", range(4))
        for kind, wrong in (("Int32", -1), ("Int64", -2**63), ("Int64", 2**62), ("UInt64", 2**63 + 5)):
            for name in ("ids", "cell ids"):
                with self.subTest(kind=kind, wrong=wrong, name=name):
                    points = xml_array(kind, "ids", [5, 0, 7, wrong if name == "ids" else 1])
                    cells = xml_array(kind, "cell ids", [wrong if name == "cell ids" else 3])
                    self.write("part.vtu", vtu(*tetrahedron, fields + points, cells))
                    whose = "point 3" if name == "ids" else "cell 0"
                    self.refuse(1, "critical-points", "parts.pvtu",
                                naming=f"its piece 'part.vtu': the array '{name}' gives {whose} the id {wrong}, which is none")
        self.write("part.vtu", vtu(*tetrahedron, fields + xml_array("Int64", "ids", [2**62 - 1, 0, 7, 1])))
        self.refuse(1, "info", "parts.pvtu", naming="it has no global ids 'cell ids' of cells")

    def test_array_that_a_piece_lacks_is_left_out(self):
        self.put()
        self.put_piece(1, False, False, xml_array("Float32", "more", [0] * 10))
        self.refuse(1, "info", "parts.pvtu", naming="its piece 'part1.vtu'")
        self.put()
        text = (self.folder / "part0.vtu").read_text()
        count = int(text.split('NumberOfPoints="')[1].split('"')[0])
        self.put_piece(0, False, False, xml_array("Float32", "more", [1] * count))
        self.assertIn("left out the point array 'more': not all pieces have it", self.gale("info", "parts.pvtu").stdout)

    def test_bad_pieces_are_named(self):
        self.put(ranks=2)
        self.refuse(1, "info", "parts.pvtu", naming="its piece 'part2.vtu'")
        self.put(with_ids=True, ids="numbers")
        self.refuse(1, "info", "parts.pvtu", naming="it has no global ids 'numbers'")
        self.put(with_ids=True, ids="field")
        self.refuse(1, "info", "parts.pvtu", naming="its global ids 'field' are no whole numbers")
        self.put()
        self.write("part1.vtu", "nothing")
        self.refuse(1, "info", "parts.pvtu", naming="its piece 'part1.vtu'")
        self.put()
        whole = (self.folder / "parts.pvtu").read_text()
        self.write("parts.pvtu", whole.replace("part1.vtu", "../part1.vtu"))
        self.refuse(1, "info", "parts.pvtu", naming="outside of its folder")
        self.write("parts.pvtu", whole.replace(' Source="part1.vtu"', ""))
        self.refuse(1, "info", "parts.pvtu", naming="one of its pieces has no Source")
        part = (self.folder / "part1.vtu").read_text()
        head, tail = part.split('Name="connectivity" NumberOfComponents="1" format="ascii">')
        self.write("part1.vtu", head + 'Name="connectivity" NumberOfComponents="1" format="ascii">99999 ' + tail.split(" ", 1)[1])
        self.write("parts.pvtu", whole)
        self.refuse(1, "info", "parts.pvtu", naming="names point 99999 of")


if __name__ == "__main__":
    unittest.main()
