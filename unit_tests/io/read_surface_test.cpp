#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include <gale/io/read.hpp>
#include <gale/io/synthetic.hpp>

#include "io/io_fixtures.hpp"

/// Surfaces in all formats that have them, made by hand.
namespace gale::io {
namespace {

using test::error_of;
using test::names_of;
using test::points_of;
using test::triangles_of;
using test::values_of;
using Ids = std::vector<int>;
using Notices = std::vector<std::string>;

/// The cells of the file that triangles are of.
std::vector<std::int32_t> cells_of(const Dataset& mesh) {
  EXPECT_EQ(names_of(mesh.cell_arrays), std::vector<std::string>{"GlobalCellIds"});
  return mesh.cell_arrays.empty() ? std::vector<std::int32_t>() : values_of<std::int32_t>(mesh.cell_arrays[0]);
}

class ReadSurface : public test::VtkTest {
 protected:
  Dataset read_as(const std::string& name, const std::string& content) const { return read(folder.put(name, content)); }

  void refuse(const std::string& name, const std::string& content, const std::string& naming,
              const ReadOptions& options = {}) const {
    const std::string path = folder.put(name, content);
    const std::string message = error_of([&] { read(path, options); });
    EXPECT_EQ(message.find("cannot read '" + path + "': "), 0u) << message;
    EXPECT_NE(message.find(naming), std::string::npos) << message;
  }
};

// Six points of a strip of two squares: (0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1).
const std::string six_points = "0 0 0  1 0 0  2 0 0  0 1 0  1 1 0  2 1 0";

std::string legacy_of(const std::string& rest, const std::string& version = "3.0") {
  return "# vtk DataFile Version " + version + "\nby hand\nASCII\nDATASET " + rest;
}

TEST_F(ReadSurface, UnstructuredGridOf2dCells) {
  const std::string head = "UNSTRUCTURED_GRID\nPOINTS 6 float\n" + six_points + "\n";
  const std::string cells =
      "CELLS 6 24\n3 0 1 3\n4 1 2 5 4\n4 0 1 3 4\n4 4 1 5 2\n2 0 1\n1 3\nCELL_TYPES 6\n5 9 8 6 3 1\n";
  const Dataset mesh = read_as("a.vtk", legacy_of(head + cells));
  EXPECT_EQ(mesh.dimension(), 2);
  EXPECT_EQ(mesh.tetrahedra.extent(0), 0u);
  // A quad's fan begins at its lowest point, the pixel's points come by rows, a strip's second triangle is turned.
  EXPECT_EQ(triangles_of(mesh), (Ids{0, 1, 3, 1, 2, 5, 1, 5, 4, 0, 1, 4, 0, 4, 3, 4, 1, 5, 1, 2, 5}));
  EXPECT_EQ(cells_of(mesh), (std::vector<std::int32_t>{0, 1, 1, 2, 2, 3, 3}));
  EXPECT_EQ(mesh.notices, (Notices{"split 1 triangle strips, 1 pixels and 1 quads into 6 triangles",
                                   "left out 2 cells of a dimension below 2"}));
  ReadOptions simplices;
  simplices.simplices_alone = true;
  refuse("b.vtk", legacy_of(head + cells), "it has 1 triangle strips, 1 pixels and 1 quads, and triangles alone are",
         simplices);
  refuse("c.vtk", legacy_of(head + "CELLS 1 9\n8 0 1 2 3 4 5 0 1\nCELL_TYPES 1\n23\n"),
         "cell 0 is a vtkQuadraticQuad, which isn't split");
  refuse("d.vtk", legacy_of(head + "CELLS 1 5\n4 0 1 1 0\nCELL_TYPES 1\n9\n"), "no triangles: its cells have no area");
}

TEST_F(ReadSurface, CellsOfTheHighestDimensionCount) {
  const Dataset mesh = read_as("a.vtk", legacy_of("UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n"
                                                  "CELLS 2 9\n3 0 1 2\n4 0 1 2 3\nCELL_TYPES 2\n5 10\n"));
  EXPECT_EQ(mesh.dimension(), 3);
  EXPECT_EQ(mesh.triangles.extent(0), 0u);
  EXPECT_EQ(mesh.notices, Notices{"left out 1 cells of a dimension below 3"});
}

TEST_F(ReadSurface, TrianglesAloneStayAsTheyAre) {
  const Dataset mesh = read_as("a.vtk", legacy_of("POLYDATA\nPOINTS 6 double\n" + six_points +
                                                  "\nPOLYGONS 2 8\n3 4 1 0\n3 5 2 1\nPOINT_DATA 6\nSCALARS h int 1\n"
                                                  "LOOKUP_TABLE default\n5 4 3 2 1 0\n"));
  EXPECT_EQ(triangles_of(mesh), (Ids{4, 1, 0, 5, 2, 1}));
  EXPECT_TRUE(mesh.cell_arrays.empty());
  EXPECT_TRUE(mesh.notices.empty());
  EXPECT_EQ(values_of<std::int32_t>(mesh.arrays[0]), (std::vector<std::int32_t>{5, 4, 3, 2, 1, 0}));
}

/// VTK counts points, lines, polygons and strips in that order, whatever their order in the file.
const Ids of_all_kinds = {0, 1, 3, 1, 2, 5, 1, 5, 4, 0, 1, 3, 1, 4, 3};
const std::vector<std::int32_t> cells_of_all_kinds = {3, 4, 4, 5, 5};
const Notices notices_of_all_kinds = {"split 1 triangle strips and 1 quads into 4 triangles",
                                      "left out 3 cells of a dimension below 2"};

TEST_F(ReadSurface, LegacyPolyDataOfAllKinds) {
  const std::string head = "POLYDATA\nPOINTS 6 float\n" + six_points + "\n";
  const Dataset old = read_as("old.vtk", legacy_of(head + "POLYGONS 2 9\n3 0 1 3\n4 1 2 5 4\nTRIANGLE_STRIPS 1 5\n"
                                                          "4 0 1 3 4\nVERTICES 2 4\n1 0\n1 5\nLINES 1 4\n3 0 1 2\n"));
  EXPECT_EQ(triangles_of(old), of_all_kinds);
  EXPECT_EQ(cells_of(old), cells_of_all_kinds);
  EXPECT_EQ(old.notices, notices_of_all_kinds);
  const auto kind = [](const std::string& name, const std::string& ends, const std::string& points) {
    std::istringstream a(ends), b(points);
    const auto count = [](std::istringstream& words) {
      int n = 0;
      for (std::string word; words >> word;) ++n;
      return std::to_string(n);
    };
    return name + " " + count(a) + " " + count(b) + "\nOFFSETS vtktypeint64\n" + ends +
           "\nCONNECTIVITY vtktypeint64\n" + points + "\n";
  };
  const std::string below = kind("VERTICES", "0 1 2", "0 5") + kind("LINES", "0 3", "0 1 2");
  const Dataset recent = read_as("new.vtk", legacy_of(head + below + kind("POLYGONS", "0 3 7", "0 1 3 1 2 5 4") +
                                                          kind("TRIANGLE_STRIPS", "0 4", "0 1 3 4"),
                                                      "5.1"));
  EXPECT_EQ(triangles_of(recent), of_all_kinds);
  EXPECT_EQ(cells_of(recent), cells_of_all_kinds);
  EXPECT_EQ(recent.notices, notices_of_all_kinds);
  refuse("a.vtk", legacy_of(head + kind("POLYGONS", "0 4", "0 1 3"), "5.1"),
         "polygon 0 ends at 4 in a connectivity of 3");
  refuse("b.vtk", legacy_of(head + kind("TRIANGLE_STRIPS", "0 4", "0 1 3"), "5.1"), "strip 0 ends at 4");
  refuse("c.vtk", legacy_of(head + kind("POLYGONS", "0 3", "0 1 6"), "5.1"), "cell 0 names point 6 of 6");
  refuse("d.vtk", legacy_of(head + kind("POLYGONS", "0 2", "0 1"), "5.1"), "cell 0 is a vtkPolygon of 2 points");
  refuse("e.vtk", legacy_of(head + "POLYGONS 1 1000000000\n3 0 1 2\n"), "of 1000000000 values");
  refuse("f.vtk", legacy_of(head + "VERTICES 1 2\n1 0\n"), "it has no tetrahedra and no triangles");
}

std::string vtp_piece(const std::string& polys = "0 1 3 1 2 5 4", const std::string& ends = "3 7",
                      const std::string& verts = "2") {
  const auto array = [](const std::string& name, const std::string& values) {
    return "<DataArray type=\"Int64\" Name=\"" + name + "\" format=\"ascii\">" + values + "</DataArray>";
  };
  const auto kind = [&](const std::string& name, const std::string& points, const std::string& offsets) {
    return "<" + name + ">" + array("connectivity", points) + array("offsets", offsets) + "</" + name + ">";
  };
  return "<Piece NumberOfPoints=\"6\" NumberOfVerts=\"" + verts +
         R"(" NumberOfLines="1" NumberOfStrips="1" NumberOfPolys="2"><PointData>)" + array("h", "1 2 3 4 5 6") +
         R"(</PointData><Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">)" + six_points +
         "</DataArray></Points>" + kind("Verts", "0 5", "1 2") + kind("Lines", "0 1 2", "3") +
         kind("Strips", "0 1 3 4", "4") + kind("Polys", polys, ends) + "</Piece>";
}

