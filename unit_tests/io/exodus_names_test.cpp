#include <array>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "io/io_fixtures.hpp"

#ifdef GALE_ENABLE_VTK

#include <vtkNew.h>
#include <vtkQuadraticHexahedron.h>
#include <vtkQuadraticWedge.h>
#include <vtkTriQuadraticHexahedron.h>

#include <gale/io/formats/exodus.hpp>

namespace gale::io::detail {
namespace {

using Place = std::array<double, 3>;

Place middle_of(const std::vector<Place>& places) {
  Place middle{};
  for (const Place& place : places) {
    for (int d = 0; d < 3; ++d) middle[d] += place[d] / static_cast<double>(places.size());
  }
  return middle;
}

/// An element's points as Exodus' manual numbers them from 1 on: corners, and the middles of corners.
std::vector<Place> places_of(std::vector<Place> corners, const std::vector<std::vector<int>>& middles) {
  std::vector<Place> places = corners;
  for (const auto& ends : middles) {
    std::vector<Place> some;
    for (const int end : ends) some.push_back(corners[static_cast<std::size_t>(end - 1)]);
    places.push_back(middle_of(some));
  }
  return places;
}

/// The cell's points are where VTK has them.
template <class Cell>
void expect_places(const char* name, const std::vector<Place>& places) {
  const ElementType element = find_element_type(name, places.size(), "connect1");
  const vtkNew<Cell> cell;
  EXPECT_EQ(element.cell_type, cell->GetCellType());
  ASSERT_EQ(element.points, static_cast<std::size_t>(cell->GetNumberOfPoints()));
  ASSERT_EQ(element.order.size(), element.points);
  const double* at = cell->GetParametricCoords();
  for (std::size_t k = 0; k < element.points; ++k) {
    for (int d = 0; d < 3; ++d) EXPECT_DOUBLE_EQ(places[element.order[k]][d], *at++) << name << ", point " << k;
  }
}

const std::vector<Place> cube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<Place> prism = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
const std::vector<std::vector<int>> edges_of_cube = {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {1, 5}, {2, 6},
                                                     {3, 7}, {4, 8}, {5, 6}, {6, 7}, {7, 8}, {8, 5}};

TEST(ExodusElements, HavePointsWhereVtkHasThem) {
  expect_places<vtkQuadraticHexahedron>("HEX20", places_of(cube, edges_of_cube));
  expect_places<vtkQuadraticWedge>(
      "wedge", places_of(prism, {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 5}, {3, 6}, {4, 5}, {5, 6}, {6, 4}}));
  auto all = edges_of_cube;
  // The middle, bottom and top, left and right, front and back.
  for (const std::vector<int> corners : {std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8},
                                         {1, 2, 3, 4},
                                         {5, 6, 7, 8},
                                         {1, 4, 5, 8},
                                         {2, 3, 6, 7},
                                         {1, 2, 5, 6},
                                         {3, 4, 7, 8}})
    all.push_back(corners);
  expect_places<vtkTriQuadraticHexahedron>("HEX27", places_of(cube, all));
}

TEST(ExodusElements, AreKnownByTheBeginningOfTheirNamesAndByTheirPoints) {
  const auto type = [](const char* name, int points) {
    return find_element_type(name, static_cast<std::uint64_t>(points), "connect1").cell_type;
  };
  EXPECT_EQ(type("TETRA", 4), 10);
  EXPECT_EQ(type("tetra4", 4), 10);
  EXPECT_EQ(type("TETRA10", 10), 24);
  EXPECT_EQ(type("HEX", 8), 12);
  EXPECT_EQ(type("PYRAMID5", 5), 14);
  EXPECT_EQ(type("WEDGE", 6), 13);
  EXPECT_EQ(type("SHELL", 4), 9);
  EXPECT_EQ(type("SHELL3", 3), 5);
  for (const auto& [name, points] :
       {std::pair("TETRA", 3), {"HEX", 4}, {"", 4}, {"TE", 4}, {"NFACED", 4}, {"TETRA", 0}}) {
    EXPECT_NE(test::error_of([&] { type(name, points); }).find("connect1"), std::string::npos) << name << points;
  }
}

}  // namespace
}  // namespace gale::io::detail

#endif
