#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/mesh/cells/split_cells.hpp>

#include "support/input_mesh.hpp"
#include "support/message_of.hpp"
#include "support/mixed_cells.hpp"

namespace gale::test {

namespace {

using Ids = std::vector<std::int64_t>;
using Triangle = std::array<Id, 3>;
using Tetrahedron = std::array<Id, 4>;

template <class T, class Memory, class From>
Array<const T, Memory> view_of(const std::vector<From>& values) {
  const Array<T, HostMemory> host("values", values.size());
  std::transform(values.begin(), values.end(), host.data(), [](From value) { return static_cast<T>(value); });
  return Kokkos::create_mirror_view_and_copy(Memory(), host);
}

template <class Index = std::int64_t, class Memory = HostMemory>
Cells<Index, Memory> cells_of(const Ids& connectivity, const Ids& offsets, const std::vector<std::uint8_t>& types) {
  return {view_of<std::uint8_t, Memory>(types), view_of<Offset, Memory>(offsets), view_of<Index, Memory>(connectivity)};
}

/// What was split, on the host.
struct Split {
  std::vector<Tetrahedron> tetrahedra;
  std::vector<Id> cells;
  std::vector<std::string> notices;
};

template <class Memory>
Split on_the_host(const SplitCells<4, Memory>& split) {
  const auto simplices = Kokkos::create_mirror_view_and_copy(HostMemory(), split.simplices);
  const auto cells = Kokkos::create_mirror_view_and_copy(HostMemory(), split.cells);
  Split found{{}, {cells.data(), cells.data() + cells.extent(0)}, split.notices};
  for (std::size_t t = 0; t < simplices.extent(0); ++t)
    found.tetrahedra.push_back({simplices(t, 0), simplices(t, 1), simplices(t, 2), simplices(t, 3)});
  return found;
}

template <class Index = std::int64_t, class Memory = HostMemory>
Split split(const MixedMesh& mesh, const Ids& ids = {}) {
  const auto cells = cells_of<Index, Memory>(mesh.connectivity(), mesh.offsets(), mesh.types());
  return on_the_host(split_cells(cells, static_cast<Offset>(mesh.points.size()), view_of<GlobalId, Memory>(ids)));
}

Split split(const Ids& connectivity, const Ids& offsets, const std::vector<std::uint8_t>& types, Offset points) {
  return on_the_host(split_cells(cells_of(connectivity, offsets, types), points));
}

double volume_of(const MixedMesh& mesh, const Tetrahedron& t) {
  double d[3][3];
  for (int k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) d[k][axis] = mesh.points[t[k + 1]][axis] - mesh.points[t[0]][axis];
  }
  return (d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) - d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
          d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0])) /
         6;
}

Triangle sorted(Triangle triangle) {
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

/// How many tetrahedra each triangle has.
std::map<Triangle, int> triangles_of(const std::vector<Tetrahedron>& tetrahedra) {
  std::map<Triangle, int> count;
  for (const auto& t : tetrahedra) {
    for (int k = 0; k < 4; ++k) ++count[sorted({t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]})];
  }
  return count;
}

/// The triangles of a face's fan from its lowest point.
std::set<Triangle> fan_of(Ids face) {
  std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  std::set<Triangle> fan;
  for (std::size_t k = 1; k + 1 < face.size(); ++k) fan.insert(sorted({Id(face[0]), Id(face[k]), Id(face[k + 1])}));
  return fan;
}

/// Each triangle has at most two tetrahedra, the surface is the split of the input's, and volumes sum up to the whole.
void expect_fits(const MixedMesh& mesh, const Split& split) {
  std::map<Ids, int> faces;
  std::map<Ids, Ids> around;
  for (const MixedCell& cell : mesh.cells) {
    for (const Ids& face : cell.faces) {
      Ids key = face;
      std::sort(key.begin(), key.end());
      ++faces[key];
      around[key] = face;
    }
  }
  std::set<Triangle> expected, found;
  for (const auto& [key, count] : faces) {
    ASSERT_LE(count, 2);
    if (count == 1) expected.merge(fan_of(around[key]));
  }
  for (const auto& [triangle, count] : triangles_of(split.tetrahedra)) {
    ASSERT_LE(count, 2);
    if (count == 1) found.insert(triangle);
  }
  EXPECT_EQ(found, expected);
  double volume = 0;
  for (const auto& t : split.tetrahedra) volume += std::abs(volume_of(mesh, t));
  EXPECT_NEAR(volume, mesh.volume, 1e-9 * mesh.volume);
  // Cells come in their order, and each has tetrahedra of its own points.
  ASSERT_EQ(split.cells.size(), split.tetrahedra.size());
  EXPECT_TRUE(std::is_sorted(split.cells.begin(), split.cells.end()));
  EXPECT_EQ(std::set<Id>(split.cells.begin(), split.cells.end()).size(), mesh.cells.size());
  for (std::size_t t = 0; t < split.cells.size(); ++t) {
    std::set<std::int64_t> points;
    for (const Ids& face : mesh.cells[split.cells[t]].faces) points.insert(face.begin(), face.end());
    for (const Id vertex : split.tetrahedra[t]) EXPECT_EQ(points.count(vertex), 1u);
  }
}

