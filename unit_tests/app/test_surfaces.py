"""Surfaces: what the command reads, writes and refuses of them, and files that VTK's own writers wrote."""
import importlib.util
import sys
import unittest
from pathlib import Path

import gale

sys.path.append(str(Path(__file__).parent.parent / "fuzz"))
import exodus_files

POINTS = [(0, 0, 0), (1, 0, 0.5), (2, 0, 0.25), (0, 1, -1), (1, 1, 3), (2, 1, 0.125)]
POLYGONS = [[0, 1, 4, 3], [1, 2, 4], [2, 5, 4]]
TRIANGLES = [[0, 1, 4], [0, 4, 3], [1, 2, 4], [2, 5, 4]]

needs_vtk_in_python = unittest.skipUnless(gale.HAVE_VTK and importlib.util.find_spec("vtkmodules"), "Python has no VTK")


class Planes(gale.CommandTest):
    def test_planes_are_written_alike_in_all_formats_and_read_again(self):
        if not gale.HAVE_VTK:
            self.skipTest("this gale was built without VTK")
        for name, kind in (("plane.vtu", "Cells"), ("plane.vtp", "Polys")):
            report = self.report("generate", "plane:5", "-o", name)
            self.assertEqual((report["mesh"]["vertices"], report["mesh"]["triangles"], report["mesh"]["tetrahedra"]), (25, 32, None))
            file = gale.XmlFile(self.folder / name)
            self.assertEqual(file.cells(kind)[:4], [[0, 1, 6], [0, 5, 6], [1, 2, 7], [1, 6, 7]])
            self.assertEqual(len(file.cells(kind)), 32)
            self.assertEqual(file.points[7], (2, 1, 0))
        self.assertEqual(gale.XmlFile(self.folder / "plane.vtu").arrays("Cells")["types"], [5] * 32)
        self.succeed("generate", "plane:5", "-o", "plane.vtk")
        expected = (self.folder / "plane.vtu").read_bytes()
        for name in ("plane.vtu", "plane.vtk", "plane.vtp"):
            self.succeed("generate", name, "-o", "again.vtu")
            self.assertEqual((self.folder / "again.vtu").read_bytes(), expected, name)

    def test_tetrahedra_are_no_surface(self):
        self.refuse(1, "generate", "grid:3", "-o", "grid.vtp", naming="cannot write a mesh to 'grid.vtp': its extension is neither .vtu nor .vtk")
        self.assertEqual(self.names(), [])