std::string vtp_of(const std::string& pieces) {
  return R"(<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian"><PolyData>)" + pieces +
         "</PolyData></VTKFile>";
}

TEST_F(ReadSurface, XmlPolyDataInOnePieceOrSeveral) {
  const Dataset one = read_as("one.vtp", vtp_of(vtp_piece()));
  EXPECT_EQ(triangles_of(one), of_all_kinds);
  EXPECT_EQ(cells_of(one), cells_of_all_kinds);
  EXPECT_EQ(one.notices, notices_of_all_kinds);
  EXPECT_EQ(values_of<std::int64_t>(one.arrays[0]), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6}));
  const Dataset two = read_as("two.vtp", vtp_of(vtp_piece() + vtp_piece()));
  Ids expected = of_all_kinds;
  for (const int id : of_all_kinds) expected.push_back(id + 6);
  EXPECT_EQ(triangles_of(two), expected);
  EXPECT_EQ(test::point_count_of(two), 12u);
  EXPECT_EQ(cells_of(two), (std::vector<std::int32_t>{3, 4, 4, 5, 5, 9, 10, 10, 11, 11}));
  refuse("a.vtp", vtp_of(vtp_piece("0 1 3 1 2 5 9")), "cell 4 names point 9 of 6");
  refuse("b.vtp", vtp_of(vtp_piece("0 1 3 1 2 5 4", "3 8")), "polygon 1 ends at 8 in a connectivity of 7");
  // What no polygon has isn't the strip's, nor the next piece's.
  const Dataset longer = read_as("f.vtp", vtp_of(vtp_piece("0 1 3 1 2 5 4 2 2") + vtp_piece()));
  EXPECT_EQ(triangles_of(longer), expected);
  for (const std::string id : {"6", "-1", "9223372036854775807"}) {
    for (const int piece : {0, 1}) {
      const std::string bad = vtp_piece("0 1 3 1 2 5 " + id), good = vtp_piece();
      refuse("g.vtp", vtp_of(piece == 0 ? bad + good : good + bad),
             "cell " + std::to_string(6 * piece + 4) + " names point " + id + " of the 6 of its piece");
    }
  }
  refuse("h.vtp", vtp_of(vtp_piece() + vtp_piece("0 1 3 1 2 5 4", "3 9223372036854775807")), "polygon 1 ends at 92233");
  refuse("c.vtp", vtp_of(vtp_piece("0 1 3 1 2 5 4", "3 7", "1000000000000")), "1000000000000");
  refuse("d.vtp", vtp_of(""), "it has no tetrahedra and no triangles");
  refuse("e.vtp", vtp_of("").replace(15, 8, "ImageData"), "no VTKFile of type PolyData");
}