/// The message that splitting one such cell of ten points ends with.
std::string message_for(int type, const Ids& points) {
  return message_of([&] {
    split(points, {0, static_cast<std::int64_t>(points.size())}, {static_cast<std::uint8_t>(type)}, 10);
  });
}

}  // namespace

TEST(SplitCells, mixed_cells_fit) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const MixedMesh mesh = mixed_mesh(2 + seed % 5, 1 + seed % 3, seed);
    expect_fits(mesh, split(mesh));
  }
}

TEST(SplitCells, collapsed_hexahedra_fit) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const MixedMesh mesh = collapsed_cylinder(3 + seed, 2, 2, seed);
    expect_fits(mesh, split(mesh));
  }
}

TEST(SplitCells, have_the_orientation_of_vtk) {
  std::mt19937 random(3);
  for (int k = 0; k < 10; ++k) {
    MixedMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    mesh.cells = {{12, {0, 1, 2, 3, 4, 5, 6, 7}, {}},
                  {11, {0, 1, 3, 2, 4, 5, 7, 6}, {}},
                  {13, {0, 3, 1, 4, 7, 5}, {}},
                  {14, {0, 1, 2, 3, 6}, {}}};
    mesh.renumber(random);
    const Split found = split(mesh);
    EXPECT_EQ(found.tetrahedra.size(), 6u + 6 + 3 + 2);
    for (const auto& t : found.tetrahedra) EXPECT_GT(volume_of(mesh, t), 0);
    EXPECT_EQ(found.notices,
              std::vector<std::string>{"split 1 voxels, 1 hexahedra, 1 wedges and 1 pyramids into 17 tetrahedra"});
  }
}

TEST(SplitCells, of_a_whole_mesh_do_not_depend_on_numbers_where_ids_are_given) {
  MixedMesh mesh = mixed_mesh(4, 2, 7);
  const Split expected = split(mesh);
  // Cells are numbered anew, with the numbers from before as ids.
  const MixedMesh before = mesh;
  std::mt19937 random(1);
  mesh.renumber(random);
  Ids ids(mesh.points.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (std::size_t f = 0; f < mesh.cells[c].faces.size(); ++f) {
      for (std::size_t k = 0; k < mesh.cells[c].faces[f].size(); ++k)
        ids[mesh.cells[c].faces[f][k]] = before.cells[c].faces[f][k];
    }
  }
  Split found = split(mesh, ids);
  for (auto& t : found.tetrahedra) {
    for (Id& vertex : t) vertex = static_cast<Id>(ids[vertex]);
  }
  EXPECT_EQ(found.tetrahedra, expected.tetrahedra);
  EXPECT_EQ(found.cells, expected.cells);
}

TEST(SplitCells, are_alike_in_each_memory_and_type) {
  const MixedMesh mesh = mixed_mesh(6, 3, 11);
  const Split expected = split(mesh);
  EXPECT_EQ(split<std::int32_t>(mesh).tetrahedra, expected.tetrahedra);
  const Split found = split<std::int32_t, WorkerMemory>(mesh);
  EXPECT_EQ(found.tetrahedra, expected.tetrahedra);
  EXPECT_EQ(found.cells, expected.cells);
}

