#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "support/arrays.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

using Quad = std::array<Id, 4>;

std::vector<Quad> tetrahedra_in(const EncodedMesh<HostMemory>& mesh) {
  std::vector<Quad> tetrahedra(mesh.cells.extent(0));
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    for (int corner = 0; corner < 4; ++corner) tetrahedra[t][corner] = mesh.cells(t, corner);
  }
  return tetrahedra;
}

/// Which segment holds each vertex (GALE's id).
std::vector<Id> segments_of_vertices(const Mesh& mesh) {
  std::vector<Id> segment_of;
  for (Id s = 0; s < mesh.segments(); ++s) segment_of.resize(mesh.vertex_begin()(s + 1), s);
  return segment_of;
}

/// T_ex by segment, from the tetrahedra.
std::vector<std::set<Id>> external_tetrahedra(const std::vector<Quad>& tetrahedra, const std::vector<Id>& segment_of,
                                              Id segments) {
  std::vector<std::set<Id>> external(segments);
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    const Id home = segment_of[*std::min_element(tetrahedra[t].begin(), tetrahedra[t].end())];
    for (const Id v : tetrahedra[t]) {
      if (segment_of[v] != home) external[segment_of[v]].insert(static_cast<Id>(t));
    }
  }
  return external;
}

std::vector<std::vector<Id>> external_in(const EncodedMesh<HostMemory>& mesh) {
  std::vector<std::vector<Id>> rows;
  for (std::size_t s = 0; s + 1 < mesh.external_begin.extent(0); ++s) {
    rows.emplace_back(mesh.external.data() + mesh.external_begin(s), mesh.external.data() + mesh.external_begin(s + 1));
  }
  return rows;
}

void expect_external_tetrahedra(const Mesh& mesh) {
  const auto expected = external_tetrahedra(tetrahedra_in(mesh.encoded()), segments_of_vertices(mesh), mesh.segments());
  const auto external = external_in(mesh.encoded());
  ASSERT_EQ(external.size(), expected.size());
  for (std::size_t s = 0; s < expected.size(); ++s) {
    EXPECT_EQ(external[s], std::vector<Id>(expected[s].begin(), expected[s].end())) << "segment " << s;
  }
}

/// What GALE's tetrahedron `t` must be.
Quad renumbered(const InputMesh& input, const Mesh& mesh, Id t) {
  Quad quad = input.tetrahedra.at(mesh.cell_input()(t));
  for (Id& vertex : quad) vertex = mesh.vertex_internal()(vertex);
  std::sort(quad.begin(), quad.end());
  return quad;
}

}  // namespace

class MeshOf : public EveryMesh {
 protected:
  MeshOf() : mesh(encode(input(), segmentation())) {}

  const Mesh mesh;
};

TEST_P(MeshOf, every_input_has_its_counts) {
  EXPECT_EQ(mesh.vertices(), input().vertices());
  EXPECT_EQ(mesh.cells(), static_cast<Id>(input().tetrahedra.size()));
  EXPECT_EQ(mesh.segments(), segmentation().segments());
}

TEST_P(MeshOf, every_input_lies_where_the_workers_are) { EXPECT_EQ(mesh.on_device(), have_device); }

TEST_P(MeshOf, every_input_numbers_vertices_by_the_segmentation) {
  const auto vertex_input = to_vector(mesh.vertex_input());
  EXPECT_EQ(vertex_input, to_vector(segmentation().vertex_input));
  EXPECT_EQ(vertex_input, to_vector(mesh.vertex_input<WorkerMemory>()));
  EXPECT_EQ(to_vector(mesh.vertex_begin()), to_vector(segmentation().vertex_begin));
  for (Id v = 0; v < mesh.vertices(); ++v) ASSERT_EQ(mesh.vertex_internal()(vertex_input[v]), v);
}

TEST_P(MeshOf, every_input_has_the_same_tetrahedra_renumbered) {
  const auto tetrahedra = tetrahedra_in(mesh.encoded());
  std::set<Id> seen;
  for (Id t = 0; t < mesh.cells(); ++t) {
    const Id input_t = mesh.cell_input()(t);
    ASSERT_TRUE(seen.insert(input_t).second) << "input tetrahedron " << input_t << " twice";
    ASSERT_EQ(tetrahedra[t], renumbered(input(), mesh, t)) << "tetrahedron " << t;
  }
}

TEST_P(MeshOf, every_input_has_its_tetrahedra_in_order_and_in_intervals) {
  const auto& host = mesh.encoded();
  const auto tetrahedra = tetrahedra_in(host);
  EXPECT_TRUE(std::is_sorted(tetrahedra.begin(), tetrahedra.end()));
  ASSERT_EQ(host.internal_begin.extent(0), std::size_t(mesh.segments()) + 1);
  EXPECT_EQ(host.internal_begin(0), 0);
  EXPECT_EQ(host.internal_begin(mesh.segments()), mesh.cells());
  const auto segment_of = segments_of_vertices(mesh);
  for (Id s = 0; s < mesh.segments(); ++s) {
    ASSERT_LE(host.internal_begin(s), host.internal_begin(s + 1));
    for (Id t = host.internal_begin(s); t < host.internal_begin(s + 1); ++t) {
      ASSERT_EQ(segment_of[tetrahedra[t][0]], s) << "tetrahedron " << t;
    }
  }
}