TEST_F(ReadSurface, GridsOfOneLayer) {
  const std::string axis = "X_COORDINATES 3 float\n0 1 2\nY_COORDINATES 2 float\n0 1\nZ_COORDINATES 1 float\n5\n";
  const Dataset flat = read_as("a.vtk", legacy_of("RECTILINEAR_GRID\nDIMENSIONS 3 2 1\n" + axis));
  const Ids as_a_plane = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
  EXPECT_EQ(triangles_of(flat), as_a_plane);
  EXPECT_EQ(flat.notices, Notices{"split 2 pixels into 4 triangles"});
  EXPECT_EQ(points_of(flat)[17], 5);
  for (const std::string size : {"3 2 1", "3 1 2", "1 3 2"}) {
    const Dataset bent =
        read_as("b.vtk", legacy_of("STRUCTURED_GRID\nDIMENSIONS " + size + "\nPOINTS 6 float\n" + six_points));
    EXPECT_EQ(triangles_of(bent), as_a_plane) << size;
    EXPECT_EQ(bent.notices, Notices{"split 2 quads into 4 triangles"});
  }
  refuse("c.vtk", legacy_of("STRUCTURED_GRID\nDIMENSIONS 6 1 1\nPOINTS 6 float\n" + six_points), "no triangles");
}

