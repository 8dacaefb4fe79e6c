#include <algorithm>

#include <gtest/gtest.h>

#include "support/brute_force.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

using Table = std::vector<std::vector<Id>>;

constexpr SimplexNeeds of_each_table = {Enumeration::triangles, true, true};

/// The tables of `Simplices`, wherever they lie.
struct Copied {
  std::vector<Id> cell_begin, edge_begin, edge_low, edge_high, triangle_begin, triangle_edge, triangle_apex,
      lower_begin, lower_edges;
  Table tetrahedra;

  template <class Memory>
  explicit Copied(const Simplices<Memory>& s)
      : cell_begin(copy(s.cell_begin)),
        edge_begin(copy(s.edge_begin)),
        edge_low(copy(s.edge_low)),
        edge_high(copy(s.edge_high)),
        triangle_begin(copy(s.triangle_begin)),
        triangle_edge(copy(s.triangle_edge)),
        triangle_apex(copy(s.triangle_apex)),
        lower_begin(copy(s.lower_begin)),
        lower_edges(copy(s.lower_edges)) {
    const Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory> host("copy", s.cells.extent(0));
    Kokkos::deep_copy(host, s.cells);
    for (std::size_t t = 0; t < host.extent(0); ++t)
      tetrahedra.push_back({host(t, 0), host(t, 1), host(t, 2), host(t, 3)});
  }

  Table edges() const {
    Table table;
    for (std::size_t e = 0; e < edge_low.size(); ++e) table.push_back({edge_low[e], edge_high[e]});
    return table;
  }
  Table triangles() const {
    Table table;
    for (std::size_t f = 0; f < triangle_edge.size(); ++f) {
      table.push_back({edge_low.at(triangle_edge[f]), edge_high.at(triangle_edge[f]), triangle_apex[f]});
    }
    return table;
  }

 private:
  template <class View>
  static std::vector<Id> copy(const View& view) {
    const Array<Id, HostMemory> host("copy", view.extent(0));
    Kokkos::deep_copy(host, view);
    return {host.data(), host.data() + host.extent(0)};
  }
};

/// Where the rows of `rows` simplices begin, if `row_of` says in which each entry is.
template <class RowOf>
std::vector<Id> begins(std::size_t rows, std::size_t entries, const RowOf& row_of) {
  std::vector<Id> begin(rows + 1, 0);
  for (std::size_t i = 0; i < entries; ++i) ++begin.at(row_of(i) + 1);
  for (std::size_t row = 0; row < rows; ++row) begin[row + 1] += begin[row];
  return begin;
}

void expect_tables(const Copied& tables, const ExpectedSimplices& expected) {
  const auto& [vertices, edges, triangles, tetrahedra] = expected.vertices;
  EXPECT_EQ(tables.edges(), edges);
  EXPECT_EQ(tables.triangles(), triangles);
  EXPECT_EQ(tables.tetrahedra, tetrahedra);
  EXPECT_EQ(tables.edge_begin,
            begins(vertices.size(), edges.size(), [&edges = edges](std::size_t e) { return edges[e][0]; }));
  EXPECT_EQ(tables.cell_begin, begins(vertices.size(), tetrahedra.size(),
                                      [&tetrahedra = tetrahedra](std::size_t t) { return tetrahedra[t][0]; }));
  EXPECT_EQ(tables.triangle_begin,
            begins(edges.size(), triangles.size(), [&](std::size_t f) { return tables.triangle_edge[f]; }));
  std::vector<Id> lower;
  for (std::size_t e = 0; e < tables.edge_high.size(); ++e) lower.push_back(static_cast<Id>(e));
  std::stable_sort(lower.begin(), lower.end(), [&](Id a, Id b) { return tables.edge_high[a] < tables.edge_high[b]; });
  EXPECT_EQ(tables.lower_edges, lower);
  EXPECT_EQ(tables.lower_begin,
            begins(vertices.size(), edges.size(), [&edges = edges](std::size_t e) { return edges[e][1]; }));
}

