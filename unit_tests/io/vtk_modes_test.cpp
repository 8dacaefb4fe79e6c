#include "io/io_fixtures.hpp"

#ifdef GALE_ENABLE_VTK

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearGridWriter.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridWriter.h>
#include <vtkStructuredPointsWriter.h>
#include <vtkTypeTraits.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <gale/io/read.hpp>
#include <gale/io/synthetic.hpp>

/// GALE reads what VTK writes, in each of its ways.
namespace gale::io {
namespace {

constexpr int side = 12;  // 1728 points: some blocks of a compressed array

Dataset expected_mesh() {
  Dataset mesh = make_grid(side);
  mesh.arrays = test::arrays_of_every_type(test::point_count_of(mesh));
  return mesh;
}

void add_arrays(const std::vector<PointArray>& arrays, vtkPointData* to) {
  for (const PointArray& array : arrays) {
    const auto add = [&](const auto& values) {
      using T = typename std::decay_t<decltype(values)>::value_type;
      const auto copy =
          vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeTraits<T>::VTK_TYPE_ID));
      copy->SetNumberOfComponents(array.components);
      copy->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / array.components);
      std::copy(values.begin(), values.end(), static_cast<T*>(copy->GetVoidPointer(0)));
      copy->SetName(array.name.c_str());
      to->AddArray(copy);
    };
    std::visit(add, array.values);
  }
}

vtkSmartPointer<vtkUnstructuredGrid> to_vtk(const Dataset& mesh) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  const std::vector<double> xyz = test::points_of(mesh);
  for (std::size_t i = 0; i < xyz.size(); i += 3) points->InsertNextPoint(&xyz[i]);
  grid->SetPoints(points);
  const std::vector<int> ids = test::tetrahedra_of(mesh);
  for (std::size_t t = 0; t < ids.size(); t += 4) {
    const vtkIdType corners[] = {ids[t], ids[t + 1], ids[t + 2], ids[t + 3]};
    grid->InsertNextCell(VTK_TETRA, 4, corners);
  }
  add_arrays(mesh.arrays, grid->GetPointData());
  return grid;
}

vtkSmartPointer<vtkImageData> to_vtk_image(const Dataset& mesh) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(side, side, side);
  add_arrays(mesh.arrays, image->GetPointData());
  return image;
}

struct XmlWay {
  const char* name;
  int data_mode;
  int compressor;
  bool encoded, wide, big_endian;
};

std::ostream& operator<<(std::ostream& out, const XmlWay& way) { return out << way.name; }

constexpr int ascii = vtkXMLWriter::Ascii, binary = vtkXMLWriter::Binary, appended = vtkXMLWriter::Appended;
constexpr int none = vtkXMLWriter::NONE, zlib = vtkXMLWriter::ZLIB, lz4 = vtkXMLWriter::LZ4, lzma = vtkXMLWriter::LZMA;

const XmlWay xml_ways[] = {{"ascii", ascii, none, false, false, false},
                           {"binary", binary, none, false, false, false},
                           {"binary_wide", binary, none, false, true, false},
                           {"binary_zlib", binary, zlib, false, false, false},
                           {"binary_lzma_wide", binary, lzma, false, true, false},
                           {"raw", appended, none, false, false, false},
                           {"raw_big_endian", appended, none, false, false, true},
                           {"raw_zlib", appended, zlib, false, false, false},
                           {"raw_zlib_wide_big_endian", appended, zlib, false, true, true},
                           {"raw_lz4", appended, lz4, false, true, false},
                           {"raw_lzma", appended, lzma, false, false, false},
                           {"encoded", appended, none, true, false, false},
                           {"encoded_zlib", appended, zlib, true, true, false},
                           {"encoded_lz4", appended, lz4, true, false, false}};