TEST(SplitCells, quadratic_tetrahedra_are_eight_that_fit) {
  const InputMesh& linear = mesh_named("holed_grid_9");
  MixedMesh mesh;
  mesh.points = linear.points;
  std::map<std::pair<Id, Id>, std::int64_t> middles;
  const auto middle = [&](Id a, Id b) {
    const auto [found, is_new] = middles.emplace(std::minmax(a, b), mesh.points.size());
    if (is_new) {
      mesh.points.push_back({});
      for (int axis = 0; axis < 3; ++axis)
        mesh.points.back()[axis] = (linear.points[a][axis] + linear.points[b][axis]) / 2;
    }
    return found->second;
  };
  std::map<Triangle, int> expected;
  for (const auto& t : linear.tetrahedra) {
    mesh.cells.push_back({24, {t.begin(), t.end()}, {}});
    for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}})
      mesh.cells.back().points.push_back(middle(t[a], t[b]));
  }
  std::mt19937 random(5);
  mesh.renumber(random);
  const Split found = split(mesh);
  EXPECT_EQ(found.tetrahedra.size(), 8 * linear.tetrahedra.size());
  std::vector<Tetrahedron> whole;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Ids& points = mesh.cells[c].points;
    whole.push_back({Id(points[0]), Id(points[1]), Id(points[2]), Id(points[3])});
    for (std::size_t t = 8 * c; t < 8 * c + 8; ++t) {
      EXPECT_EQ(found.cells[t], Id(c));
      EXPECT_NEAR(volume_of(mesh, found.tetrahedra[t]), volume_of(mesh, whole.back()) / 8, 1e-12);
    }
  }
  // Each triangle of the surface is four, each one inside is four that have two tetrahedra each.
  const auto surface_of = [](const std::map<Triangle, int>& all) {
    int surface = 0;
    for (const auto& [triangle, count] : all) {
      EXPECT_LE(count, 2);
      surface += count == 1;
    }
    return surface;
  };
  EXPECT_EQ(surface_of(triangles_of(found.tetrahedra)), 4 * surface_of(triangles_of(whole)));
}

TEST(SplitCells, lose_what_has_a_vertex_twice_and_cancel_in_pairs) {
  // Whatever points are one, the tetrahedra's triangles without a second one are those of the faces, in pairs.
  std::mt19937 random(9);
  for (int k = 0; k < 2000; ++k) {
    Ids points(8);
    for (auto& point : points) point = random() % (3 + k % 6);
    const Split found = split(points, {0, 8}, {12}, 9);
    std::set<Tetrahedron> different;
    for (Tetrahedron t : found.tetrahedra) {
      std::sort(t.begin(), t.end());
      EXPECT_EQ(std::set<Id>(t.begin(), t.end()).size(), 4u);
      EXPECT_TRUE(different.insert(t).second);
    }
    std::map<Triangle, int> expected;
    for (const Ids& corners :
         {Ids{0, 1, 2, 3}, Ids{4, 5, 6, 7}, Ids{0, 1, 5, 4}, Ids{1, 2, 6, 5}, Ids{2, 3, 7, 6}, Ids{3, 0, 4, 7}}) {
      Ids face;
      for (const auto corner : corners) face.push_back(points[corner]);
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      for (int i = 1; i < 3; ++i) {
        const Triangle triangle = sorted({Id(face[0]), Id(face[i]), Id(face[i + 1])});
        if (std::set<Id>(triangle.begin(), triangle.end()).size() == 3) ++expected[triangle];
      }
    }
    auto triangles = triangles_of(found.tetrahedra);
    for (const auto& [triangle, count] : expected) triangles[triangle] += count;
    for (const auto& [triangle, count] : triangles) EXPECT_EQ(count % 2, 0);
  }
}

TEST(SplitCells, tetrahedra_stay_as_they_are) {
  const Split found = split({3, 1, 2, 0, 4, 3, 2, 1}, {0, 4, 8}, {10, 10}, 5);
  EXPECT_EQ(found.tetrahedra, (std::vector<Tetrahedron>{{3, 1, 2, 0}, {4, 3, 2, 1}}));
  EXPECT_TRUE(found.cells.empty());
  EXPECT_TRUE(found.notices.empty());
  const Split mixed = split({7, 8, 3, 1, 2, 0, 0, 1, 2, 3, 4, 5, 6, 7}, {0, 2, 6, 14}, {3, 10, 12}, 9);
  EXPECT_EQ(mixed.tetrahedra[0], (Tetrahedron{3, 1, 2, 0}));
  EXPECT_EQ(mixed.cells, (std::vector<Id>{1, 2, 2, 2, 2, 2, 2}));
  EXPECT_EQ(mixed.notices, (std::vector<std::string>{"split 1 hexahedra into 6 tetrahedra",
                                                     "left out 1 cells of a dimension below 3"}));
  EXPECT_TRUE(split({}, {0}, {}, 0).tetrahedra.empty());
}

