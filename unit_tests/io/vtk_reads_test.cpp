#include "io/io_fixtures.hpp"

#ifdef GALE_ENABLE_VTK

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkTypeTraits.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLPPolyDataReader.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <gale/base/threads.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/read.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/io/write.hpp>

#include "io/small_surface.hpp"

/// VTK's own readers read what GALE writes.
namespace gale::io {
namespace {

using test::five_points;
using test::two_lines_and_a_triangle;

class VtkReads : public testing::Test {
 protected:
  template <class Reader>
  vtkSmartPointer<typename std::remove_pointer<decltype(Reader::New()->GetOutput())>::type> read_by(
      const std::string& name) const {
    vtkNew<Reader> reader;
    reader->SetFileName((folder / name).c_str());
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), 0u);
    return reader->GetOutput();
  }
  test::Folder folder;
};

/// Runs in each encoding.
class VtkReadsEncoded : public VtkReads, public testing::WithParamInterface<Encoding> {
 protected:
  /// Makes what `write(file)` writes appear under that name.
  template <class Write>
  void write_to(const std::string& name, const Write& write) const {
    AtomicFile file(folder / name, GetParam());
    write(file);
    file.commit();
    const std::string format = GetParam() == Encoding::base64 ? "binary" : "appended";
    EXPECT_NE(test::content_of(folder / name).find("format=\"" + format + '"'), std::string::npos);
  }
};

INSTANTIATE_TEST_SUITE_P(Tests, VtkReadsEncoded, testing::Values(Encoding::appended, Encoding::base64),
                         [](const auto& info) { return info.param == Encoding::base64 ? "base64" : "appended"; });

void expect_array(vtkDataArray* found, const PointArray& array) {
  ASSERT_NE(found, nullptr) << array.name;
  EXPECT_EQ(found->GetNumberOfComponents(), array.components) << array.name;
  std::visit(
      [&](const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        EXPECT_EQ(found->GetElementComponentSize(), static_cast<int>(sizeof(T))) << array.name;
        EXPECT_EQ(found->GetDataTypeMin(), static_cast<double>(vtkTypeTraits<T>::Min())) << array.name;
        ASSERT_EQ(found->GetNumberOfValues(), static_cast<vtkIdType>(values.size())) << array.name;
        const T* const read = static_cast<const T*>(found->GetVoidPointer(0));
        EXPECT_TRUE(std::equal(values.begin(), values.end(), read)) << array.name;
      },
      array.values);
}

void expect_points(vtkPointSet* found, const Dataset::Positions& points) {
  std::visit(
      [&](const auto& xyz) {
        ASSERT_EQ(found->GetNumberOfPoints(), static_cast<vtkIdType>(xyz.extent(0)));
        for (std::size_t i = 0; i < xyz.extent(0); ++i) {
          for (int d = 0; d < 3; ++d) ASSERT_EQ(found->GetPoint(static_cast<vtkIdType>(i))[d], xyz(i, d)) << i;
        }
      },
      points);
}

void expect_cell(vtkDataSet* found, vtkIdType cell, int type, const std::vector<int>& points) {
  ASSERT_EQ(found->GetCellType(cell), type) << cell;
  std::vector<int> read;
  for (int k = 0; k < found->GetCell(cell)->GetNumberOfPoints(); ++k)
    read.push_back(static_cast<int>(found->GetCell(cell)->GetPointId(k)));
  ASSERT_EQ(read, points) << cell;
}

/// Large enough for several blocks of each array.
Dataset large_mesh() {
  Dataset mesh = make_grid(34);
  mesh.arrays = test::arrays_of_every_type(test::point_count_of(mesh));
  const std::vector<std::uint8_t> ones(test::point_count_of(mesh), 1);
  for (const char* name : {"two words", "<a> & \"b\" 'c' 100%", "\xc3\xa9\xe2\x82\xac"}) {
    mesh.arrays.push_back({name, 1, ones});
  }
  return mesh;
}

