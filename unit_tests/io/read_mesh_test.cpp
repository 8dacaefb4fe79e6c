#include <cmath>

#include <gtest/gtest.h>

#include <gale/io/read.hpp>
#include <gale/io/synthetic.hpp>

#include "io/io_fixtures.hpp"

namespace gale::io {
namespace {

using test::error_of;
using test::names_of;
using test::tetrahedra_of;
using test::values_of;
using Notices = std::vector<std::string>;

class ReadMesh : public test::VtkTest {};

TEST(ReadGrid, IsMakeGrid) { test::expect_same(read("grid:3"), make_grid(3)); }

TEST(ReadGrid, RefusesOtherNumbers) {
  EXPECT_EQ(error_of([] { read("grid:"); }), "cannot make 'grid:': N must be a whole number");
  EXPECT_EQ(error_of([] { read("grid:3x"); }), "cannot make 'grid:3x': N must be a whole number");
  EXPECT_EQ(error_of([] { read("grid:99999999999"); }), "cannot make 'grid:99999999999': N must be a whole number");
  EXPECT_EQ(error_of([] { read("grid:1"); }), "grid:1 has no tetrahedra: N must be at least 2");
  EXPECT_EQ(error_of([] {
              read("grid:4", {0.5, false, ""});
            }),
            "cannot apply a threshold to 'grid:4': it is a mesh, not an image");
}

TEST(ReadFile, NeedsVtk) {
  if (detail::reads_files()) GTEST_SKIP() << "built with VTK";
  EXPECT_EQ(error_of([] { read("x.vtu"); }),
            "this gale was built without VTK: it reads grid:N, plane:N and the like alone, not 'x.vtu'");
}

/// Points 0 to 4, two tetrahedra and, between them, a triangle and a line.
const std::string mixed_vtk = R"(# vtk DataFile Version 3.0
by hand
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 double
0 0 0  1 0 0  0 1 0  0 0 1  1 1 1
CELLS 4 17
4 0 1 2 3
3 0 1 2
2 0 1
4 4 1 2 3
CELL_TYPES 4
10 5 3 10
)";

TEST_F(ReadMesh, LeavesOutCellsOfLowerDimension) {
  const Dataset mesh = read(folder.put("mixed.vtk", mixed_vtk));
  EXPECT_EQ(tetrahedra_of(mesh), (std::vector<int>{0, 1, 2, 3, 4, 1, 2, 3}));
  EXPECT_EQ(test::points_of(mesh), (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(mesh.points.index(), 1u);
  EXPECT_EQ(mesh.notices, Notices{"left out 2 cells of a dimension below 3"});
}

TEST_F(ReadMesh, PutsTheScalarsFirstAndNamesWhatItLeavesOut) {
  const Dataset mesh = read(folder.put("arrays.vtk", mixed_vtk + R"(CELL_DATA 4
SCALARS quality float 1
LOOKUP_TABLE default
1 2 3 4
SCALARS weight float 1
LOOKUP_TABLE default
1 2 3 4
POINT_DATA 5
VECTORS flow float
0 0 0  1 1 1  2 2 2  3 3 3  4 4 4
SCALARS height short 1
LOOKUP_TABLE default
5 4 3 2 1
SCALARS mark unsigned_char 1
LOOKUP_TABLE default
1 0 1 0 1
FIELD FieldData 3
flags 1 5 bit
1 0 1 0 1
words 1 5 string
a
b
c
d
e
pairs 2 5 double
0 0.5  1 1.5  2 2.5  3 3.5  4 4.5
)"));
  EXPECT_EQ(names_of(mesh.arrays), (std::vector<std::string>{"height", "flow", "mark", "pairs"}));
  EXPECT_EQ(values_of<std::int16_t>(mesh.arrays[0]), (std::vector<std::int16_t>{5, 4, 3, 2, 1}));
  EXPECT_EQ(mesh.arrays[1].components, 3);
  EXPECT_EQ(values_of<double>(mesh.arrays[3]), (std::vector<double>{0, .5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5}));
  EXPECT_EQ(mesh.notices, (Notices{"left out 2 cells of a dimension below 3",
                                   "left out the point array 'flags': its values are of type bit",
                                   "left out the point array 'words': its values are of type string",
                                   "left out the cell arrays 'quality', 'weight'"}));
}

/// A `.vtu` of the eight corners of a unit cube (in a hexahedron's order), with the given cells.
std::string vtu(int cells, const std::string& connectivity, const std::string& offsets, const std::string& types) {
  std::string quality;
  for (int c = 0; c < cells; ++c) quality += "1 ";
  const auto array = [](const std::string& attributes, const std::string& values) {
    return "<DataArray " + attributes + " format=\"ascii\">" + values + "</DataArray>\n";
  };
  return R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="8" NumberOfCells=")" +
         std::to_string(cells) + "\"><PointData>" +
         array(R"(type="Int64" Name="big")", "0 1 2 3 4 5 6 9007199254740993") + "</PointData><CellData>" +
         array(R"(type="Float32" Name="quality")", quality) + "</CellData><Points>" +
         array(R"(type="Float32" NumberOfComponents="3")", "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1") +
         "</Points><Cells>" + array(R"(type="Int32" Name="connectivity")", connectivity) +
         array(R"(type="Int32" Name="offsets")", offsets) + array(R"(type="UInt8" Name="types")", types) +
         "</Cells></Piece></UnstructuredGrid></VTKFile>";
}

TEST_F(ReadMesh, ReadsVtuInEitherCase) {
  const Dataset mesh = read(folder.put("TWO.VTU", vtu(2, "0 1 3 4  6 5 2 7", "4 8", "10 10")));
  EXPECT_EQ(tetrahedra_of(mesh), (std::vector<int>{0, 1, 3, 4, 6, 5, 2, 7}));
  EXPECT_EQ(mesh.points.index(), 0u);
  ASSERT_EQ(names_of(mesh.arrays), std::vector<std::string>{"big"});
  EXPECT_EQ(values_of<std::int64_t>(mesh.arrays[0])[7], 9007199254740993);
  EXPECT_EQ(mesh.notices, Notices{"left out the cell arrays 'quality'"});
}

TEST_F(ReadMesh, SplitsOtherCellsUnlessTold) {
  const std::string path = folder.put("hexahedron.vtu", vtu(2, "0 1 3 4  0 1 2 3 4 5 6 7", "4 12", "10 12"));
  ReadOptions tetrahedra;
  tetrahedra.simplices_alone = true;
  EXPECT_EQ(error_of([&] { read(path, tetrahedra); }),
            "cannot read '" + path + "': it has 1 hexahedra, and tetrahedra alone are wanted");
  const Dataset both = read(path);
  ASSERT_EQ(names_of(both.cell_arrays), std::vector<std::string>{"GlobalCellIds"});
  EXPECT_EQ(values_of<std::int32_t>(both.cell_arrays[0]), (std::vector<std::int32_t>{0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(both.notices, (Notices{"split 1 hexahedra into 6 tetrahedra", "left out the cell arrays 'quality'"}));

  const std::string hexahedron = folder.put("one.vtu", vtu(1, "0 1 2 3 4 5 6 7", "8", "12"));
  const Dataset mesh = read(hexahedron);
  EXPECT_EQ(mesh.tetrahedra.extent(0), 6u);
  double total = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.extent(0); ++t) total += std::abs(test::volume(mesh, t));
  EXPECT_DOUBLE_EQ(total, 1);
  EXPECT_EQ(test::point_count_of(mesh), 8u);
  EXPECT_EQ(values_of<std::int64_t>(mesh.arrays[0])[7], 9007199254740993);
}

TEST_F(ReadMesh, ReadsFacesInBothOfVtksWays) {
  const std::string start = vtu(1, "0 1 2 3 4 5 6 7", "8", "42");
  const auto with = [&](const std::string& arrays) {
    std::string text = start;
    return text.insert(text.find("</Cells>"), arrays);
  };
  const auto array = [](const std::string& name, const std::string& values) {
    return "<DataArray type=\"Int64\" Name=\"" + name + "\" format=\"ascii\">" + values + "</DataArray>\n";
  };
  const std::string streams = array("faces", "6 4 0 4 7 3 4 1 2 6 5 4 0 1 5 4 4 3 7 6 2 4 0 3 2 1 4 4 5 6 7");
  const Dataset expected = read(folder.put("old.vtu", with(streams + array("faceoffsets", "31"))));
  ASSERT_EQ(expected.tetrahedra.extent(0), 6u);
  const auto numbered = [&](const std::string& members, const std::string& ends) {
    return with(array("face_connectivity", "0 3 2 1 4 5 6 7 0 4 7 3 1 2 6 5 0 1 5 4 3 7 6 2") +
                array("face_offsets", "4 8 12 16 20 24") + array("polyhedron_to_faces", members) +
                array("polyhedron_offsets", ends));
  };
  const Dataset mesh = read(folder.put("new.vtu", numbered("2 3 4 5 0 1", "6")));
  EXPECT_EQ(tetrahedra_of(mesh), tetrahedra_of(expected));
  const auto refuse = [&](const std::string& text, const std::string& naming) {
    const std::string message = error_of([&] { read(folder.put("wrong.vtu", text)); });
    EXPECT_NE(message.find(naming), std::string::npos) << message;
  };
  refuse(start, "its Cells have no faces");
  refuse(with(streams + array("faceoffsets", "32")), "cell 0 ends at 32 of 31 faces' entries");
  refuse(with(streams + array("faceoffsets", "30")), "faces aren't what its 30 entries say");
  refuse(numbered("2 3 4 5 0 6", "6"), "cell 0 has face 6 of 6");
  refuse(numbered("2 3 4 5 0 -1", "6"), "cell 0 has face -1 of 6");
  refuse(numbered("2 3 4 5 0 1", "7"), "the faces of cell 0 end at 7 of 6");
  refuse(numbered("2 3 4 5 0 0", "6"), "whose faces don't close");
  refuse(numbered("0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0", "24"), "in more than two cells each");
}

TEST_F(ReadMesh, SplitsOtherDataSets) {
  const std::string path = folder.put("rectilinear.vtk", R"(# vtk DataFile Version 3.0
by hand
ASCII
DATASET RECTILINEAR_GRID
DIMENSIONS 3 2 2
X_COORDINATES 3 float
0 1 3
Y_COORDINATES 2 float
0 1
Z_COORDINATES 2 float
0 1
)");
  const Dataset mesh = read(path);
  double total = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.extent(0); ++t) total += std::abs(test::volume(mesh, t));
  EXPECT_DOUBLE_EQ(total, 3);
}

TEST_F(ReadMesh, RefusesMeshesOfNoCells) {
  const std::string line = folder.put("line.vtu", vtu(1, "0 1", "2", "3"));
  EXPECT_EQ(error_of([&] { read(line); }), "cannot read '" + line + "': it has no tetrahedra and no triangles");
  const std::string empty = folder.put("empty.vtu", vtu(0, "", "", ""));
  EXPECT_EQ(error_of([&] { read(empty); }), "cannot read '" + empty + "': it has no tetrahedra and no triangles");
}

TEST_F(ReadMesh, RefusesIdsThatNoPointHas) {
  for (const std::string id : {"8", "-1"}) {
    const std::string path = folder.put("wrong.vtu", vtu(2, "0 1 3 4  0 1 2 " + id, "4 8", "10 10"));
    EXPECT_EQ(error_of([&] { read(path); }), "cannot read '" + path + "': cell 1 names point " + id + " of 8");
  }
}

TEST_F(ReadMesh, RefusesAThreshold) {
  const std::string path = folder.put("mesh.vtu", vtu(1, "0 1 3 4", "4", "10"));
  EXPECT_EQ(error_of([&] {
              read(path, {0.5, false, ""});
            }),
            "cannot read '" + path + "': a threshold was given, but it is a mesh, not an image");
}

TEST_F(ReadMesh, RefusesWhatIsNoSuchFile) {
  const std::string none = folder / "none.vtu";
  EXPECT_EQ(error_of([&] { read(none); }), "cannot read '" + none + "': No such file or directory");
  const std::string directory = folder / "directory.vtu";
  std::filesystem::create_directory(directory);
  EXPECT_EQ(error_of([&] { read(directory); }), "cannot read '" + directory + "': it is a directory");
  for (const std::string name : {"mesh.msh", "mesh", ".vtu", "points.pvtp", ""}) {
    EXPECT_EQ(error_of([&] { read(name); }),
              "cannot read '" + name +
                  "': its extension is none of .vtu .pvtu .vtk .vtp .vts .vtr .vti .nii .nii.gz .mha .mhd "
                  ".nrrd .e .ex2 .exo .hdf .vtkhdf .stl .ply .obj .off .pvd .series, nor is it grid:N or plane:N; for "
                  "other meshes: "
                  "meshio convert '" +
                  name + "' mesh.vtu");
  }
}

/// `message` says which file is damaged, and something more.
void expect_damaged(const std::string& message, const std::string& path) {
  const std::string start = "cannot read '" + path + "': it is damaged, incomplete or of another format (";
  EXPECT_EQ(message.substr(0, start.size()), start);
  EXPECT_GT(message.size(), start.size() + 5) << message;
}

TEST_F(ReadMesh, RefusesDamagedFiles) {
  const std::string whole_vtu = vtu(1, "0 1 3 4", "4", "10"), unlike = "hello\n", binary("\0\xff\xfe\n\x01", 5);
  for (const std::string& content : {std::string(), unlike, binary, whole_vtu.substr(0, whole_vtu.size() / 2)}) {
    const std::string path = folder.put("damaged.vtu", content);
    expect_damaged(error_of([&] { read(path); }), path);
  }
  for (const std::string& content :
       {std::string(), unlike, binary, mixed_vtk.substr(0, 50), mixed_vtk.substr(0, 100)}) {
    const std::string path = folder.put("damaged.vtk", content);
    expect_damaged(error_of([&] { read(path); }), path);
  }
}

TEST_F(ReadMesh, ReadsAgainAfterAFailure) {
  const std::string bad = folder.put("bad.vtk", "hello"), good = folder.put("good.vtk", mixed_vtk);
  error_of([&] { read(bad); });
  EXPECT_EQ(read(good).tetrahedra.extent(0), 2u);
}

}  // namespace
}  // namespace gale::io