@gale.needs_vtk
class Surfaces(gale.CommandTest):
    OBJ = "".join(f"v {x} {y} {z}\n" for x, y, z in POINTS) + "".join("f " + " ".join(str(p + 1) for p in cell) + "\n" for cell in POLYGONS)

    def test_cells_are_split_unless_told(self):
        name = self.write("mesh.obj", self.OBJ)
        report = self.report("generate", name, "-o", "mesh.vtu")
        self.assertEqual(report["notices"], ["split 1 quads into 2 triangles"])
        file = gale.XmlFile(self.folder / "mesh.vtu")
        self.assertEqual((file.cells("Cells"), file.cell_arrays["GlobalCellIds"]), (TRIANGLES, [0, 0, 1, 2]))
        for cells in ("simplices", "tetrahedra"):
            self.refuse(1, "generate", name, "-o", "mesh.vtu", "--cells", cells, naming="it has 1 quads, and triangles alone are wanted")
        self.refuse(2, "generate", name, "-o", "mesh.vtu", "--cells", "quads", naming="--cells")

    def test_blocks_of_exodus(self):
        self.write("shells.e", exodus_files.exodus_shells().content())
        report = self.report("generate", "shells.e", "-o", "mesh.vtu")
        self.assertEqual(report["notices"], ["split 2 quads into 4 triangles", "left out all but the first of 2 time steps"])
        file = gale.XmlFile(self.folder / "mesh.vtu")
        self.assertEqual(file.cells("Cells"), [[0, 1, 4], [0, 4, 2], [1, 5, 4], [1, 4, 3], [5, 2, 0]])
        self.assertEqual(file.cell_arrays["GlobalCellIds"], [0, 0, 1, 1, 2])
        self.assertEqual(list(file.point_arrays), ["field", "other"])

    def test_pieces_are_joined_where_points_are_equal(self):
        for k in range(2):
            self.write(f"{k}.obj", "".join(f"v {x + k} {y} 0\n" for y in (0, 1) for x in (0, 1)) + "f 1 2 4 3\n")
            self.succeed("generate", f"{k}.obj", "-o", f"{k}.vtu")
        self.write("all.pvtu", '<VTKFile type="PUnstructuredGrid" byte_order="LittleEndian"><PUnstructuredGrid>'
                   '<Piece Source="0.vtu"/><Piece Source="1.vtu"/></PUnstructuredGrid></VTKFile>')
        self.succeed("generate", "all.pvtu", "-o", "all.vtu")
        file = gale.XmlFile(self.folder / "all.vtu")
        self.assertEqual((len(file.points), len(file.cells("Cells"))), (6, 4))

    def test_info_says_what_they_are(self):
        report = self.report("info", self.write("mesh.obj", self.OBJ))
        self.assertEqual((report["mesh"]["triangles"], report["result"]["extent"]), (4, [[0, 2], [0, 1], [-1, 3]]))

    def test_where_there_is_no_field_the_height_is_named(self):
        self.write("mesh.obj", self.OBJ)
        self.refuse(1, "critical-points", "mesh.obj", naming="'mesh.obj' has no point array to analyse: --height x, y or z takes a coordinate")

    def test_every_analysis_takes_triangles(self):
        """The figures of plane:100: Euler's number, saddles between, and trees that are connected."""
        for structure in ("gale", "inline", "explicit"):
            report = self.report("critical-points", "plane:100", "--structure", structure)
            self.assertEqual(report["result"], {"minima": 77, "saddles1": 132, "saddles2": 0, "maxima": 63, "degenerate": 2})
            self.assertIsNone(report["mesh"]["tetrahedra"])
            report = self.report("discrete-gradient", "plane:100", "--structure", structure, "--arrows", "arrows.vtp")
            self.assertEqual(report["result"]["critical"], [77, 118, 42, 0])
            self.assertEqual(report["result"]["euler"], 1)
        report = self.report("morse-smale", "plane:100", "-o", "complex")
        self.assertEqual(report["result"]["separatrices"]["saddle_connectors"], 0)
        self.assertEqual([report["result"]["manifolds"][kind] for kind in ("ascending", "descending")], [42, 77])
        file = gale.XmlFile(self.folder / "complex_segmentation.vtu")
        self.assertEqual(set(file.point_arrays), {"field", "AscendingManifold", "DescendingManifold", "MorseSmaleManifold"})
        self.assertEqual(len(file.cells("Cells")), 2 * 99 * 99)
        self.assertEqual(self.report("persistence-diagram", "plane:100")["result"]["pairs"][:2], [76, 42])
        tree = self.report("merge-tree", "plane:100", "--type", "contour")["result"]
        self.assertEqual(tree["arcs"] + 1, tree["nodes"])
        self.assertEqual(self.report("relations", "plane:20", "--relation", "EF", "--verify")["mesh"]["triangles"], 722)
        self.assertIn("0 from brute force", self.succeed("relations", "plane:20", "--relation", "FE", "--verify", "--structure", "explicit"))
        self.refuse(1, "relations", "plane:20", "--relation", "ET", naming="a mesh of triangles has no relation ET")
        self.refuse(1, "morse-smale", "plane:20", "--separatrices2", "-o", "x", naming="2-separatrices")

    def test_counts_are_named_as_on_surfaces(self):
        """Critical triangles are maxima, and pairs of type 1 end there."""
        for command in ("discrete-gradient", "morse-smale"):
            said = [line.split()[:2] for line in self.succeed(command, "plane:100").splitlines()]
            for count in (["minima", "77"], ["saddles", "118"], ["maxima", "42"]):
                self.assertIn(count, said)
        said = [line.split()[:2] for line in self.succeed("critical-points", "plane:100").splitlines()]
        self.assertIn(["saddles", "132"], said)
        self.assertNotIn("2-saddles", [words[0] for words in said])
        said = [line.split()[:2] for line in self.succeed("persistence-diagram", "plane:100").splitlines()]
        self.assertIn(["saddle-maximum", "42"], said)
        self.assertNotIn("saddle-saddle", [words[0] for words in said])

    def test_a_coordinate_is_the_field_where_there_is_none(self):
        name = self.write("mesh.obj", self.OBJ)
        for axis in range(3):
            self.succeed("generate", name, "--height", "xyz"[axis], "-o", "mesh.vtu")
            file = gale.XmlFile(self.folder / "mesh.vtu")
            self.assertEqual(file.point_arrays, {"Height": [point[axis] for point in POINTS]})
        self.refuse(2, "generate", name, "--height", "w", "-o", "mesh.vtu", naming="--height")
        self.refuse(2, "generate", name, "--height", "x", "--array", "a", "-o", "mesh.vtu", naming="--height")

    def test_a_coordinate_is_the_field_before_others(self):
        """The one minimum of a grid's z, and its one maximum: ties go by vertex."""
        self.assertEqual(self.counts("grid:5", "--height", "z"), [1, 0, 0, 1, 0])