TEST(SplitCells, refuse_what_is_none_in_one_line) {
  EXPECT_EQ(message_for(10, {0, 1, 2, 10}), "cell 0 names point 10 of 10");
  EXPECT_EQ(message_for(10, {0, 1, 2}), "cell 0 is a vtkTetra of 3 points, not 4");
  EXPECT_EQ(message_for(12, {0, 1, 2, 3, 4, 5, 6, -7}), "cell 0 names point -7 of 10");
  EXPECT_EQ(message_for(12, {0, 1, 2}), "cell 0 is a vtkHexahedron of 3 points, not 8");
  EXPECT_EQ(message_for(200, {0, 1, 2}), "cell 0 has the unknown type 200");
  EXPECT_EQ(message_for(25, {0, 1, 2}), "cell 0 is a vtkQuadraticHexahedron, which isn't split");
  EXPECT_EQ(message_for(41, {0, 1, 2, 3}), "cell 0 is a vtkConvexPointSet, which isn't split");
  const std::string open = "cell 0 is a vtkPolyhedron whose faces don't close: one of its edges is in one face only";
  EXPECT_EQ(message_for(42, {4, 3, 0, 1, 2, 3, 0, 1, 3, 3, 0, 2, 3, 3, 1, 2, 4}), open);
  EXPECT_EQ(message_for(42, {3, 3, 0, 1, 2, 3, 0, 1, 3, 3, 0, 2, 3}), open);
  EXPECT_EQ(message_for(42, {1, 3, 0, 1, 12}), "cell 0 names point 12 of 10");
  for (const Ids& points : {Ids{}, Ids{0}, Ids{-1}, Ids{4}, Ids{1, 2, 0, 1}, Ids{1, 4, 0, 1, 2}, Ids{1, 3, 0, 1, 2, 5},
                            Ids{2, 3, 0, 1, 2}, Ids{1, std::int64_t(1) << 40, 0, 1, 2}, Ids{1, -3, 0, 1, 2}})
    EXPECT_EQ(message_for(42, points).rfind("cell 0 is a vtkPolyhedron whose faces aren't ", 0), 0u);
  const auto offsets = [](const Ids& all) {
    return message_of([&] { split({0, 1, 2, 3, 4, 5, 6, 7}, all, {10, 10}, 9); });
  };
  EXPECT_EQ(offsets({0, 4, 3}), "cell 1 ends at 3 in a connectivity of 8, and the one before it at 4");
  EXPECT_EQ(offsets({0, 4, 9}), "cell 1 ends at 9 in a connectivity of 8, and the one before it at 4");
  EXPECT_EQ(offsets({0, -4, 8}), "cell 0 ends at -4 in a connectivity of 8, and the one before it at 0");
  EXPECT_EQ(offsets({1, 5, 8}), "the first cell begins at 1, not at 0");
  EXPECT_EQ(offsets({0, 8}), "there are 2 offsets for 2 cells: one more than cells is wanted, the first 0");
}

namespace {

/// The triangles of flat cells.
std::vector<Triangle> triangles_of_cells(const Ids& connectivity, const Ids& offsets,
                                         const std::vector<std::uint8_t>& types, Offset points, const Ids& ids = {}) {
  const auto found =
      split_polygons(cells_of(connectivity, offsets, types), points, view_of<GlobalId, HostMemory>(ids)).simplices;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < found.extent(0); ++t) triangles.push_back({found(t, 0), found(t, 1), found(t, 2)});
  return triangles;
}

}  // namespace

TEST(SplitPolygons, each_type_by_hand) {
  const std::vector<Triangle> fan = {{1, 4, 3}, {1, 3, 2}};
  EXPECT_EQ(triangles_of_cells({3, 2, 1, 4}, {0, 4}, {9}, 5), fan);
  EXPECT_EQ(triangles_of_cells({3, 2, 1, 4}, {0, 4}, {7}, 5), fan);
  EXPECT_EQ(triangles_of_cells({3, 2, 4, 1}, {0, 4}, {8}, 5), fan);
  EXPECT_EQ(triangles_of_cells({0, 1, 2, 3, 4}, {0, 5}, {7}, 5, {9, 8, 7, 6, 5}),
            (std::vector<Triangle>{{4, 0, 1}, {4, 1, 2}, {4, 2, 3}}));
  EXPECT_EQ(triangles_of_cells({4, 3, 2, 1, 0}, {0, 5}, {6}, 5),
            (std::vector<Triangle>{{4, 3, 2}, {3, 1, 2}, {2, 1, 0}}));
  EXPECT_EQ(triangles_of_cells({0, 1, 2, 3, 4, 5}, {0, 6}, {22}, 6),
            (std::vector<Triangle>{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}));
  EXPECT_EQ(triangles_of_cells({2, 1, 0, 1, 2, 3}, {0, 3, 6}, {5, 5}, 4),
            (std::vector<Triangle>{{2, 1, 0}, {1, 2, 3}}));
  EXPECT_EQ(triangles_of_cells({0, 1, 0, 1, 1, 3, 4}, {0, 2, 7}, {3, 7}, 5),
            (std::vector<Triangle>{{0, 1, 3}, {0, 3, 4}}))
      << "a line is left out, and what has a vertex twice";
}

