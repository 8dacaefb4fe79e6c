#include <sstream>

#include <gtest/gtest.h>

#include <gale/io/read.hpp>

#include "io/io_fixtures.hpp"

/// Pieces in VTK's XML files, whose arrays differ or that have no points.
namespace gale::io {
namespace {

using test::error_of;
using test::names_of;
using test::values_of;
using ArrayNames = std::vector<std::string>;

class Pieces : public test::VtkTest {};

std::string array_of(const std::string& name, const std::string& values, const std::string& type = "Int32",
                     int components = 1) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" + std::to_string(components) +
         "\" format=\"ascii\">" + values + "</DataArray>\n";
}

/// Arrays of those names, in the order of their letters, with these values.
std::string arrays_of(const std::string& letters, const std::string& values) {
  std::string all;
  for (const char letter : letters) all += array_of(std::string(1, letter), values);
  return all;
}

std::string xml_of(const std::string& type, const std::string& attributes, const std::string& content) {
  return "<VTKFile type=\"" + type + R"(" version="1.0" byte_order="LittleEndian"><)" + type + attributes + ">" +
         content + "</" + type + "></VTKFile>";
}

/// A tetrahedron whose first corner is (x, 0, 0), with point and cell arrays of one letter each.
std::string tetrahedron(int x, const std::string& point_arrays, const std::string& cell_arrays = "",
                        const std::string& attributes = "") {
  const std::string begin = std::to_string(x) + " 0 0 ";
  return R"(<Piece NumberOfPoints="4" NumberOfCells="1"><PointData)" + attributes + ">" +
         arrays_of(point_arrays, "1 2 3 4") + "</PointData><CellData>" + arrays_of(cell_arrays, "7") +
         "</CellData><Points>" + array_of("", begin + "9 0 0 0 9 0 0 0 9", "Float64", 3) + "</Points><Cells>" +
         array_of("connectivity", "0 1 2 3") + array_of("offsets", "4") + array_of("types", "10", "UInt8") +
         "</Cells></Piece>";
}

std::string note(const std::string& name) { return "left out the point array '" + name + "': not all pieces have it"; }

/// Arrays of pieces' points, and what is left of them.
struct Case {
  ArrayNames pieces, left, notices;
};

const std::vector<Case> cases = {{{"fg", "f"}, {"f"}, {note("g")}},        {{"f", "fg"}, {"f"}, {note("g")}},
                                 {{"f", "g"}, {}, {note("f"), note("g")}}, {{"", "g"}, {}, {note("g")}},
                                 {{"gf", "f", "fg"}, {"f"}, {note("g")}},  {{"fg", "gf"}, {"f", "g"}, {}}};

std::set<std::string> as_set(const ArrayNames& names) { return {names.begin(), names.end()}; }

TEST_F(Pieces, OfMeshesLeaveOutArraysThatAnyPieceLacks) {
  for (const Case& one : cases) {
    std::string together, named;
    int k = 0;
    for (const std::string& letters : one.pieces) {
      const std::string piece = tetrahedron(k, letters), name = std::to_string(k++) + ".vtu";
      together += piece;
      folder.put(name, xml_of("UnstructuredGrid", "", piece));
      named += "<Piece Source=\"" + name + "\"/>";
    }
    for (const std::string& path : {folder.put("all.vtu", xml_of("UnstructuredGrid", "", together)),
                                    folder.put("all.pvtu", xml_of("PUnstructuredGrid", "", named))}) {
      const Dataset mesh = read(path);
      EXPECT_EQ(names_of(mesh.arrays), one.left) << path;
      EXPECT_EQ(as_set(mesh.notices), as_set(one.notices)) << path;
      EXPECT_EQ(mesh.notices.size(), one.notices.size()) << path;
      EXPECT_EQ(mesh.tetrahedra.extent(0), one.pieces.size());
    }
  }
}

/// The second piece's points are the first one's: its arrays count all the same, as on ranks.
TEST_F(Pieces, OfSharedPointsAloneCount) {
  folder.put("0.vtu", xml_of("UnstructuredGrid", "", tetrahedron(0, "f")));
  folder.put("1.vtu", xml_of("UnstructuredGrid", "", tetrahedron(0, "g")));
  const Dataset mesh = read(
      folder.put("all.pvtu", xml_of("PUnstructuredGrid", "", R"(<Piece Source="0.vtu"/><Piece Source="1.vtu"/>)")));
  EXPECT_TRUE(mesh.arrays.empty());
  EXPECT_EQ(mesh.notices, (ArrayNames{note("g"), note("f")}));
}

TEST_F(Pieces, NameTheCellArraysOfAll) {
  const std::string piece = tetrahedron(0, "f", "q"), other = tetrahedron(1, "f", "pq");
  folder.put("0.vtu", xml_of("UnstructuredGrid", "", piece));
  folder.put("1.vtu", xml_of("UnstructuredGrid", "", other));
  for (const std::string& path :
       {folder.put("all.vtu", xml_of("UnstructuredGrid", "", piece + other)),
        folder.put("all.pvtu", xml_of("PUnstructuredGrid", "", R"(<Piece Source="0.vtu"/><Piece Source="1.vtu"/>)"))}) {
    EXPECT_EQ(read(path).notices, ArrayNames{"left out the cell arrays 'q', 'p'"});
  }
}