@needs_vtk_in_python
class OfVtk(gale.CommandTest):
    """What VTK's writers make of a surface is that surface."""

    def surface(self):
        from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

        points, polygons, strips, lines, verts = vtkPoints(), vtkCellArray(), vtkCellArray(), vtkCellArray(), vtkCellArray()
        heights = vtkFloatArray()
        heights.SetName("height")
        for point in POINTS:
            points.InsertNextPoint(point)
            heights.InsertNextValue(point[2])
        for cells, to in ((POLYGONS, polygons), ([[3, 4, 0, 1]], strips), ([[0, 1, 2]], lines), ([[5]], verts)):
            for cell in cells:
                to.InsertNextCell(len(cell))
                for point in cell:
                    to.InsertCellPoint(point)
        surface = vtkPolyData()
        surface.SetPoints(points)
        surface.SetPolys(polygons)
        surface.GetPointData().SetScalars(heights)
        self.more = (strips, lines, verts)
        return surface

    def write_by(self, writer, name, surface, **settings):
        writer.SetFileName(str(self.folder / name))
        writer.SetInputData(surface)
        for setting, value in settings.items():
            getattr(writer, setting)(value)
        self.assertEqual(writer.Write(), 1)
        return name

    def read(self, name):
        """(places of the corners of each triangle, {name: values} of the points)"""
        report = self.report("generate", name, "-o", "read.vtu")
        file = gale.XmlFile(self.folder / "read.vtu")
        self.notices, self.cells = report["notices"], file.cell_arrays.get("GlobalCellIds")
        return [[file.points[p] for p in cell] for cell in file.cells("Cells")], file.point_arrays

    def places(self, triangles):
        return [[POINTS[p] for p in triangle] for triangle in triangles]

    def test_xml_and_legacy(self):
        from vtkmodules.vtkIOLegacy import vtkPolyDataWriter
        from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

        surface = self.surface()
        surface.SetStrips(self.more[0])
        surface.SetLines(self.more[1])
        surface.SetVerts(self.more[2])
        files = [self.write_by(vtkPolyDataWriter(), f"{kind}{version}.vtk", surface, SetFileType=kind, SetFileVersion=version)
                 for kind in (1, 2) for version in (42, 51)]
        for mode in range(3):
            for compressor in range(4) if mode > 0 else [0]:
                for order in (0, 1):
                    files.append(self.write_by(vtkXMLPolyDataWriter(), f"{mode}{compressor}{order}.vtp", surface, SetDataMode=mode,
                                               SetCompressorType=compressor, SetByteOrder=order, SetHeaderType=32 << order))
        for name in files:
            with self.subTest(name):
                triangles, arrays = self.read(name)
                self.assertEqual(triangles, self.places(TRIANGLES + [[3, 4, 0], [4, 1, 0]]))
                self.assertEqual(arrays, {"height": [point[2] for point in POINTS]})
                self.assertEqual(self.cells, [2, 2, 3, 4, 5, 5])  # as VTK counts them
                self.assertEqual(self.notices, ["split 1 triangle strips and 1 quads into 4 triangles", "left out 2 cells of a dimension below 2"])

    def test_ply(self):
        from vtkmodules.vtkIOPLY import vtkPLYWriter

        for kind in (1, 2):
            for order in (0, 1):
                with self.subTest((kind, order)):
                    triangles, arrays = self.read(self.write_by(vtkPLYWriter(), "mesh.ply", self.surface(), SetFileType=kind, SetDataByteOrder=order))
                    self.assertEqual((triangles, arrays), (self.places(TRIANGLES), {}))

    def test_obj(self):
        from vtkmodules.vtkIOGeometry import vtkOBJWriter

        triangles, arrays = self.read(self.write_by(vtkOBJWriter(), "mesh.obj", self.surface()))
        self.assertEqual((triangles, arrays), (self.places(TRIANGLES), {}))

    def test_stl(self):
        from vtkmodules.vtkFiltersCore import vtkTriangleFilter
        from vtkmodules.vtkIOGeometry import vtkSTLWriter

        triangulated = vtkTriangleFilter()
        triangulated.SetInputData(self.surface())
        triangulated.Update()
        surface = triangulated.GetOutput()
        expected = [[surface.GetPoint(surface.GetCell(cell).GetPointId(k)) for k in range(3)] for cell in range(surface.GetNumberOfCells())]
        for kind in (1, 2):
            with self.subTest(kind):
                triangles, _ = self.read(self.write_by(vtkSTLWriter(), "mesh.stl", surface, SetFileType=kind))
                self.assertEqual(triangles, expected)
                self.assertEqual(len(gale.XmlFile(self.folder / "read.vtu").points), 6)


if __name__ == "__main__":
    unittest.main()