/// The squares of an image of one layer are cut as those of plane:N, whichever axis has one voxel.
TEST_F(ReadSurface, ImagesOfOneLayer) {
  std::string values;
  for (int i = 0; i < 12; ++i) values += std::to_string(i) + " ";
  const auto image = [&](const std::string& size, const std::string& all) {
    return legacy_of("STRUCTURED_POINTS\nDIMENSIONS " + size +
                     "\nORIGIN 1 2 3\nSPACING 1 2 4\nPOINT_DATA 12\nSCALARS h float 1\nLOOKUP_TABLE default\n" + all);
  };
  const std::vector<std::vector<double>> lasts = {{4, 6, 3}, {4, 2, 11}, {1, 8, 11}};
  const std::vector<std::string> sizes = {"4 3 1", "4 1 3", "1 4 3"};
  for (int k = 0; k < 3; ++k) {
    const Dataset mesh = read_as("a.vtk", image(sizes[k], values));
    ASSERT_EQ(mesh.triangles.extent(0), 12u) << sizes[k];
    for (int square = 0; square < 6; ++square) {
      const int a = square / 3 * 4 + square % 3;
      const int expected[2][3] = {{a, a + 1, a + 5}, {a, a + 4, a + 5}};
      for (int t = 0; t < 2; ++t) {
        for (int c = 0; c < 3; ++c) EXPECT_EQ(mesh.triangles(2 * square + t, c), expected[t][c]);
      }
    }
    const std::vector<double> points = points_of(mesh);
    EXPECT_EQ(std::vector<double>(points.end() - 3, points.end()), lasts[k]) << sizes[k];
  }
  // Without the voxel 5, four squares go, and no voxel beside: 0 to 4, 6 to 11 stay where a square has them.
  ReadOptions above;
  above.above = 0;
  std::string hole = values;
  hole.replace(hole.find(" 5 "), 3, " 0 ");
  hole.replace(0, 1, "1");
  const Dataset holed = read(folder.put("b.vtk", image("4 3 1", hole)), above);
  // The squares at 2 and 6 are left: voxels 2, 3, 6, 7, 10, 11 become vertices 0 to 5.
  EXPECT_EQ(triangles_of(holed), (Ids{0, 1, 3, 0, 2, 3, 2, 3, 5, 2, 4, 5}));
  EXPECT_EQ(values_of<float>(holed.arrays[0]), (std::vector<float>{2, 3, 6, 7, 10, 11}));
  above.above = 100;
  refuse("c.vtk", image("4 3 1", values), "no four neighbouring voxels of 'h' are all above 100", above);
  refuse("d.vtk", image("12 1 1", values), "12 x 1 x 1 voxels: it needs at least 2 in two directions");
}