void expect_intervals(const Mesh& mesh, const ExpectedSimplices& expected) {
  for (int dimension = 0; dimension < 4; ++dimension) {
    ASSERT_EQ(mesh.interval_begin(dimension).extent(0), static_cast<std::size_t>(mesh.segments()) + 1);
    for (Id s = 0; s < mesh.segments(); ++s) {
      const Interval interval = mesh.intervals_of(s)[dimension], wanted = expected.internal_to(s, dimension);
      ASSERT_EQ(interval.first, wanted.first) << "segment " << s << ", dimension " << dimension;
      ASSERT_EQ(interval.last, wanted.last) << "segment " << s << ", dimension " << dimension;
      ASSERT_EQ(mesh.interval_begin(dimension)(s), wanted.first);
      for (Id simplex = interval.first; simplex < interval.last; ++simplex)
        ASSERT_EQ(mesh.segment_of(dimension, simplex), s);
    }
    ASSERT_EQ(mesh.interval_begin(dimension)(mesh.segments()), static_cast<Id>(expected.vertices[dimension].size()));
  }
}

/// Where a simplex is among all of its dimension.
Id place_of(const Table& all, const std::vector<Id>& simplex) {
  const auto found = std::lower_bound(all.begin(), all.end(), simplex);
  return found != all.end() && *found == simplex ? static_cast<Id>(found - all.begin()) : no_id;
}

}  // namespace

class SimplicesOf : public EveryMesh {
 protected:
  const Mesh mesh = encode(input(), segmentation());
  const ExpectedSimplices expected{brute_force_of(mesh_name()), mesh};
};

TEST_P(SimplicesOf, every_mesh_are_those_of_brute_force_on_worker_and_host) {
  {
    SCOPED_TRACE("on the worker");
    expect_tables(Copied(mesh.simplices<WorkerMemory>(of_each_table)), expected);
  }
  {
    SCOPED_TRACE("on the host");
    expect_tables(Copied(mesh.simplices(of_each_table)), expected);
  }
  EXPECT_EQ(mesh.known_edges(), static_cast<Id>(expected.vertices[1].size()));
  EXPECT_EQ(mesh.known_triangles(), static_cast<Id>(expected.vertices[2].size()));
}

TEST_P(SimplicesOf, every_mesh_are_in_the_interval_of_the_segment_of_their_lowest_vertex) {
  expect_intervals(mesh, expected);  // which enumerates them
}

INSTANTIATE_TEST_SUITE_P(Tests, SimplicesOf, every_mesh_and_segmentation(), mesh_and_segmentation);

/// Among those of vertex 0 are the most edges in the first mesh, the most tetrahedra in the second; in the last mesh
/// the last vertex has the most edges from lower ones.
TEST(Simplices, say_how_long_their_longest_list_is) {
  const auto longest_of = [](const InputMesh& input) {
    const Mesh mesh = encode(input, segmentation_by(std::vector<std::int64_t>(input.points.size(), 0)));
    EXPECT_EQ(mesh.simplices(of_each_table).longest_list, mesh.simplices<WorkerMemory>(of_each_table).longest_list);
    return mesh.simplices(of_each_table).longest_list;
  };
  EXPECT_EQ(longest_of(mesh_named("the_papers")), 4);
  EXPECT_EQ(longest_of(cone_over_caps(100, 2)), 2 * 98);
  EXPECT_EQ(longest_of(ring_around_edges(50, {50, 51})), 51);
}

