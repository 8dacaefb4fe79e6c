#include "io/io_fixtures.hpp"

#ifdef GALE_ENABLE_VTK

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#ifdef GALE_TESTS_HAVE_VTK_PLY
#include <vtkPLYWriter.h>
#endif

#include <gale/io/read.hpp>

/// GALE reads surfaces that VTK writes, in each of its ways.
namespace gale::io {
namespace {

using Lists = std::vector<std::vector<vtkIdType>>;

vtkSmartPointer<vtkCellArray> cells_of(const Lists& lists) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& list : lists) cells->InsertNextCell(static_cast<vtkIdType>(list.size()), list.data());
  return cells;
}

/// A bent strip of 4000 quads and as many triangles between 8002 points, with a height at each.
constexpr vtkIdType length = 4000;

vtkSmartPointer<vtkPolyData> bent_strip() {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> heights;
  heights->SetName("height");
  for (vtkIdType i = 0; i < 2 * (length + 1); ++i) {
    points->InsertNextPoint(static_cast<double>(i / 2), static_cast<double>(i % 2), 0.125 * static_cast<double>(i % 7));
    heights->InsertNextValue(0.5F * static_cast<float>(i % 101));
  }
  Lists polygons;
  for (vtkIdType i = 0; i < 2 * length; i += 2) {
    polygons.push_back({i, i + 1, i + 3, i + 2});
    polygons.push_back({i + 2, i, i + 1});
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells_of(polygons));
  surface->GetPointData()->SetScalars(heights);
  return surface;
}

/// bent_strip(), with a point, two lines and a strip.
vtkSmartPointer<vtkPolyData> surface_of_all_kinds() {
  auto surface = bent_strip();
  surface->SetVerts(cells_of({{5}}));
  surface->SetLines(cells_of({{0, 1}, {1, 2, 3}}));
  surface->SetStrips(cells_of({{0, 1, 2, 3, 5}}));
  return surface;
}

void expect_bent_strip(const Dataset& mesh, bool has_heights, bool has_other_kinds) {
  std::vector<int> expected;
  std::vector<std::int32_t> cells;
  const int first = has_other_kinds ? 3 : 0;
  for (int i = 0; i < 2 * length; i += 2) {
    for (const int corner : {i, i + 1, i + 3, i, i + 3, i + 2, i + 2, i, i + 1}) expected.push_back(corner);
    for (const int cell : {i, i, i + 1}) cells.push_back(first + cell);
  }
  if (has_other_kinds) {
    for (const int corner : {0, 1, 2, 1, 3, 2, 2, 3, 5}) expected.push_back(corner);
    for (int k = 0; k < 3; ++k) cells.push_back(static_cast<std::int32_t>(first + 2 * length));
  }
  EXPECT_TRUE(test::triangles_of(mesh) == expected);
  ASSERT_EQ(mesh.cell_arrays.size(), 1u);
  EXPECT_TRUE(test::values_of<std::int32_t>(mesh.cell_arrays[0]) == cells);
  const std::vector<double> points = test::points_of(mesh);
  ASSERT_EQ(points.size(), 6u * (length + 1));
  for (std::size_t i = 0; i < points.size() / 3; ++i) {
    const double place[] = {static_cast<double>(i / 2), static_cast<double>(i % 2), 0.125 * static_cast<double>(i % 7)};
    for (int d = 0; d < 3; ++d) ASSERT_EQ(points[3 * i + d], place[d]);
  }
  ASSERT_EQ(test::names_of(mesh.arrays), has_heights ? std::vector<std::string>{"height"} : std::vector<std::string>());
  if (has_heights) EXPECT_EQ(test::values_of<float>(mesh.arrays[0])[150], 0.5F * 49);
}

class SurfacesOfVtk : public test::FileTest {};

TEST_F(SurfacesOfVtk, xml) {
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
    for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA}) {
      for (const bool is_big : {false, true}) {
        vtkNew<vtkXMLPolyDataWriter> writer;
        writer->SetFileName((folder / "a.vtp").c_str());
        writer->SetInputData(surface_of_all_kinds());
        writer->SetDataMode(mode);
        writer->SetCompressorType(compressor);
        writer->SetEncodeAppendedData(is_big);
        writer->SetHeaderType(is_big ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
        writer->SetByteOrder(is_big ? vtkXMLWriter::BigEndian : vtkXMLWriter::LittleEndian);
        writer->SetBlockSize(4096);
        ASSERT_EQ(writer->Write(), 1);
        expect_bent_strip(read(folder / "a.vtp"), true, true);
      }
    }
  }
}

TEST_F(SurfacesOfVtk, legacy) {
  for (const int type : {VTK_ASCII, VTK_BINARY}) {
    for (const int version :
         {vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2, vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1}) {
      vtkNew<vtkPolyDataWriter> writer;
      writer->SetFileName((folder / "a.vtk").c_str());
      writer->SetInputData(surface_of_all_kinds());
      writer->SetFileType(type);
      writer->SetFileVersion(version);
      ASSERT_EQ(writer->Write(), 1);
      expect_bent_strip(read(folder / "a.vtk"), true, true);
    }
  }
}

#ifdef GALE_TESTS_HAVE_VTK_PLY
TEST_F(SurfacesOfVtk, ply) {
  for (const int type : {VTK_ASCII, VTK_BINARY}) {
    for (const int order : {VTK_LITTLE_ENDIAN, VTK_BIG_ENDIAN}) {
      vtkNew<vtkPLYWriter> writer;
      writer->SetFileName((folder / "a.ply").c_str());
      writer->SetInputData(bent_strip());
      writer->SetFileType(type);
      writer->SetDataByteOrder(order);
      ASSERT_EQ(writer->Write(), 1);
      expect_bent_strip(read(folder / "a.ply"), false, false);
    }
  }
}
#endif

}  // namespace
}  // namespace gale::io

#endif
