#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include <gale/io/synthetic.hpp>

#include "io/io_fixtures.hpp"

namespace gale::io {
namespace {

using test::error_of;
using test::points_of;
using test::tetrahedra_of;

TEST(MakeGrid, TwoCubedIsOneCube) {
  const Dataset mesh = make_grid(2);
  EXPECT_EQ(points_of(mesh),
            (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1}));
  EXPECT_EQ(tetrahedra_of(mesh),
            (std::vector<int>{0, 1, 3, 7, 0, 1, 5, 7, 0, 2, 3, 7, 0, 2, 6, 7, 0, 4, 5, 7, 0, 4, 6, 7}));
  for (int t = 0; t < 6; ++t) EXPECT_DOUBLE_EQ(std::abs(test::volume(mesh, t)), 1.0 / 6) << t;
  EXPECT_GT(test::volume(mesh, 0), 0);
  EXPECT_TRUE(mesh.notices.empty());
}

TEST(MakeGrid, TetrahedraFollowTheirCubes) {
  const int n = 4, c = 3;
  const int axes[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  const Dataset mesh = make_grid(n);
  ASSERT_EQ(mesh.tetrahedra.extent(0), 6u * c * c * c);
  for (int t = 0; t < 6 * c * c * c; ++t) {
    int at[3] = {t / 6 % c, t / 6 / c % c, t / 6 / c / c};
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(mesh.tetrahedra(t, k), (at[2] * n + at[1]) * n + at[0]) << t;
      if (k < 3) ++at[axes[t % 6][k]];
    }
  }
}

TEST(MakeGrid, NeighboursShareTriangles) {
  for (const int n : {2, 3, 5}) {
    const Dataset mesh = make_grid(n);
    std::map<std::array<int, 3>, int> uses;
    for (std::size_t t = 0; t < mesh.tetrahedra.extent(0); ++t) {
      for (int out = 0; out < 4; ++out) {
        std::array<int, 3> triangle;
        for (int k = 0, to = 0; k < 4; ++k) {
          if (k != out) triangle[to++] = mesh.tetrahedra(t, k);
        }
        std::sort(triangle.begin(), triangle.end());
        ++uses[triangle];
      }
    }
    const int c = n - 1;
    EXPECT_EQ(uses.size(), 12u * c * c * c + 6u * c * c);
    EXPECT_EQ(std::count_if(uses.begin(), uses.end(), [](const auto& u) { return u.second == 1; }), 12 * c * c);
    EXPECT_TRUE(std::all_of(uses.begin(), uses.end(), [](const auto& u) { return u.second <= 2; }));
  }
}

std::uint32_t hash(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352d;
  x ^= x >> 15;
  x *= 0x846ca68b;
  return x ^ x >> 16;
}

TEST(MakeGrid, FieldIsTheFormula) {
  const int n = 9;
  const Dataset mesh = make_grid(n);
  ASSERT_EQ(test::names_of(mesh.arrays), std::vector<std::string>{"field"});
  const auto& field = test::values_of<float>(mesh.arrays[0]);
  ASSERT_EQ(field.size(), 729u);
  EXPECT_EQ(field[0], 0.f);  // sin(0) cos(0) + sin(0), and the hash of 0 is 0
  for (int i = 0; i < n * n * n; ++i) {
    const int x = i % n, y = i / n % n, z = i / n / n;
    const double expected = std::sin(0.11 * x) * std::cos(0.13 * y) + std::sin(0.17 * z + 0.05 * x) +
                            0.05 * hash(static_cast<std::uint32_t>(i)) / 4294967296.0;
    EXPECT_FLOAT_EQ(field[i], static_cast<float>(expected)) << i;
  }
}

TEST(MakeGrid, RefusesWhatHasNoTetrahedraOrTooMany) {
  EXPECT_EQ(error_of([] { make_grid(1); }), "grid:1 has no tetrahedra: N must be at least 2");
  EXPECT_EQ(error_of([] { make_grid(-5); }), "grid:-5 has no tetrahedra: N must be at least 2");
  EXPECT_EQ(error_of([] { make_grid(712); }),
            "grid:712 has 2156552586 tetrahedra, more than the 2147483647 that 32-bit ids can number");
  EXPECT_EQ(error_of([] { make_grid(2000); }),
            "grid:2000 has 8000000000 vertices, more than the 2147483647 that 32-bit ids can number");
}

TEST(MakeGridPart, AllTogetherAreTheWholeGrid) {
  constexpr int n = 6;
  const Dataset whole = make_grid(n);
  const auto& points = std::get<Dataset::Points<float>>(whole.points);
  const auto& field = test::values_of<float>(whole.arrays[0]);
  for (const int parts : {1, 2, 3, 5, 8}) {
    std::size_t next = 0;
    for (int p = 0; p < parts; ++p) {
      const GridPart part = make_grid_part(n, p, parts);
      ASSERT_EQ(part.field.size(), part.points.extent(0));
      for (std::size_t i = 0; i < part.field.size(); ++i) {
        const std::size_t there = part.first_vertex + i;
        EXPECT_EQ(part.field[i], field[there]);
        for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(part.points(i, axis), points(there, axis));
      }
      if (part.tetrahedra.extent(0) > 0) EXPECT_EQ(part.first_tetrahedron, static_cast<std::int64_t>(next));
      for (std::size_t t = 0; t < part.tetrahedra.extent(0); ++t, ++next) {
        for (int corner = 0; corner < 4; ++corner) {
          const std::int64_t vertex = part.tetrahedra(t, corner);
          EXPECT_EQ(vertex, whole.tetrahedra(next, corner));
          EXPECT_GE(vertex, part.first_vertex);
          EXPECT_LT(vertex, part.first_vertex + static_cast<std::int64_t>(part.field.size()));
        }
      }
    }
    EXPECT_EQ(next, whole.tetrahedra.extent(0)) << parts << " parts";
  }
}

TEST(MakeLayers, RefusesWhatIsNone) {
  EXPECT_EQ(error_of([] { make_layers({3, 4, 5}, {0, 2}, true); }), "no synthetic mesh has 3 x 4 x 5 points");
  EXPECT_EQ(error_of([] { make_layers({4, 4, 4}, {0, 10}, true); }), "there are no layers from 0 up to 10 among 4");
  EXPECT_EQ(error_of([] { make_layers({4, 4, 4}, {3, 1}, true); }), "there are no layers from 3 up to 1 among 4");
  EXPECT_EQ(error_of([] { make_layers({4, 4, 1}, {-3, 2}, true); }), "there are no layers from -3 up to 2 among 4");
}

TEST(MakeGridPart, NumbersBeyond32Bits) {
  const GridPart part = make_grid_part(1625, 1623, 1624);
  EXPECT_EQ(part.first_vertex, 1623LL * 1625 * 1625);
  EXPECT_EQ(part.first_tetrahedron, 1623LL * 1624 * 1624 * 6);
  EXPECT_EQ(part.tetrahedra(part.tetrahedra.extent(0) - 1, 3), 1625LL * 1625 * 1625 - 1);
  EXPECT_EQ(part.points(0, 2), 1623.f);
}

TEST(MakeGridPart, RefusesWhatIsNone) {
  EXPECT_EQ(error_of([] { make_grid_part(1, 0, 1); }), "grid:1 has no tetrahedra: N must be at least 2");
  EXPECT_EQ(error_of([] { make_grid_part(1626, 0, 1); }), "grid:1626 is too large: N is at most 1625");
  EXPECT_EQ(error_of([] { make_grid_part(4, 2, 2); }), "there is no part 2 of 2");
  EXPECT_EQ(error_of([] { make_grid_part(1000, 0, 2); }),
            "part 0 of grid:1000 has 2988014994 tetrahedra, more than the 2147483647 that 32-bit ids can number");
}

TEST(MakeSynthetic, HasAllPointsOfTheCubeOrThoseOfItsShape) {
  const int n = 24;
  const double middle = (n - 1) / 2.0;
  for (const std::string kind : {"smooth", "noisy", "ball", "shells", "dense"}) {
    SCOPED_TRACE(kind);
    EXPECT_TRUE(is_synthetic(kind));
    const Dataset mesh = make_synthetic(kind, n);
    const auto& points = std::get<Dataset::Points<float>>(mesh.points);
    const auto& field = std::get<std::vector<float>>(mesh.arrays.at(0).values);
    EXPECT_EQ(mesh.arrays[0].name, "field");
    ASSERT_EQ(field.size(), points.extent(0));
    EXPECT_GT(*std::min_element(field.begin(), field.end()), 0);
    const bool whole = kind != "ball" && kind != "shells";
    if (whole) EXPECT_EQ(points.extent(0), static_cast<std::size_t>(n * n * n));
    if (whole) EXPECT_EQ(mesh.tetrahedra.extent(0), static_cast<std::size_t>(6 * (n - 1) * (n - 1) * (n - 1)));
    if (whole) continue;
    EXPECT_LT(points.extent(0), static_cast<std::size_t>(n * n * n) * 6 / 10);
    for (std::size_t i = 0; i < points.extent(0); ++i) {
      double square = 0;
      for (int axis = 0; axis < 3; ++axis) square += std::pow((points(i, axis) - middle) / middle, 2);
      EXPECT_LE(square, 1 + 1e-9) << i;
    }
  }
}

TEST(MakeSynthetic, DenseHasMorePointsNearTheFirstCorner) {
  const Dataset mesh = make_synthetic("dense", 17);
  const auto& points = std::get<Dataset::Points<float>>(mesh.points);
  const double half = 8;
  int near = 0;
  for (std::size_t i = 0; i < points.extent(0); ++i)
    near += points(i, 0) < half && points(i, 1) < half && points(i, 2) < half;
  EXPECT_EQ(near, 13 * 13 * 13);  // 16(0.1t + 0.9t^3) < 8 for t up to 12/16
  EXPECT_EQ(points(0, 0), 0.f);
  EXPECT_EQ(points(points.extent(0) - 1, 2), 16.f);
}

TEST(MakeSynthetic, RefusesWhatIsNone) {
  EXPECT_FALSE(is_synthetic("grid"));
  EXPECT_EQ(error_of([] { make_synthetic("cube", 5); }), "there is no synthetic mesh 'cube'");
  EXPECT_EQ(error_of([] { make_synthetic("ball", 1); }), "ball:1 has no tetrahedra: N must be at least 2");
  EXPECT_EQ(error_of([] { make_synthetic("noisy", 1291); }),
            "noisy:1291 has more vertices than the 2147483647 that 32-bit ids can number");
}

}  // namespace
}  // namespace gale::io