TEST(ReadPlane, IsTheLowestLayerOfAGrid) {
  const Dataset plane = read("plane:7"), grid = make_grid(7);
  ASSERT_EQ(test::point_count_of(plane), 49u);
  ASSERT_EQ(plane.triangles.extent(0), 72u);
  EXPECT_EQ(plane.dimension(), 2);
  const std::vector<double> of_plane = points_of(plane), of_grid = points_of(grid);
  EXPECT_TRUE(std::equal(of_plane.begin(), of_plane.end(), of_grid.begin()));
  EXPECT_EQ(plane.arrays[0].name, "field");
  const auto &flat = values_of<float>(plane.arrays[0]), &field = values_of<float>(grid.arrays[0]);
  for (std::size_t i = 0; i < flat.size(); ++i) EXPECT_EQ(flat[i], field[i]) << i;
  // The square at (2, 1), whose point is 9.
  const std::vector<int> all = triangles_of(plane), square(all.begin() + 6 * 8, all.begin() + 6 * 9);
  EXPECT_EQ(square, (Ids{9, 10, 17, 9, 16, 17}));
  EXPECT_EQ(error_of([] { read("plane:1"); }), "plane:1 has no triangles: N must be at least 2");
  EXPECT_EQ(error_of([] { read("plane:x"); }), "cannot make 'plane:x': N must be a whole number");
  EXPECT_NE(error_of([] { make_plane(40000); }).find("3199840002 triangles"), std::string::npos);
}

std::string binary_stl(const std::vector<float>& corners, const std::string& header = "by hand") {
  std::string content = header;
  content.resize(80);
  const auto count = static_cast<std::uint32_t>(corners.size() / 9);
  content.append(reinterpret_cast<const char*>(&count), 4);  // on a machine whose lowest bytes come first
  for (std::size_t facet = 0; facet < count; ++facet) {
    content.append(12, '\0');
    content.append(reinterpret_cast<const char*>(&corners[9 * facet]), 36);
    content.append(2, '\7');
  }
  return content;
}

/// Two facets with an edge in common, in which -0 and 0 are one, and a facet that has a corner twice.
const std::vector<float> facets = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, -0.0F, 1, 1, 0, 1, 1, 0, 0, 0, 0};

TEST_F(ReadSurface, StlMergesEqualCorners) {
  for (const std::string header : {"by hand", "solid but binary"}) {
    const Dataset mesh = read_as("a.STL", binary_stl(facets, header));
    EXPECT_EQ(triangles_of(mesh), (Ids{0, 1, 2, 1, 3, 2}));
    EXPECT_EQ(points_of(mesh), (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}));
    EXPECT_EQ(mesh.points.index(), 0u);
    EXPECT_EQ(cells_of(mesh), (std::vector<std::int32_t>{0, 1}));
    EXPECT_EQ(mesh.notices, Notices{"left out 1 cells of a dimension below 2"});
  }
  const Dataset text = read_as("b.stl", R"(SOLID two words
 facet normal 0 0 1
  outer loop
   vertex 0 0 0
   vertex 1 0 0
   vertex 0 1 0
  endloop
 endfacet
endsolid two words
solid facet
facet normal nan nan nan outer loop vertex 1 0 -0 vertex 1e0 +1 0 vertex 0 1.0 0 endloop endfacet
endsolid)");
  EXPECT_EQ(triangles_of(text), (Ids{0, 1, 2, 1, 3, 2}));
  EXPECT_TRUE(text.cell_arrays.empty());
  // Floats that differ in their last bit are two points.
  std::vector<float> near = {0, 0, 0, 1, 0, 0, 0, 1, 0, std::nextafter(1.0F, 2.0F), 0, 0, 1, 1, 0, 0, 1, 0};
  EXPECT_EQ(test::point_count_of(read_as("c.stl", binary_stl(near))), 5u);
}

TEST_F(ReadSurface, StlOfManyFacets) {
  // Two triangles for each square of 60 by 60, each corner by its place.
  std::vector<float> corners;
  const auto add = [&](int x, int y) { corners.insert(corners.end(), {float(x), float(y), float(x * y)}); };
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      add(x, y), add(x + 1, y), add(x + 1, y + 1);
      add(x, y), add(x, y + 1), add(x + 1, y + 1);
    }
  }
  const Dataset mesh = read_as("a.stl", binary_stl(corners));
  EXPECT_EQ(test::point_count_of(mesh), 61u * 61u);
  const std::vector<double> points = points_of(mesh);
  const std::vector<int> ids = triangles_of(mesh);
  ASSERT_EQ(ids.size(), corners.size() / 3);
  int highest = -1;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    EXPECT_LE(ids[k], highest + 1) << "numbers are in the order of their first corners";
    highest = std::max(highest, ids[k]);
    for (int d = 0; d < 3; ++d) EXPECT_EQ(points[3 * ids[k] + d], corners[3 * k + d]);
  }
}