TEST_P(MeshOf, every_input_has_its_external_tetrahedra_ascending) { expect_external_tetrahedra(mesh); }

TEST_P(MeshOf, every_input_finds_the_segment_of_a_vertex) {
  const auto segment_of = segments_of_vertices(mesh);
  for (Id v = 0; v < mesh.vertices(); ++v) ASSERT_EQ(mesh.segment_of(0, v), segment_of[v]);
}

TEST_P(MeshOf, every_input_is_the_same_from_64_bit_ids) {
  const Mesh other(tetrahedra_of<std::int64_t>(input()), segmentation());
  EXPECT_EQ(tetrahedra_in(other.encoded()), tetrahedra_in(mesh.encoded()));
  EXPECT_EQ(to_vector(other.cell_input()), to_vector(mesh.cell_input()));
  EXPECT_EQ(external_in(other.encoded()), external_in(mesh.encoded()));
}

INSTANTIATE_TEST_SUITE_P(Tests, MeshOf, every_mesh_and_segmentation(), mesh_and_segmentation);

/// The paper's figure of a mesh and its segmentation: S1 = {v0, v1, v2}, S2 = {v3, v4, v5}.
TEST(Mesh, of_the_papers_example) {
  const Mesh mesh = encode(mesh_named("the_papers"), segmentation_by({1, 1, 1, 2, 2, 2}));
  const auto& host = mesh.encoded();
  EXPECT_EQ(to_vector(mesh.vertex_begin()), (std::vector<Id>{0, 3, 6}));
  EXPECT_EQ(tetrahedra_in(host), (std::vector<Quad>{{0, 1, 2, 3}, {0, 2, 3, 4}, {2, 3, 4, 5}}));
  // All have their lowest vertex in S1, so they are internal to it, and external to S2.
  EXPECT_EQ(host.internal_begin(1), 3);
  EXPECT_EQ(host.internal_begin(2), 3);
  EXPECT_EQ(external_in(host), (std::vector<std::vector<Id>>{{}, {0, 1, 2}}));
}

TEST(Mesh, of_the_papers_example_with_its_segments_exchanged) {
  const Mesh mesh = encode(mesh_named("the_papers"), segmentation_by({2, 2, 2, 1, 1, 1}));
  EXPECT_EQ(to_vector(mesh.vertex_input()), (std::vector<Id>{3, 4, 5, 0, 1, 2}));
  EXPECT_EQ(tetrahedra_in(mesh.encoded()), (std::vector<Quad>{{0, 1, 2, 5}, {0, 1, 3, 5}, {0, 3, 4, 5}}));
  EXPECT_EQ(to_vector(mesh.cell_input()), (std::vector<Id>{2, 1, 0}));
}

/// Enough tetrahedra for several threads, which find them in any order.
TEST(Mesh, of_many_tetrahedra_is_in_the_same_order) {
  const InputMesh input = holed_grid(22);
  const Mesh mesh = encode(input, 100);
  const auto tetrahedra = tetrahedra_in(mesh.encoded());
  EXPECT_TRUE(std::is_sorted(tetrahedra.begin(), tetrahedra.end()));
  for (Id t = 0; t < mesh.cells(); ++t) ASSERT_EQ(tetrahedra[t], renumbered(input, mesh, t));
  expect_external_tetrahedra(mesh);
}

TEST(Mesh, leaves_its_input_as_it_was) {
  const InputMesh input = mesh_named("holed_grid_9");
  const auto points = points_of<double>(input);
  const auto tetrahedra = tetrahedra_of<std::int32_t>(input);
  const Mesh mesh(tetrahedra, octree_segmentation(points, 7));
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(points(i, axis), input.points[i][axis]);
  }
  for (std::size_t t = 0; t < input.tetrahedra.size(); ++t) {
    for (int corner = 0; corner < 4; ++corner) ASSERT_EQ(tetrahedra(t, corner), input.tetrahedra[t][corner]);
  }
}

TEST(Mesh, keeps_what_was_found_out_once) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), segmentation_by({0, 0, 0, 0}));
  const Mesh copy = mesh;
  int made = 0;
  const auto make = [&] { return std::make_shared<const int>(++made); };
  EXPECT_THROW(mesh.kept("a", []() -> std::shared_ptr<const void> { throw Error("not now"); }), Error);
  const auto a = mesh.kept("a", make), b = mesh.kept("b", make);
  EXPECT_EQ(*std::static_pointer_cast<const int>(a), 1);
  EXPECT_EQ(*std::static_pointer_cast<const int>(b), 2);
  EXPECT_EQ(copy.kept("a", make), a);
  EXPECT_EQ(made, 2);
}

TEST(Mesh, copies_share_their_arrays) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), segmentation_by({0, 0, 0, 0}));
  const Mesh copy = mesh;
  EXPECT_EQ(copy.encoded().cells.data(), mesh.encoded().cells.data());
}

}  // namespace gale::test