/// Edges 01 02 03 04 12 13 23 24 25 34 35 45.
TEST(Simplices, of_the_papers_example) {
  const Mesh mesh = encode(mesh_named("the_papers"), segmentation_by({1, 1, 1, 2, 2, 2}));
  const Copied tables(mesh.simplices(of_each_table));
  EXPECT_EQ(tables.edges(),
            (Table{{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}, {1, 3}, {2, 3}, {2, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}));
  EXPECT_EQ(tables.triangles(), (Table{{0, 1, 2},
                                       {0, 1, 3},
                                       {0, 2, 3},
                                       {0, 2, 4},
                                       {0, 3, 4},
                                       {1, 2, 3},
                                       {2, 3, 4},
                                       {2, 3, 5},
                                       {2, 4, 5},
                                       {3, 4, 5}}));
  EXPECT_EQ(tables.edge_begin, (std::vector<Id>{0, 4, 6, 9, 11, 12, 12}));
  EXPECT_EQ(tables.triangle_begin, (std::vector<Id>{0, 2, 4, 5, 5, 6, 6, 8, 9, 9, 10, 10, 10}));
  EXPECT_EQ(tables.lower_edges, (std::vector<Id>{0, 1, 4, 2, 5, 6, 3, 7, 9, 8, 10, 11}));
  EXPECT_EQ(tables.lower_begin, (std::vector<Id>{0, 0, 1, 3, 6, 9, 12}));
  EXPECT_EQ(mesh.intervals_of(0)[1].last, 9);
  EXPECT_EQ(mesh.intervals_of(1)[2].size(), 1) << "345";
}

TEST(Simplices, are_found_by_their_vertices_if_they_are_there) {
  for (const char* const name : {"one_tetrahedron", "two_sharing_a_vertex", "the_papers", "several_components",
                                 "slivers", "random_tetrahedra", "ball"}) {
    const InputMesh& input = mesh_named(name);
    const Mesh mesh = encode(input, 7);
    const ExpectedSimplices expected(brute_force_of(name), mesh);
    const auto simplices = mesh.simplices({Enumeration::triangles, false, false});
    for (Id a = 0; a < mesh.vertices(); ++a) {
      for (Id b = a + 1; b < mesh.vertices(); ++b) {
        const Id edge = place_of(expected.vertices[1], {a, b});
        ASSERT_EQ(simplices.edge_of(a, b), edge) << name << ": " << a << ' ' << b;
        for (Id c = b + 1; c < mesh.vertices(); ++c) {
          const Id triangle = edge == no_id ? no_id : place_of(expected.vertices[2], {a, b, c});
          ASSERT_EQ(simplices.triangle_of(a, b, c), triangle) << name << ": " << a << ' ' << b << ' ' << c;
          if (edge == no_id) continue;
          ASSERT_EQ(simplices.triangle_of(edge, c), triangle) << name;
        }
      }
    }
  }
}

/// The apex has edges to all others, more than a few: they are bisected.
TEST(Simplices, are_found_among_thousands_at_one_vertex) {
  const InputMesh& input = mesh_named("cone_over_sphere_2000");
  const Mesh mesh = encode(input, segmentation_by(std::vector<std::int64_t>(input.points.size(), 0)));
  const auto simplices = mesh.simplices({Enumeration::triangles, false, false});
  for (Id b = 1; b <= 2000; ++b) ASSERT_EQ(simplices.edge_of(0, b), b - 1);
  const ExpectedSimplices expected(brute_force_of("cone_over_sphere_2000"), mesh);
  for (Id f = 0; f < mesh.known_triangles(); ++f) {
    const auto& triangle = expected.vertices[2].at(f);
    ASSERT_EQ(simplices.triangle_of(triangle[0], triangle[1], triangle[2]), f);
  }
  EXPECT_EQ(simplices.triangle_of(0, 1, 2), no_id) << "two caps";
}

TEST(FindIn, finds_values_by_looking_and_by_bisection) {
  for (const Id count : {0, 1, 2, 7, 8, 9, 16, 17, 100}) {
    const Array<Id, HostMemory> odd("odd", count + 2);
    for (Id i = 0; i < count + 2; ++i) odd(i) = 2 * i + 1;
    for (Id value = 0; value < 2 * count + 6; ++value) {
      const Id place = value / 2;
      const bool there = value % 2 == 1 && place >= 1 && place < count + 1;
      ASSERT_EQ(detail::find_in(odd, 1, count + 1, value), there ? place : no_id) << value << " among " << count;
    }
  }
}

}  // namespace gale::test