TEST_F(ReadSurface, StlThatIsWrong) {
  const std::string whole = binary_stl(facets);
  refuse("a.stl", whole.substr(0, whole.size() - 1), "it says 3 facets, and has 2");
  refuse("b.stl", whole.substr(0, 60), "it has 60 bytes");
  refuse("c.stl", binary_stl({}), "it has no tetrahedra and no triangles");
  EXPECT_EQ(read_as("d.stl", whole + "more").notices.back(), "left out 4 bytes behind its facets");
  std::string huge = whole;
  std::memset(&huge[80], 0xff, 4);
  refuse("e.stl", huge, "it says 4294967295 facets, and has 3");
  const std::string start = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n";
  refuse("f.stl", start + "vertex 1 0 x", "a coordinate of facet 0 is 'x'");
  refuse("g.stl", start + "endloop", "facet 0 has 'endloop' where 'vertex' is to be");
  refuse("h.stl", "solid\nfacets", "facet 0 begins with 'facets'");
  refuse("i.stl", "solid\nendsolid\n", "it has no tetrahedra and no triangles");
}

std::string ply_of(const std::string& elements, const std::string& values, const std::string& form = "ascii") {
  return "ply\nformat " + form + " 1.0\ncomment by hand\n" + elements + "end_header\n" + values;
}

const std::string four_vertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string vertex_values = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST_F(ReadSurface, PlyAsText) {
  const Dataset mesh = read_as(
      "a.ply", ply_of("element vertex 4\nproperty uchar red\nproperty double y\nproperty float x\nproperty int z\n"
                      "property list uchar float weights\nproperty short level\nelement material 1\nproperty int id\n"
                      "element face 2\nproperty list uchar int vertex_index\nproperty float quality\n",
                      "255 0 0 0 0 -1\n1 0 1 0 1 0.5 -2\n2 1 1 7 0 -3\n3 1.5 0 0 0 -4\n9\n4 0 1 2 3 0.5\n3 1 2 3 1\n"));
  EXPECT_EQ(triangles_of(mesh), (Ids{0, 1, 2, 0, 2, 3, 1, 2, 3}));
  EXPECT_EQ(points_of(mesh), (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 7, 0, 1.5, 0}));
  EXPECT_EQ(mesh.points.index(), 1u);
  EXPECT_EQ(names_of(mesh.arrays), (std::vector<std::string>{"red", "level"}));
  EXPECT_EQ(values_of<std::uint8_t>(mesh.arrays[0]), (std::vector<std::uint8_t>{255, 1, 2, 3}));
  EXPECT_EQ(values_of<std::int16_t>(mesh.arrays[1]), (std::vector<std::int16_t>{-1, -2, -3, -4}));
  EXPECT_EQ(mesh.notices,
            (Notices{"split 1 quads into 2 triangles", "left out the point array 'weights': its values are lists",
                     "left out its elements 'material'", "left out the cell arrays 'quality'"}));
}

