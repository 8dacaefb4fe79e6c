#include <gtest/gtest.h>

#include <gale/io/write.hpp>

#include "io/io_fixtures.hpp"
#include "io/small_surface.hpp"

namespace gale::io {
namespace {

using test::error_of;
using test::two_lines_and_a_triangle;
using Names = std::set<std::string>;

class WriteSurface : public test::FileTest {};

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
            "cannot write a surface to 'surface.vtk': its extension is neither .vtp nor .hdf nor .vtkhdf");
  EXPECT_EQ(folder.names(), Names{});
}

}  // namespace
}  // namespace gale::io
