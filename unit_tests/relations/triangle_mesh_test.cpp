#include <algorithm>
#include <mutex>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/mesh/input_numbers.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/runtime/device_sweep.hpp>
#include <gale/runtime/graph_of.hpp>
#include <gale/runtime/make_structure.hpp>
#include <gale/runtime/relation_of.hpp>

#include "runtime/ways.hpp"
#include "support/surfaces.hpp"

namespace gale::test {
namespace {

using Simplex = SurfaceOracle::Simplex;

/// The vertices of each simplex of a dimension (GALE's ids), in input ids, ascending.
std::vector<Simplex> vertices_of_simplices(const Mesh& mesh, int dimension) {
  const auto& input = mesh.vertex_input();
  std::vector<Simplex> all;
  const auto simplices = mesh.simplices({Enumeration::triangles, false, true});
  const Id count = mesh.interval_begin(dimension)(mesh.segments());
  for (Id id = 0; id < count; ++id) {
    Simplex simplex{input(id < mesh.vertices() ? id : 0)};
    if (dimension == 1) simplex = {input(simplices.edge_low(id)), input(simplices.edge_high(id))};
    if (dimension == 2) {
      const Quad cell = simplices.cell(id);
      simplex = {input(cell.a), input(cell.b), input(cell.c)};
    }
    std::sort(simplex.begin(), simplex.end());
    all.push_back(simplex);
  }
  return all;
}

/// A surface, its mesh, and what touches what in it.
struct Case {
  explicit Case(const InputSurface& input, int capacity)
      : mesh(encode(input, capacity)), oracle(input.vertices(), input.triangles) {
    for (int dimension = 0; dimension < 3; ++dimension) named.push_back(vertices_of_simplices(mesh, dimension));
  }

  /// Is that the row of a simplex (GALE's ids)?
  bool is_row(Relation relation, Id simplex, const Row& row) const {
    SurfaceOracle::Simplices found;
    for (const Id id : row) found.insert(named[entry_dimension(relation)][id]);
    return std::is_sorted(row.begin(), row.end()) && static_cast<Id>(found.size()) == row.size() &&
           found == oracle.row(relation, named[row_dimension(relation)][simplex]);
  }

  /// Are the links of a segment the places of the triangles' other vertices?
  template <class SomeRows>
  int wrong_links(const SomeRows& rows) const {
    int wrong = 0;
    const auto encoded = mesh.encoded();
    for (const Id v : rows.interval(Relation::VV)) {
      const Row neighbours = rows[Relation::VV][v], triangles = rows[Relation::VF][v];
      const LinkRow link = rows.links()[v];
      wrong += link.size() != triangles.size() || link.others != 2;
      for (Id i = 0; i < link.size(); ++i) {
        int other = 0;
        for (int corner = 0; corner < 3; ++corner) {
          const Id vertex = encoded.cells(triangles[i], corner);
          if (vertex != v) wrong += neighbours[link(i, other++)] != vertex;
        }
      }
    }
    return wrong;
  }

  Mesh mesh;
  SurfaceOracle oracle;
  std::vector<std::vector<Simplex>> named;
};

class TriangleMesh : public testing::TestWithParam<std::string> {
 protected:
  const InputSurface& input() const { return surfaces().at(GetParam()); }
};

TEST_P(TriangleMesh, has_each_simplex_once) {
  for (const int capacity : {1, 7, 1000}) {
    const Case of(input(), capacity);
    EXPECT_EQ(of.mesh.dimension(), 2);
    for (int dimension = 0; dimension < 3; ++dimension) {
      EXPECT_TRUE(std::set<Simplex>(of.named[dimension].begin(), of.named[dimension].end()) ==
                  of.oracle.simplices(dimension));
      EXPECT_EQ(of.named[dimension].size(), of.oracle.simplices(dimension).size());
    }
    const auto count = [&](int dimension) { return static_cast<int>(of.oracle.simplices(dimension).size()); };
    EXPECT_EQ(count(0) - count(1) + count(2), input().euler);
  }
}

TEST_P(TriangleMesh, has_its_relations_in_each_structure) {
  const RelationSet relations = relations_of_dimension(2) | link_form;
  for (const int capacity : {5, 64}) {
    const Case of(input(), capacity);
    auto all = ways();
#ifdef GALE_ENABLE_KOKKOS_KERNELS
    all.push_back({"explicit", {}});
    all.back().options.way = Way::explicit_;
#endif
    for (const NamedWay& way : all) {
      if (way.is_task_parallel) continue;
      SCOPED_TRACE(way.name);
      const auto structure = way.make(of.mesh, relations);
      SweepOptions options;
      options.threads = 2;
      std::mutex mutex;
      int wrong = 0, wrong_links = 0;
      Id rows = 0;
      structure->for_each_segment(relations, options, [&](int, const SegmentRows& segment) {
        const std::lock_guard<std::mutex> lock(mutex);
        wrong_links += of.wrong_links(segment);
        for (const Relation relation : members_of(relations)) {
          for (const Id simplex : segment.interval(relation)) {
            ++rows;
            wrong += !of.is_row(relation, simplex, segment[relation][simplex]);
          }
        }
      });
      EXPECT_EQ(wrong, 0);
      EXPECT_EQ(wrong_links, 0);
      EXPECT_EQ(rows, static_cast<Id>(3 * (of.named[0].size() + of.named[1].size() + of.named[2].size())));
    }
  }
}

/// What a sweep of kernels leaves of each row: where it is, in no order.
struct CopyRows {
  Array<Id, WorkerMemory> rows, used;