void expect_mesh(vtkUnstructuredGrid* found, const Dataset& mesh) {
  expect_points(found, mesh.points);
  ASSERT_EQ(found->GetNumberOfCells(), static_cast<vtkIdType>(mesh.tetrahedra.extent(0)));
  for (std::size_t t = 0; t < mesh.tetrahedra.extent(0); t += 97) {
    const auto corner = [&](int k) { return mesh.tetrahedra(t, k); };
    expect_cell(found, static_cast<vtkIdType>(t), VTK_TETRA, {corner(0), corner(1), corner(2), corner(3)});
  }
  ASSERT_EQ(found->GetPointData()->GetNumberOfArrays(), static_cast<int>(mesh.arrays.size()));
  for (const PointArray& array : mesh.arrays) expect_array(found->GetPointData()->GetArray(array.name.c_str()), array);
}

TEST_P(VtkReadsEncoded, meshes_whatever_the_threads) {
  const Dataset mesh = large_mesh();
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    write_to("mesh.vtu", [&](const AtomicFile& file) { write_mesh(file, mesh); });
    expect_mesh(read_by<vtkXMLUnstructuredGridReader>("mesh.vtu"), mesh);
    test::expect_same(read(folder / "mesh.vtu"), mesh);
  }
}

TEST_F(VtkReads, legacy_meshes) {
  Dataset mesh = large_mesh();
  mesh.arrays.push_back({std::string(252, 'x') + ' ', 1, mesh.arrays.back().values});  // as long as it may be
  write_mesh(folder / "mesh.vtk", mesh);
  expect_mesh(read_by<vtkUnstructuredGridReader>("mesh.vtk"), mesh);
}

/// Meshes of triangles: `found` has these as its cells.
void expect_triangles(vtkPointSet* found, const Dataset& mesh) {
  expect_points(found, mesh.points);
  ASSERT_EQ(found->GetNumberOfCells(), static_cast<vtkIdType>(mesh.triangles.extent(0)));
  for (std::size_t t = 0; t < mesh.triangles.extent(0); t += 97) {
    const auto corner = [&](int k) { return mesh.triangles(t, k); };
    expect_cell(found, static_cast<vtkIdType>(t), VTK_TRIANGLE, {corner(0), corner(1), corner(2)});
  }
  expect_array(found->GetPointData()->GetArray("field"), mesh.arrays[0]);
  expect_array(found->GetCellData()->GetArray(global_cell_ids), mesh.cell_arrays[0]);
}

Dataset plane_with_cells() {
  Dataset mesh = make_plane(120);
  std::vector<std::int32_t> cells(mesh.triangles.extent(0));
  for (std::size_t t = 0; t < cells.size(); ++t) cells[t] = static_cast<std::int32_t>(t / 2);
  mesh.cell_arrays = {{global_cell_ids, 1, std::move(cells)}};
  return mesh;
}

TEST_P(VtkReadsEncoded, meshes_of_triangles) {
  const Dataset mesh = plane_with_cells();
  for (const char* name : {"mesh.vtu", "mesh.vtp"}) {
    write_to(name, [&](const AtomicFile& file) { write_mesh(file, mesh); });
    test::expect_same(read(folder / name), mesh);
  }
  expect_triangles(read_by<vtkXMLUnstructuredGridReader>("mesh.vtu"), mesh);
  expect_triangles(read_by<vtkXMLPolyDataReader>("mesh.vtp"), mesh);
}

TEST_F(VtkReads, legacy_meshes_of_triangles) {
  const Dataset mesh = plane_with_cells();
  write_mesh(folder / "mesh.vtk", mesh);
  expect_triangles(read_by<vtkUnstructuredGridReader>("mesh.vtk"), mesh);
  test::expect_same(read(folder / "mesh.vtk"), mesh);
}

