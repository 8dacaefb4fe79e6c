#include <array>

#include <gtest/gtest.h>

#include <gale/runtime/batches/host_worker.hpp>

#include "support/input_mesh.hpp"
#include "support/segmentations.hpp"

// Meshes with a vertex or an edge of 200000 tetrahedra: whatever takes the square of that doesn't end. Some rows do by
// themselves: all edges at a vertex are adjacent to each other (EE), and all triangles at an edge (FF).

namespace gale::test {

namespace {

constexpr Id degree = 200000;
constexpr RelationSet linear = all_relations - Relation::EE - Relation::FF;
constexpr RelationSet searched = Relation::VF | Relation::EF | Relation::ET | Relation::FT | Relation::TT;

/// What a mesh has.
struct Facts {
  Offset vertices, edges, triangles, tetrahedra;
  Offset triangle_pairs = 0;  ///< that share an edge, counted twice

  Offset simplices(int dimension) const { return std::array{vertices, edges, triangles, tetrahedra}[dimension]; }

  /// Entries of all rows. Each triangle is in one tetrahedron or in two.
  Offset entries(Relation relation) const {
    constexpr int faces[4][4] = {{1, 2, 3, 4}, {2, 1, 3, 6}, {3, 3, 1, 4}, {4, 6, 4, 1}};
    if (relation == Relation::VV) return 2 * edges;
    if (relation == Relation::FF) return triangle_pairs;
    if (relation == Relation::TT) return 2 * (4 * tetrahedra - triangles);
    const int rows = row_dimension(relation), entries = entry_dimension(relation);
    return faces[rows][entries] * simplices(std::max(rows, entries));
  }
};

/// A ring around one edge.
constexpr Facts ring = {degree + 2, 3 * degree + 1, 3 * degree, degree};

/// A cone over a disc of no inner vertices, which has 2 * degree - 3 edges, degree of them on its boundary, and
/// degree - 2 triangles. Over a strip, edges from the apex to four vertices have 2, 3, 3 and 2 triangles, to others 4.
constexpr Facts cone = {degree + 1, 3 * degree - 3, 3 * degree - 5, degree - 2,
                        2 * 2 + 2 * 6 + (degree - 4) * 12 + (degree - 3) * 6 + degree * 2};

/// Two paths of 200 vertices, each edge of one with each of the other: every vertex has a high degree.
constexpr Offset path = 200;
constexpr Facts joined_paths = {2 * path, path* path + 2 * (path - 1), 2 * path*(path - 1), (path - 1) * (path - 1)};

InputMesh join_paths() {
  InputMesh mesh;
  for (Id i = 0; i < 2 * path; ++i) mesh.points.push_back({i < path ? 0.0 : 1.0, 0.01 * i, 0.0});
  for (Id i = 0; i + 1 < path; ++i) {
    for (Id j = path; j + 1 < 2 * path; ++j) mesh.tetrahedra.push_back({i, i + 1, j, j + 1});
  }
  return mesh;
}

void expect_facts(const Mesh& mesh, RelationSet relations, const Facts& facts) {
  HostWorker worker(mesh, relations);
  std::array<Offset, relation_count> rows{}, entries{};
  for (Id s = 0; s < mesh.segments(); ++s) {
    const SegmentRows found = worker.compute(s);
    for (const Relation relation : members_of(relations)) {
      rows[static_cast<int>(relation)] += found.interval(relation).size();
      Offset& sum = entries[static_cast<int>(relation)];
      for (const Id i : found.interval(relation)) sum += found[relation][i].size();
    }
  }
  for (const Relation relation : members_of(relations)) {
    EXPECT_EQ(rows[static_cast<int>(relation)], facts.simplices(row_dimension(relation))) << name_of(relation);
    EXPECT_EQ(entries[static_cast<int>(relation)], facts.entries(relation)) << name_of(relation);
  }
}

/// In the order of the input, 100 a segment.
Mesh in_order(const InputMesh& input) {
  std::vector<std::int64_t> labels(input.vertices());
  for (Id v = 0; v < input.vertices(); ++v) labels[v] = v / 100;
  return encode(input, segmentation_by(labels));
}

Mesh in_octree(const InputMesh& input) { return encode(input, 100); }

}  // namespace

TEST(HighDegree, of_an_edge_wherever_an_octree_puts_its_ends) {
  expect_facts(in_octree(ring_around_edges(degree, {0, 1})), linear, ring);
}

TEST(HighDegree, of_an_edge_from_the_first_vertex_to_one_in_the_middle) {
  expect_facts(in_order(ring_around_edges(degree, {0, degree / 2})), searched, ring);
}

TEST(HighDegree, of_the_last_edge) {
  expect_facts(in_order(ring_around_edges(degree, {degree, degree + 1})), searched, ring);
}

TEST(HighDegree, of_a_vertex_and_of_one_edge_at_it) { expect_facts(in_octree(cone_over_disc(degree)), linear, cone); }

TEST(HighDegree, of_a_vertex_alone) {
  expect_facts(in_octree(cone_over_strip(degree)), Relation::VF | Relation::FF, cone);
}

TEST(HighDegree, of_all_vertices) { expect_facts(in_octree(join_paths()), linear, joined_paths); }

}  // namespace gale::test
