#include <io/io_fixtures.hpp>

#include <gtest/gtest.h>

#include <gale/io/write.hpp>

#ifdef GALE_ENABLE_VTK
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>
#endif

namespace gale::io {
namespace {

using test::error_of;
using Names = std::set<std::string>;

class WriteSurface : public test::VtkTest {};

/// Five points; the lines 0-1-2 and 2-3, and the triangle 0, 1, 4.
Surface two_lines_and_a_triangle() {
  const Dataset::Points<double> points("GALE::points", 5);
  for (int i = 0; i < 5; ++i) points(i, 1) = 0.1 * i;
  Surface surface;
  surface.points = points;
  surface.point_arrays = {{"CellDimension", 1, std::vector<std::int8_t>{0, 1, 0, 3, 2}}};
  surface.lines = {{0, 3, 5}, {0, 1, 2, 2, 3}};
  surface.polygons = {{0, 3}, {0, 1, 4}};
  surface.cell_arrays = {{"SourceId", 1, std::vector<std::int32_t>{7, 8, 9}}};
  return surface;
}

#ifdef GALE_ENABLE_VTK
TEST_F(WriteSurface, ComesBackAsItWas) {
  write_surface(folder / "surface.vtp", two_lines_and_a_triangle());
  vtkNew<vtkXMLPolyDataReader> reader;
  const std::string path = folder / "surface.vtp";
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* const back = reader->GetOutput();
  ASSERT_EQ(back->GetNumberOfPoints(), 5);
  EXPECT_EQ(back->GetPoint(3)[1], 0.1 * 3);
  EXPECT_EQ(back->GetPointData()->GetArray("CellDimension")->GetTuple1(3), 3);
  const std::vector<std::vector<int>> cells = {{0, 1, 2}, {2, 3}, {0, 1, 4}};
  ASSERT_EQ(back->GetNumberOfCells(), 3);
  for (int i = 0; i < 3; ++i) {
    std::vector<int> points;
    for (int k = 0; k < back->GetCell(i)->GetNumberOfPoints(); ++k)
      points.push_back(static_cast<int>(back->GetCell(i)->GetPointId(k)));
    EXPECT_EQ(points, cells[i]);
    EXPECT_EQ(back->GetCellData()->GetArray("SourceId")->GetTuple1(i), 7 + i);
  }
  EXPECT_EQ(folder.names(), Names{"surface.vtp"});
}
#endif

TEST_F(WriteSurface, WritesNothingToo) {
  write_surface(folder / "surface.vtp",
                {Dataset::Points<float>("GALE::points", 0), {}, {}, {}, {{"SourceId", 1, std::vector<int>{}}}});
  EXPECT_EQ(folder.names(), Names{"surface.vtp"});
}

TEST_F(WriteSurface, RefusesWhatDoesNotFit) {
  const std::string path = folder / "surface.vtp", start = "cannot write '" + path + "': ";
  const auto error_with = [&](const auto& change) {
    Surface surface = two_lines_and_a_triangle();
    change(surface);
    return error_of([&] { write_surface(path, surface); });
  };
  EXPECT_EQ(error_with([](Surface& surface) { surface.polygons.points.back() = 5; }),
            start + "there is no point 5 among 5");
  EXPECT_EQ(error_with([](Surface& surface) { surface.lines.points[0] = -1; }), start + "there is no point -1 among 5");
  EXPECT_EQ(error_with([](Surface& surface) {
              surface.lines.begin = {0, 6, 5};
            }),
            start + "its cells don't begin one after the other");
  EXPECT_EQ(error_with([](Surface& surface) { surface.lines.begin.pop_back(); }),
            start + "its cells don't begin one after the other");
  EXPECT_EQ(error_with([](Surface& surface) { surface.cell_arrays[0].values = std::vector<std::int32_t>(2); }),
            start + "the array 'SourceId' has 2 values for 3 cells of 1 components");
  EXPECT_EQ(error_with([](Surface& surface) { surface.point_arrays[0].values = std::vector<std::int8_t>(4); }),
            start + "the array 'CellDimension' has 4 values for 5 points of 1 components");
  EXPECT_EQ(error_of([] { write_surface("surface.vtk", two_lines_and_a_triangle()); }),
            "cannot write a surface to 'surface.vtk': its extension is not .vtp");
  EXPECT_EQ(folder.names(), Names{});
}

TEST(WriteSurfaceFile, NeedsVtk) {
  if (detail::has_vtk()) GTEST_SKIP() << "built with VTK";
  EXPECT_EQ(error_of([] { write_surface("x.vtp", two_lines_and_a_triangle()); }),
            "this gale was built without VTK: it cannot write 'x.vtp'");
}

}  // namespace
}  // namespace gale::io