TEST_F(VtkReads, pieces_of_triangles) {
  const Dataset piece = plane_with_cells();
  AtomicFiles files;
  write_piece(files.add(folder / "all_0.vtu"), piece);
  write_pieces(files.add(folder / "all.pvtu"), {"all_0.vtu"}, piece);
  files.commit();
  const auto found = read_by<vtkXMLPUnstructuredGridReader>("all.pvtu");
  ASSERT_EQ(found->GetNumberOfCells(), static_cast<vtkIdType>(piece.triangles.extent(0)));
  expect_cell(found, 0, VTK_TRIANGLE, {0, 1, 121});
  const Dataset mesh = read(folder / "all.pvtu");
  EXPECT_EQ(test::triangles_of(mesh), test::triangles_of(piece));
}

TEST_P(VtkReadsEncoded, empty_meshes) {
  Dataset mesh = make_grid(2);
  mesh.tetrahedra = {};
  write_to("mesh.vtu", [&](const AtomicFile& file) { write_mesh(file, mesh); });
  EXPECT_EQ(read_by<vtkXMLUnstructuredGridReader>("mesh.vtu")->GetNumberOfCells(), 0);
  EXPECT_EQ(read_by<vtkXMLUnstructuredGridReader>("mesh.vtu")->GetNumberOfPoints(), 8);
}

TEST_P(VtkReadsEncoded, points) {
  const PointArray types{"CriticalType", 1, std::vector<std::int8_t>{0, 1, 0, 3, 2}};
  write_to("points.vtp", [&](const AtomicFile& file) { write_points(file, {five_points(), {types}}); });
  const auto found = read_by<vtkXMLPolyDataReader>("points.vtp");
  expect_points(found, five_points());
  expect_array(found->GetPointData()->GetArray("CriticalType"), types);
  ASSERT_EQ(found->GetNumberOfVerts(), 5);
  for (int i = 0; i < 5; ++i) expect_cell(found, i, VTK_VERTEX, {i});
}

TEST_P(VtkReadsEncoded, surfaces) {
  const Surface surface = two_lines_and_a_triangle();
  write_to("surface.vtp", [&](const AtomicFile& file) { write_surface(file, surface); });
  const auto found = read_by<vtkXMLPolyDataReader>("surface.vtp");
  expect_points(found, surface.points);
  expect_array(found->GetPointData()->GetArray("CellDimension"), surface.point_arrays[0]);
  expect_array(found->GetCellData()->GetArray("SourceId"), surface.cell_arrays[0]);
  ASSERT_EQ(found->GetNumberOfCells(), 3);
  expect_cell(found, 0, VTK_POLY_LINE, {0, 1, 2});
  expect_cell(found, 1, VTK_LINE, {2, 3});
  expect_cell(found, 2, VTK_TRIANGLE, {0, 1, 4});
}

TEST_P(VtkReadsEncoded, lines_of_a_grid) {
  Surface lines = two_lines_and_a_triangle();
  lines.cell_arrays = {{"PairId", 1, std::vector<std::int64_t>{-1, 5}}};
  write_to("lines.vtu", [&](const AtomicFile& file) { write_lines(file, lines); });
  const auto found = read_by<vtkXMLUnstructuredGridReader>("lines.vtu");
  expect_points(found, lines.points);
  expect_array(found->GetCellData()->GetArray("PairId"), lines.cell_arrays[0]);
  ASSERT_EQ(found->GetNumberOfCells(), 2);
  expect_cell(found, 0, VTK_POLY_LINE, {0, 1, 2});
  expect_cell(found, 1, VTK_LINE, {2, 3});
}