TEST_F(Pieces, PutGlobalIdsBehindOtherArrays) {
  const auto names = [&](const std::string& attributes) {
    return names_of(
        read(folder.put("a.vtu", xml_of("UnstructuredGrid", "", tetrahedron(0, "ifg", "", attributes)))).arrays);
  };
  EXPECT_EQ(names(""), (ArrayNames{"i", "f", "g"}));
  EXPECT_EQ(names(R"( GlobalIds="i")"), (ArrayNames{"f", "g", "i"}));
  EXPECT_EQ(names(R"( GlobalIds="i" Scalars="g")"), (ArrayNames{"g", "f", "i"}));
  EXPECT_EQ(names(R"( GlobalIds="i" Scalars="i")"), (ArrayNames{"i", "f", "g"}));
}

/// Half of a grid of 3 x 2 x 2 points, whose values are places along x.
std::string half(const std::string& type, int low, const std::string& arrays, const std::string& value_type = "Int32") {
  const std::string extent = std::to_string(low) + " " + std::to_string(low + 1) + " 0 1 0 1";
  std::ostringstream values, points;
  for (int k = 0; k < 8; ++k) {
    values << low + k % 2 << ' ';
    points << low + k % 2 << ' ' << k / 2 % 2 << ' ' << k / 4 << ' ';
  }
  const std::string axis = std::to_string(low) + " " + std::to_string(low + 1);
  std::string piece = "<Piece Extent=\"" + extent + "\"><PointData>" + arrays_of(arrays, values.str()) + "</PointData>";
  if (type == "StructuredGrid") piece += "<Points>" + array_of("", points.str(), value_type, 3) + "</Points>";
  if (type == "RectilinearGrid")
    piece += "<Coordinates>" + array_of("x", axis) + array_of("y", "0 1") + array_of("z", "0 1") + "</Coordinates>";
  return piece + "</Piece>";
}

const std::string whole_extent = R"( WholeExtent="0 2 0 1 0 1")";
const std::vector<std::pair<std::string, std::string>> grids = {
    {"ImageData", "a.vti"}, {"StructuredGrid", "a.vts"}, {"RectilinearGrid", "a.vtr"}};

TEST_F(Pieces, OfGridsLeaveOutArraysThatAnyPieceLacks) {
  for (const auto& [type, name] : grids) {
    for (const Case& one : cases) {
      if (one.pieces.size() > 2) continue;
      const std::string path =
          folder.put(name, xml_of(type, whole_extent, half(type, 0, one.pieces[0]) + half(type, 1, one.pieces[1])));
      if (type == "ImageData" && one.left.empty()) {
        EXPECT_EQ(error_of([&] { read(path); }),
                  "cannot read '" + path + "': the image has no scalars: " + one.notices[0]);
        continue;
      }
      const Dataset mesh = read(path);
      EXPECT_EQ(names_of(mesh.arrays), one.left) << name;
      std::set<std::string> notices = as_set(mesh.notices);
      for (const std::string& notice : one.notices) EXPECT_EQ(notices.count(notice), 1u) << name << ": " << notice;
      EXPECT_EQ(mesh.notices.size(), one.notices.size() + (type == "ImageData" ? 0 : 1)) << name;
      if (one.left.empty()) continue;
      EXPECT_EQ(values_of<std::int32_t>(mesh.arrays[0]),
                (std::vector<std::int32_t>{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2}));
    }
  }
  const std::string type = "StructuredGrid";
  const std::string path =
      folder.put("b.vts", xml_of(type, whole_extent, half(type, 0, "f", "Float32") + half(type, 1, "f", "Float64")));
  EXPECT_NE(error_of([&] { read(path); }).find("the points of its pieces have different types"), std::string::npos);
}

TEST_F(Pieces, OfGridsWithoutPointsAreSkipped) {
  for (const auto& [type, name] : grids) {
    const std::string empty = R"(<Piece Extent="0 -1 0 -1 0 -1"><PointData></PointData></Piece>)",
                      halves = half(type, 0, "f") + half(type, 1, "f");
    const Dataset expected = read(folder.put(name, xml_of(type, whole_extent, halves)));
    test::expect_same(read(folder.put(name, xml_of(type, whole_extent, empty + halves))), expected);
    test::expect_same(read(folder.put(name, xml_of(type, whole_extent, halves + empty))), expected);
    const auto refuse = [&, name = name](const std::string& content, const std::string& naming) {
      const std::string message = error_of([&] { read(folder.put(name, content)); });
      EXPECT_NE(message.find(naming), std::string::npos) << message;
    };
    refuse(xml_of(type, whole_extent, empty), "its pieces don't cover its WholeExtent");
    refuse(xml_of(type, R"( WholeExtent="0 -1 0 -1 0 -1")", empty), "its WholeExtent is '0 -1 0 -1 0 -1'");
  }
}

}  // namespace
}  // namespace gale::io