class XmlWays : public testing::TestWithParam<XmlWay> {
 protected:
  template <class Writer>
  void write(const std::string& path, vtkDataObject* data) const {
    const XmlWay& way = GetParam();
    vtkNew<Writer> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(data);
    writer->SetDataMode(way.data_mode);
    writer->SetCompressorType(way.compressor);
    writer->SetEncodeAppendedData(way.encoded);
    writer->SetHeaderType(way.wide ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
    writer->SetByteOrder(way.big_endian ? vtkXMLWriter::BigEndian : vtkXMLWriter::LittleEndian);
    writer->SetBlockSize(4096);
    ASSERT_EQ(writer->Write(), 1);
  }
  test::Folder folder;
};

TEST_P(XmlWays, of_meshes_are_read) {
  const Dataset mesh = expected_mesh();
  write<vtkXMLUnstructuredGridWriter>(folder / "a.vtu", to_vtk(mesh));
  test::expect_same(read(folder / "a.vtu"), mesh);
}

TEST_P(XmlWays, of_images_are_read) {
  const Dataset mesh = expected_mesh();
  write<vtkXMLImageDataWriter>(folder / "a.vti", to_vtk_image(mesh));
  ReadOptions by_double;
  by_double.array = "double";
  const Dataset image = read(folder / "a.vti", by_double);
  EXPECT_EQ(test::tetrahedra_of(image), test::tetrahedra_of(mesh));
  EXPECT_EQ(image.arrays.size(), mesh.arrays.size());
  for (const PointArray& array : mesh.arrays) {
    const auto found = std::find_if(image.arrays.begin(), image.arrays.end(),
                                    [&](const PointArray& a) { return a.name == array.name; });
    ASSERT_NE(found, image.arrays.end()) << array.name;
    EXPECT_TRUE(found->values == array.values) << array.name;
  }
}

/// A file that ends early anywhere is refused, or whole in all that is read of it.
TEST_P(XmlWays, are_refused_where_they_are_cut) {
  const Dataset mesh = expected_mesh();
  write<vtkXMLUnstructuredGridWriter>(folder / "a.vtu", to_vtk(mesh));
  const std::string whole = test::content_of(folder / "a.vtu");
  for (std::size_t part = 1; part < 40; ++part) {
    const std::string path = folder.put("cut.vtu", whole.substr(0, whole.size() * part / 40));
    EXPECT_NE(test::error_of([&] { read(path); }), "no error") << part;
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, XmlWays, testing::ValuesIn(xml_ways),
                         [](const auto& info) { return std::string(info.param.name); });

class LegacyWays : public testing::TestWithParam<std::tuple<bool, int>> {
 protected:
  template <class Writer>
  void write(const std::string& path, vtkDataObject* data) const {
    vtkNew<Writer> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(data);
    std::get<0>(GetParam()) ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
    writer->SetFileVersion(std::get<1>(GetParam()));
    ASSERT_EQ(writer->Write(), 1);
  }
  test::Folder folder;
};

TEST_P(LegacyWays, of_meshes_are_read) {
  Dataset mesh = expected_mesh();
  for (PointArray& array : mesh.arrays) {  // VTK rounds the greatest numbers where it writes text
    if (auto* const floats = std::get_if<std::vector<float>>(&array.values)) (*floats)[0] = (*floats)[1] = 0.5f;
    if (auto* const doubles = std::get_if<std::vector<double>>(&array.values)) (*doubles)[0] = (*doubles)[1] = 0.5;
  }
  write<vtkUnstructuredGridWriter>(folder / "a.vtk", to_vtk(mesh));
  test::expect_same(read(folder / "a.vtk"), mesh);
}

TEST_P(LegacyWays, of_images_are_read) {
  const Dataset mesh = expected_mesh();
  write<vtkStructuredPointsWriter>(folder / "a.vtk", to_vtk_image(mesh));
  const Dataset image = read(folder / "a.vtk");
  EXPECT_EQ(test::tetrahedra_of(image), test::tetrahedra_of(mesh));
  EXPECT_EQ(image.arrays.size(), mesh.arrays.size());
}

INSTANTIATE_TEST_SUITE_P(Tests, LegacyWays,
                         testing::Combine(testing::Bool(),
                                          testing::Values(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2,
                                                          vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1)));

/// Every type of cell that VTK splits, as VTK's own cells have them: as many points as GALE's table says.
/// Grids of the same points, as VTK writes them.
class GridsOfVtk : public testing::Test {
 protected:
  static constexpr int n = 4;

  void SetUp() override {
    axis_->SetNumberOfTuples(n);
    for (int k = 0; k < n; ++k) axis_->SetValue(k, static_cast<float>(k * k));
    for (int k = 0; k < n * n * n; ++k) points_->InsertNextPoint(at(k % n), at(k / n % n), at(k / n / n));
    values_->SetName("values");
    for (int k = 0; k < n * n * n; ++k) values_->InsertNextValue(k % 5);
  }

  static double at(int k) { return k * k; }

  void add_points(vtkPointSet* grid) {
    grid->SetPoints(points_);
    grid->GetPointData()->SetScalars(values_);
  }

  template <class Writer>
  Dataset read_from(vtkDataObject* grid, const char* name) {
    vtkNew<Writer> writer;
    writer->SetFileName((folder_ / name).c_str());
    writer->SetInputData(grid);
    EXPECT_EQ(writer->Write(), 1);
    return read(folder_ / name);
  }

  /// Expects the tetrahedra that hexahedra of these points are split into.
  void expect_hexahedra(const Dataset& mesh, const std::string& notice) {
    ASSERT_EQ(mesh.notices, std::vector<std::string>{notice});
    ASSERT_EQ(mesh.tetrahedra.extent(0), 6u * 27);
    const auto& cells = test::values_of<std::int32_t>(mesh.cell_arrays.at(0));
    double total = 0;
    std::set<std::array<int, 4>> all;
    for (std::size_t t = 0; t < mesh.tetrahedra.extent(0); ++t) {
      EXPECT_EQ(cells[t], static_cast<int>(t / 6));
      total += std::abs(test::volume(mesh, t));
      std::array<int, 4> corners = {mesh.tetrahedra(t, 0), mesh.tetrahedra(t, 1), mesh.tetrahedra(t, 2),
                                    mesh.tetrahedra(t, 3)};
      std::sort(corners.begin(), corners.end());
      all.insert(corners);
    }
    EXPECT_DOUBLE_EQ(total, 9 * 9 * 9);
    if (tetrahedra_.empty()) tetrahedra_ = all;
    EXPECT_EQ(all, tetrahedra_);
    EXPECT_EQ(test::names_of(mesh.arrays), std::vector<std::string>{"values"});
  }

  test::Folder folder_;
  vtkNew<vtkFloatArray> axis_, values_;
  vtkNew<vtkPoints> points_;
  std::set<std::array<int, 4>> tetrahedra_;
};

TEST_F(GridsOfVtk, of_polyhedra_and_of_points_along_axes) {
  vtkNew<vtkUnstructuredGrid> mixed;
  add_points(mixed);
  for (int cell = 0; cell < 27; ++cell) {
    const int first = (cell / 9 * n + cell / 3 % 3) * n + cell % 3;
    const vtkIdType v[] = {first,         first + 1,         first + n + 1,         first + n,
                           first + n * n, first + n * n + 1, first + n * n + n + 1, first + n * n + n};
    if (cell % 3 != 0) {
      mixed->InsertNextCell(VTK_HEXAHEDRON, 8, v);
      continue;
    }
    const vtkIdType faces[] = {4, v[0], v[1], v[2], v[3], 4, v[4], v[5], v[6], v[7], 4, v[0], v[1], v[5], v[4],
                               4, v[1], v[2], v[6], v[5], 4, v[2], v[3], v[7], v[6], 4, v[3], v[0], v[4], v[7]};
    mixed->InsertNextCell(VTK_POLYHEDRON, 8, v, 6, faces);
  }
  const std::string both = "split 18 hexahedra and 9 polyhedra into 162 tetrahedra";
  expect_hexahedra(read_from<vtkXMLUnstructuredGridWriter>(mixed, "a.vtu"), both);
  expect_hexahedra(read_from<vtkUnstructuredGridWriter>(mixed, "a.vtk"), both);

  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(n, n, n);
  add_points(structured);
  const std::string hexahedra = "split 27 hexahedra into 162 tetrahedra";
  expect_hexahedra(read_from<vtkXMLStructuredGridWriter>(structured, "a.vts"), hexahedra);
  expect_hexahedra(read_from<vtkStructuredGridWriter>(structured, "b.vtk"), hexahedra);

  vtkNew<vtkRectilinearGrid> rectilinear;
  rectilinear->SetDimensions(n, n, n);
  rectilinear->SetXCoordinates(axis_);
  rectilinear->SetYCoordinates(axis_);
  rectilinear->SetZCoordinates(axis_);
  rectilinear->GetPointData()->SetScalars(values_);
  const std::string voxels = "split 27 voxels into 162 tetrahedra";
  expect_hexahedra(read_from<vtkXMLRectilinearGridWriter>(rectilinear, "a.vtr"), voxels);
  expect_hexahedra(read_from<vtkRectilinearGridWriter>(rectilinear, "c.vtk"), voxels);
}

TEST(CellTypes, of_fixed_size_are_split_into_the_volume_that_they_have) {
  test::Folder folder;
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (int k = 0; k < 8; ++k) points->InsertNextPoint(k & 1, k >> 1 & 1, k >> 2);
  points->InsertNextPoint(0.5, 0.5, 2);
  grid->SetPoints(points);
  const vtkIdType hexahedron[] = {0, 1, 3, 2, 4, 5, 7, 6}, pyramid[] = {4, 5, 7, 6, 8};
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, hexahedron);
  grid->InsertNextCell(VTK_PYRAMID, 5, pyramid);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName((folder / "a.vtu").c_str());
  writer->SetInputData(grid);
  ASSERT_EQ(writer->Write(), 1);
  const Dataset mesh = read(folder / "a.vtu");
  double total = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.extent(0); ++t) total += std::abs(test::volume(mesh, t));
  EXPECT_DOUBLE_EQ(total, 1 + 1.0 / 3);
}

}  // namespace
}  // namespace gale::io

#endif