/// A tetrahedron a piece, with two vertices in common, and an empty piece between them.
TEST_F(VtkReads, meshes_in_pieces) {
  std::vector<Dataset> pieces(3);
  for (const int k : {0, 2}) {
    Dataset& mesh = pieces[k];
    const Dataset::Points<double> points("points", 4);
    for (int i = 0; i < 4; ++i) points(i, i % 3) = k + i;
    mesh.points = points;
    mesh.tetrahedra = decltype(mesh.tetrahedra)("tetrahedra", 1);
    for (int corner = 0; corner < 4; ++corner) mesh.tetrahedra(0, corner) = 3 - corner;
  }
  pieces[1].points = Dataset::Points<double>("points", 0);
  const std::int64_t far = std::int64_t(1) << 40;
  const std::vector<std::vector<std::int64_t>> ids = {{0, 1, 2, far}, {}, {2, far, far + 1, far + 2}};
  AtomicFiles files;
  for (int k = 0; k < 3; ++k) {
    const std::vector<std::uint8_t> ghosts =
        k == 2 ? std::vector<std::uint8_t>{1, 1, 0, 0} : std::vector<std::uint8_t>(ids[k].size());
    pieces[k].arrays = {{"vtkGhostType", 1, ghosts}, {global_point_ids, 1, ids[k]}};
    pieces[k].cell_arrays = {{global_cell_ids, 1, std::vector<std::int64_t>(k == 1 ? 0 : 1, far + k)}};
    write_piece(files.add(folder / ("all_" + std::to_string(k) + ".vtu")), pieces[k]);
  }
  write_pieces(files.add(folder / "all.pvtu"), {"all_0.vtu", "all_1.vtu", "all_2.vtu"}, pieces[0]);
  files.commit();
  const auto found = read_by<vtkXMLPUnstructuredGridReader>("all.pvtu");
  ASSERT_EQ(found->GetNumberOfPoints(), 8);
  ASSERT_EQ(found->GetNumberOfCells(), 2);
  expect_cell(found, 0, VTK_TETRA, {3, 2, 1, 0});
  expect_cell(found, 1, VTK_TETRA, {7, 6, 5, 4});
  vtkDataArray* const points = found->GetPointData()->GetGlobalIds();
  ASSERT_NE(points, nullptr);
  expect_array(points, {global_point_ids, 1, std::vector<std::int64_t>{0, 1, 2, far, 2, far, far + 1, far + 2}});
  expect_array(found->GetPointGhostArray(), {"vtkGhostType", 1, std::vector<std::uint8_t>{0, 0, 0, 0, 1, 1, 0, 0}});
  ASSERT_NE(found->GetCellData()->GetGlobalIds(), nullptr);
  expect_array(found->GetCellData()->GetGlobalIds(), {global_cell_ids, 1, std::vector<std::int64_t>{far, far + 2}});
}

TEST_F(VtkReads, surfaces_in_pieces) {
  const Surface surface = two_lines_and_a_triangle();
  AtomicFiles files;
  for (const char* name : {"all_0.vtp", "all_1.vtp"}) write_surface(files.add(folder / name), surface);
  write_pieces(files.add(folder / "all.pvtp"), {"all_0.vtp", "all_1.vtp"}, surface);
  files.commit();
  const auto found = read_by<vtkXMLPPolyDataReader>("all.pvtp");
  ASSERT_EQ(found->GetNumberOfPoints(), 10);
  ASSERT_EQ(found->GetNumberOfCells(), 6);
  EXPECT_NE(found->GetPointData()->GetArray("CellDimension"), nullptr);
  EXPECT_EQ(found->GetCellData()->GetArray("SourceId")->GetNumberOfTuples(), 6);
}

/// Characters that XML can't have are replaced: the file is read all the same.
TEST_F(VtkReads, names_of_any_bytes) {
  Dataset mesh = make_grid(2);
  mesh.arrays.clear();
  const std::vector<float> values(8, 7);
  for (const char* name : {"latin \xe9", "m\xb2\xb7s", "\x82\xa0", "\x01", "tab\tand\nline", "\xed\xa0\x80", ""})
    mesh.arrays.push_back({name, 1, values});
  write_mesh(folder / "mesh.vtu", mesh);
  EXPECT_EQ(read_by<vtkXMLUnstructuredGridReader>("mesh.vtu")->GetNumberOfCells(), 6);
  EXPECT_EQ(test::names_of(read(folder / "mesh.vtu").arrays)[0], "latin \xc3\xa9");
  write_mesh(folder / "mesh.vtk", mesh);
  EXPECT_EQ(read_by<vtkUnstructuredGridReader>("mesh.vtk")->GetNumberOfCells(), 6);
  EXPECT_EQ(test::names_of(read(folder / "mesh.vtk").arrays)[4], "tab\tand\nline");
}

}  // namespace
}  // namespace gale::io

#endif
