"""Meshes in pieces (.pvtu), as simulations on many ranks write them."""
import unittest

import gale


def xml_array(kind, name, values, components=1):
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
            f'{" ".join(map(str, values))}</DataArray>\n')


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
        self.write(f"part{rank}.vtu", (
            '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<UnstructuredGrid>\n'
            f'<Piece NumberOfPoints="{len(vertices)}" NumberOfCells="{len(kept)}">\n<PointData>\n{arrays}</PointData>\n'
            f"<CellData>\n{ghosts}</CellData>\n<Points>\n" +
            xml_array("Float32", "Points", [x for v in vertices for x in self.points[v]], 3) + "</Points>\n<Cells>\n" +
            xml_array("Int64", "connectivity", [place[v] for cell, _ in kept for v in cell]) +
            xml_array("Int64", "offsets", range(4, 4 * len(kept) + 1, 4)) + xml_array("UInt8", "types", [10] * len(kept)) +
            "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"))

    def put(self, with_ids=False, with_ghosts=False, ranks=3, ids="ids"):
        for rank in range(ranks):
            self.put_piece(rank, with_ids, with_ghosts)
        sources = "".join(f'<Piece Source="part{rank}.vtu"/>\n' for rank in range(3))
        self.write("parts.pvtu", (
            '<VTKFile type="PUnstructuredGrid" version="1.0" byte_order="LittleEndian">\n'
            f'<PUnstructuredGrid GhostLevel="{int(with_ghosts)}">\n<PPointData{f""" GlobalIds="{ids}" """ if with_ids else ""}>\n'
            f'<PDataArray type="Float32" Name="field"/></PPointData>\n{sources}</PUnstructuredGrid>\n</VTKFile>\n'))

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