  template <class Team, class SomeRows>
  KOKKOS_FUNCTION void operator()(const Team& team, const SomeRows& segment) const {
    const Rows neighbours = segment[Relation::VV], triangles = segment[Relation::VF];
    const LinkRows links = segment.links();
    team::for_all(team, neighbours.count, [&](int i) {
      const Id v = neighbours.first + i;
      const Row ring = neighbours[v], star = triangles[v];
      const LinkRow link = links[v];
      Id sum = 0;
      for (Id k = 0; k < ring.size(); ++k) sum = 31 * sum % 1000003 + ring[k] % 1000;
      for (Id k = 0; k < star.size(); ++k) {
        sum = 31 * sum % 1000003 + star[k] % 1000;
        for (int corner = 0; corner < 2; ++corner) sum = 31 * sum % 1000003 + link(k, corner) % 1000;
      }
      rows(v) = sum;
    });
  }
};

TEST_P(TriangleMesh, has_the_same_stars_from_kernels) {
  const Case of(input(), 20);
  const RelationSet stars = star_relations_of(2);
  const CopyRows launched{Array<Id, WorkerMemory>("rows", of.mesh.vertices()), {}};
  for_each_segment(WorkerSpace(), of.mesh, stars, launched);
  const CopyRows on_threads{Array<Id, WorkerMemory>("rows", of.mesh.vertices()), {}};
  if constexpr (have_device) GTEST_SKIP() << "the functor writes where the device is";
  for_each_segment(HostThreads(), of.mesh, stars, on_threads);
  int different = 0;
  for (Id v = 0; v < of.mesh.vertices(); ++v) different += launched.rows(v) != on_threads.rows(v);
  EXPECT_EQ(different, 0);
}

TEST_P(TriangleMesh, has_whole_relations_in_the_input_s_numbers) {
  const Case of(input(), 20);
  std::vector<std::vector<Simplex>> by_number(3);
  for (int dimension = 0; dimension < 3; ++dimension) {
    const auto number = input_numbers(of.mesh, dimension);
    by_number[dimension].resize(number.extent(0));
    for (std::size_t id = 0; id < number.extent(0); ++id) by_number[dimension][number(id)] = of.named[dimension][id];
  }
  EXPECT_TRUE(std::is_sorted(by_number[1].begin(), by_number[1].end()))
      << "edges are numbered as their vertices compare";
  for (std::size_t i = 0; i < input().triangles.size(); ++i) {
    Simplex corners(input().triangles[i].begin(), input().triangles[i].end());
    std::sort(corners.begin(), corners.end());
    ASSERT_EQ(by_number[2][i], corners) << "triangles have their places in the input";
  }
  for (const Relation relation : members_of(relations_of_dimension(2))) {
    const auto rows = relation_of(of.mesh, relation, Ids::input);
    int wrong = 0;
    for (Offset i = 0; i < rows.rows(); ++i) {
      SurfaceOracle::Simplices found;
      for (const Id id : rows.row(i)) found.insert(by_number[entry_dimension(relation)][id]);
      wrong += found != of.oracle.row(relation, by_number[row_dimension(relation)][i]);
      wrong += static_cast<Offset>(found.size()) != rows.row(i).size();
    }
    EXPECT_EQ(wrong, 0) << name_of(relation);
    EXPECT_EQ(rows.rows(), static_cast<Offset>(by_number[row_dimension(relation)].size())) << name_of(relation);
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, TriangleMesh, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const auto& one : surfaces()) names.push_back(one.first);
                           return names;
                         }()),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

std::string error_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(TriangleMeshes, name_what_is_wrong_with_a_triangle) {
  InputSurface surface = surfaces().at("one triangle");
  surface.triangles.push_back({0, 1, 3});
  EXPECT_EQ(error_of([&] { encode(surface, 10); }), "triangle 1 has vertex 3, but vertices are 0 to 2");
  surface.triangles.back() = {1, 0, 1};
  EXPECT_EQ(error_of([&] { encode(surface, 10); }), "triangle 1 has vertex 1 twice");
  surface.triangles.back() = {1, 0, 2};
  EXPECT_EQ(error_of([&] { encode(surface, 10); }), "triangles 0 and 1 have the same three vertices");
  surface.triangles.clear();
  EXPECT_EQ(error_of([&] { encode(surface, 10); }), "the mesh has no triangles");
}

TEST(TriangleMeshes, have_no_relations_of_tetrahedra) {
  const Mesh mesh = encode(surfaces().at("plane"), 10);
  for (const Relation relation : members_of(all_relations - relations_of_dimension(2))) {
    const std::string what = "a mesh of triangles has no relation " + name_of(relation) +
                             ": it has those among vertices, edges and triangles";
    EXPECT_EQ(error_of([&] { make_structure(mesh, relation); }), what);
    EXPECT_EQ(error_of([&] { relation_of(mesh, relation, Ids::input); }), what);
  }
  EXPECT_EQ(error_of([&] { mesh.interval_begin(3); }), "a mesh of triangles has no simplices of dimension 3");
}

}  // namespace
}  // namespace gale::test