/// The bytes of a value, the lowest first or last.
template <class T>
std::string bytes_of(T value, bool is_big) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (is_big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

TEST_F(ReadSurface, PlyOfBytes) {
  const std::string elements = four_vertices +
                               "property ushort mark\nelement face 1\n"
                               "property list uint uint16 vertex_indices\nelement tristrips 1\n"
                               "property list int int vertex_indices\n";
  for (const bool is_big : {false, true}) {
    std::string values;
    const float places[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int v = 0; v < 4; ++v) {
      for (const float coordinate : {places[v][0], places[v][1], -2.5F}) values += bytes_of(coordinate, is_big);
      values += bytes_of(std::uint16_t(1000 + v), is_big);
    }
    values += bytes_of(std::uint32_t(3), is_big);
    for (const int corner : {2, 1, 0}) values += bytes_of(std::uint16_t(corner), is_big);
    const std::vector<int> strips = {0, 1, 2, -1, 1, 2, 3, 0, -1};
    values += bytes_of(std::int32_t(strips.size()), is_big);
    for (const int entry : strips) values += bytes_of(std::int32_t(entry), is_big);
    const std::string form = is_big ? "binary_big_endian" : "binary_little_endian";
    const Dataset mesh = read_as("a.ply", ply_of(elements, values, form));
    EXPECT_EQ(triangles_of(mesh), (Ids{2, 1, 0, 0, 1, 2, 1, 2, 3, 2, 0, 3}));
    EXPECT_EQ(points_of(mesh), (std::vector<double>{0, 0, -2.5, 1, 0, -2.5, 1, 1, -2.5, 0, 1, -2.5}));
    EXPECT_EQ(values_of<std::uint16_t>(mesh.arrays[0]), (std::vector<std::uint16_t>{1000, 1001, 1002, 1003}));
    EXPECT_EQ(cells_of(mesh), (std::vector<std::int32_t>{0, 1, 2, 2}));
    refuse("b.ply", ply_of(elements, values.substr(0, values.size() - 1), form), "it ends before a value of");
    refuse("c.ply", ply_of(elements, values.substr(0, 40), form), "it has no room for 4 elements 'vertex'");
  }
}

TEST_F(ReadSurface, PlyThatIsWrong) {
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  EXPECT_EQ(triangles_of(read_as("good.ply", ply_of(four_vertices + faces, vertex_values + "3 0 1 2"))),
            (Ids{0, 1, 2}));
  refuse("a.ply", ply_of(four_vertices + faces, vertex_values + "3 0 1 4"), "cell 0 names point 4 of 4");
  refuse("b.ply", ply_of(four_vertices + faces, vertex_values + "3 0 1"), "it ends before a value of 'vertex_indices'");
  refuse("c.ply", ply_of(four_vertices + faces, vertex_values + "3 0 1 x"),
         "a value of 'vertex_indices' of 'face' is 'x'");
  refuse("d.ply", ply_of("element vertex 1000000000000\nproperty float x\n", "1"),
         "no room for 1000000000000 elements");
  refuse("e.ply", ply_of("element vertex 1\nproperty float x\nproperty float y\n", "1 2"), "its vertices have no z");
  refuse("f.ply", ply_of(four_vertices + "element face 1\nproperty int id\n", vertex_values + "3"), "have no list");
  refuse("g.ply", ply_of(four_vertices + four_vertices, vertex_values), "the elements 'vertex' twice");
  refuse("h.ply", ply_of(four_vertices, vertex_values, "other"), "its format is 'other'");
  refuse("i.ply", "ply\nformat ascii 1.0\nproperty int x\nend_header\n", "a property before the first element");
  refuse("j.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "its header doesn't end");
  refuse("k.ply", ply_of("element vertex 1\nproperty half x\n", "1"), "the type of property 0 of 'vertex' is 'half'");
  refuse("l.ply", ply_of("element nothing 18446744073709551615\n", ""), "it has no tetrahedra and no triangles");
  refuse("m.ply",
         ply_of(four_vertices + "element face 1\nproperty list int float vertex_indices\n", vertex_values + "3 0 1 2"),
         "'vertex_indices' of 'face' has values of type float32");
  refuse("n.ply",
         ply_of(four_vertices + "element face 1\nproperty list int int vertex_indices\n", vertex_values + "-3 0 1 2"),
         "has -3 numbers");
}

TEST_F(ReadSurface, Obj) {
  const Dataset mesh = read_as("a.obj", R"(# by hand
mtllib none.mtl
v 0 0 0
v 1 0 0 1.0
  v 1 1 0 0.5 0.5 0.5
f 1 2 3
v 0 0.1 1e0
vn 0 0 1
f 1/1 2/2 3/3 4/4
f 1//1 3//1 -1//1
f -4/1/1 -3/1/1 \
  -1/1/1
usemtl stone
vn 1 0 0)");
  EXPECT_EQ(triangles_of(mesh), (Ids{0, 1, 2, 0, 1, 2, 0, 2, 3, 0, 2, 3, 0, 1, 3}));
  EXPECT_EQ(points_of(mesh), (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0.1, 1}));
  EXPECT_EQ(mesh.notices, (Notices{"split 1 quads into 2 triangles",
                                   "left out lines that are neither v nor f: 'mtllib', 'vn', 'usemtl'"}));
  EXPECT_TRUE(mesh.arrays.empty());
}

TEST_F(ReadSurface, ObjThatIsWrong) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_TRUE(read_as("good.obj", points + "f 1 2 3\r\n").notices.empty());
  refuse("a.obj", points + "f 1 2 4", "cell 0 names point 3 of 3");
  refuse("b.obj", points + "f 1 2 0", "a corner of face 0 is '0'");
  refuse("c.obj", points + "f 1 2 -4", "a corner of face 0 is -4, and there are 3 vertices before it");
  refuse("d.obj", points + "f 1 2 x/3", "a corner of face 0 is 'x/3'");
  refuse("e.obj", points + "f 1 2", "cell 0 is a vtkPolygon of 2 points");
  refuse("f.obj", points + "v 1 2", "z of vertex 4 is ''");
  refuse("g.obj", points, "it has no tetrahedra and no triangles");
  refuse("h.obj", points + "f 1 2 99999999999999999999", "a corner of face 0 is '99999999999999999999'");
  refuse("i.obj", points + "f 1 2 3000000000", "is 2999999999");
}