TEST(SplitPolygons, cover_what_they_are_made_of) {
  // The boundary of each polygon's triangles, edges of one triangle, is that of the polygon.
  std::mt19937 random(2);
  for (int k = 0; k < 200; ++k) {
    Ids polygon(3 + random() % 10);
    for (std::size_t i = 0; i < polygon.size(); ++i) polygon[i] = static_cast<std::int64_t>(i);
    std::shuffle(polygon.begin(), polygon.end(), random);
    const auto size = static_cast<std::int64_t>(polygon.size());
    const auto found = triangles_of_cells(polygon, {0, size}, {7}, size);
    EXPECT_EQ(found.size(), polygon.size() - 2);
    std::map<std::pair<Id, Id>, int> edges;
    for (const Triangle& t : found) {
      EXPECT_EQ(t[0], 0);
      for (int i = 0; i < 3; ++i) ++edges[std::minmax(t[i], t[(i + 1) % 3])];
    }
    for (std::size_t i = 0; i < polygon.size(); ++i)
      ++edges[std::minmax(Id(polygon[i]), Id(polygon[(i + 1) % polygon.size()]))];
    for (const auto& [edge, count] : edges) EXPECT_EQ(count, 2);
  }
}

TEST(CellsOfTypes, have_a_highest_dimension_and_others_than_simplices) {
  const auto of = [](const std::vector<std::uint8_t>& types) {
    return Array<const std::uint8_t, HostMemory>(types.data(), types.size());
  };
  const std::vector<std::uint8_t> mixed = {1, 5, 9, 22, 12, 10, 14}, flat = {5, 3, 7, 7}, lines = {3, 1},
                                  unknown = {200}, none;
  EXPECT_EQ(highest_dimension(of(mixed)), 3);
  EXPECT_EQ(highest_dimension(of(flat)), 2);
  EXPECT_EQ(highest_dimension(of(lines)), 1);
  EXPECT_EQ(highest_dimension(of(unknown)), 0);
  EXPECT_EQ(highest_dimension(of(none)), 0);
  std::array<Offset, 256> census{};
  EXPECT_EQ(highest_dimension(census), 0);
  census[200] = 4;
  census[9] = 1;
  EXPECT_EQ(highest_dimension(census), 2);
  census[13] = 1;
  EXPECT_EQ(highest_dimension(census), 3);
  EXPECT_EQ(other_cells(of(mixed)), "1 hexahedra and 1 pyramids");
  EXPECT_EQ(other_cells(of(mixed), 2), "1 quads and 1 quadratic triangles");
  EXPECT_EQ(other_cells(of(flat), 2), "2 polygons");
  EXPECT_EQ(other_cells(of(flat)), "");
}

TEST(SplitPolygons, refuse_what_is_none) {
  const auto message = [](int type, const Ids& points) {
    return message_of([&] {
      triangles_of_cells(points, {0, static_cast<std::int64_t>(points.size())}, {static_cast<std::uint8_t>(type)}, 10);
    });
  };
  EXPECT_EQ(message(7, {0, 1}), "cell 0 is a vtkPolygon of 2 points");
  EXPECT_EQ(message(9, {0, 1, 2}), "cell 0 is a vtkQuad of 3 points, not 4");
  EXPECT_EQ(message(7, {0, 1, 2, 3, 10}), "cell 0 names point 10 of 10");
  EXPECT_EQ(message(12, {0, 1, 2}), "cell 0 is a vtkHexahedron, which isn't split into triangles");
  EXPECT_EQ(message(23, {0, 1, 2}), "cell 0 is a vtkQuadraticQuad, which isn't split");
}

}  // namespace gale::test