/// UTF-8's byte-order mark.
const std::string mark = "\xef\xbb\xbf";

TEST_F(ReadSurface, TextsBehindAByteOrderMark) {
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
  for (const auto& [name, content] : std::vector<std::pair<std::string, std::string>>{
           {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
           {"a.off", "OFF\n3 1 0\n" + three + "3 0 1 2\n"},
           {"a.stl",
            "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"}}) {
    const Dataset mesh = read_as(name, mark + content);
    EXPECT_EQ(points_of(mesh), points) << name;
    EXPECT_EQ(triangles_of(mesh), (Ids{0, 1, 2})) << name;
    EXPECT_TRUE(mesh.notices.empty()) << name;
  }
  refuse("a.ply", mark + ply_of(four_vertices, vertex_values), "its first line is not 'ply'");
  refuse("a.vtk", mark + legacy_of("POLYDATA\n"), "its first line is not '# vtk DataFile Version ...'");
  refuse("a.nrrd", mark + "NRRD0004\n", "its first line is not 'NRRD...'");
  refuse("a.mha", mark + "NDims = 3\n", "its line '???NDims = 3' is not 'KEY = VALUE'");
}

TEST_F(ReadSurface, Off) {
  const Dataset mesh =
      read_as("a.off", "OFF # by hand\n\n4 2 0\n0 0 0\n# between\n1 0 0\n1 1 0.1\n0 1 0\n4 0 1 2 3\n3 3 2 1\n");
  EXPECT_EQ(triangles_of(mesh), (Ids{0, 1, 2, 0, 2, 3, 3, 2, 1}));
  EXPECT_EQ(points_of(mesh)[8], 0.1);
  EXPECT_EQ(mesh.notices, Notices{"split 1 quads into 2 triangles"});
  const Dataset coloured =
      read_as("b.off", "COFF 3 1\n0 0 0 255 0 0 255\n1 0 0 0 0 0 0\n0 1 0 1 1 1 1\n3 0 1 2 0.5 0.5 0.5\n");
  EXPECT_EQ(triangles_of(coloured), (Ids{0, 1, 2}));
  EXPECT_EQ(coloured.notices, Notices{"left out what follows coordinates and corners, such as colours"});
  const std::string start = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  refuse("c.off", "4OFF\n3 1 0\n", "its first word is '4OFF', not OFF");
  refuse("d.off", start, "it ends before face 0 of 1");
  refuse("e.off", start + "3 0 1", "a corner of face 0 of 1 is ''");
  refuse("f.off", start + "3 0 1 3", "cell 0 names point 3 of 3");
  refuse("g.off", "OFF\n1000000000 1 0\n", "the number of vertices is 1000000000");
  refuse("h.off", "OFF\n3 -1 0\n# room for three vertices\n", "the number of faces is -1");
  refuse("i.off", start + "3000000000 0 1 3", "the number of a face's corners is 3000000000");
  refuse("j.off", start + "3 0 1 -2", "corner 2 of polygon 0 is -2");
  refuse("k.off", "OFF BINARY\n", "it is binary");
}

}  // namespace
}  // namespace gale::io
