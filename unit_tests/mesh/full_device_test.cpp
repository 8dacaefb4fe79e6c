#include "support/full_device.hpp"

#include <gtest/gtest.h>

#include <gale/base/memory.hpp>
#include <gale/mesh/input_numbers.hpp>

#include "support/arrays.hpp"
#include "support/input_mesh.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

constexpr SimplexNeeds all_tables = {Enumeration::triangles, true, true};

/// All that a mesh has, on the host.
void expect_equal(const Mesh& mesh, const Mesh& expected) {
  const auto& one = mesh.encoded();
  const auto& other = expected.encoded();
  ASSERT_EQ(mesh.cells(), expected.cells());
  for (Id t = 0; t < mesh.cells(); ++t) ASSERT_TRUE(one.cell(t) == other.cell(t)) << t;
  const auto values = [](const auto& view) {
    return std::vector<std::int64_t>(view.data(), view.data() + view.extent(0));
  };
  EXPECT_EQ(values(one.vertex_begin), values(other.vertex_begin));
  EXPECT_EQ(values(one.internal_begin), values(other.internal_begin));
  EXPECT_EQ(values(one.external_begin), values(other.external_begin));
  EXPECT_EQ(values(one.external), values(other.external));
  EXPECT_EQ(values(mesh.vertex_input()), values(expected.vertex_input()));
  EXPECT_EQ(values(mesh.cell_input()), values(expected.cell_input()));
  const auto tables = mesh.simplices(all_tables), wanted = expected.simplices(all_tables);
  EXPECT_EQ(values(tables.edge_begin), values(wanted.edge_begin));
  EXPECT_EQ(values(tables.edge_low), values(wanted.edge_low));
  EXPECT_EQ(values(tables.edge_high), values(wanted.edge_high));
  EXPECT_EQ(values(tables.triangle_begin), values(wanted.triangle_begin));
  EXPECT_EQ(values(tables.triangle_edge), values(wanted.triangle_edge));
  EXPECT_EQ(values(tables.triangle_apex), values(wanted.triangle_apex));
  EXPECT_EQ(values(tables.lower_edges), values(wanted.lower_edges));
  for (const int dimension : {0, 1, 2, 3}) {
    EXPECT_EQ(values(mesh.interval_begin(dimension)), values(expected.interval_begin(dimension))) << dimension;
    EXPECT_EQ(values(input_numbers(mesh, dimension)), values(input_numbers(expected, dimension))) << dimension;
  }
}

}  // namespace

TEST(Mesh, has_nothing_to_say_where_it_fits) {
  const InputMesh input = holed_grid(5);
  const Mesh mesh = encode(input, 20);
  mesh.simplices(all_tables);
  EXPECT_EQ(mesh.on_device(), have_device);
  EXPECT_EQ(mesh.notice(), "");
}

TEST(FullDevice, lets_the_host_make_the_mesh) {
  if (!have_device) GTEST_SKIP() << "there is no device";
  const InputMesh input = holed_grid(70);  // over a million tetrahedra, of 16 bytes each
  const Mesh expected = encode(input, 100);
  const FullDevice full(16 * mebi);
  const Mesh mesh = encode(input, 100);
  EXPECT_FALSE(mesh.on_device());
  EXPECT_EQ(mesh.notice().rfind("the mesh doesn't fit the device's memory (", 0), 0u) << mesh.notice();
  EXPECT_NE(mesh.notice().find("): the host computes"), std::string::npos) << mesh.notice();
  expect_equal(mesh, expected);
}

TEST(FullDevice, lets_the_host_enumerate) {
  if (!have_device) GTEST_SKIP() << "there is no device";
  const InputMesh input = holed_grid(70);
  const Mesh expected = encode(input, 100);
  const Mesh mesh = encode(input, 100);
  EXPECT_TRUE(mesh.on_device());
  expected.simplices(all_tables);
  const FullDevice full(16 * mebi);
  expect_equal(mesh, expected);
  EXPECT_TRUE(mesh.on_device());
  EXPECT_EQ(mesh.notice().rfind("the mesh's edges don't fit the device's memory (", 0), 0u) << mesh.notice();
}

TEST(FullDevice, lets_the_host_find_what_triangles_lie_over) {
  if (!have_device) GTEST_SKIP() << "there is no device";
  const InputMesh input = holed_grid(70);  // two million triangles
  const Mesh expected = encode(input, 100);
  const Mesh mesh = encode(input, 100);
  mesh.simplices<WorkerMemory>({Enumeration::triangles, true, true, true, false});
  EXPECT_EQ(mesh.notice(), "");
  expected.simplices(all_tables);
  const FullDevice full(2 * mebi);
  const auto found = mesh.simplices({Enumeration::triangles}), wanted = expected.simplices({Enumeration::triangles});
  ASSERT_EQ(found.triangle_edge.extent(0), wanted.triangle_edge.extent(0));
  for (Id f = 0; f < mesh.known_triangles(); ++f) ASSERT_EQ(found.triangle_edge(f), wanted.triangle_edge(f)) << f;
  EXPECT_EQ(mesh.notice().rfind("the mesh's edges that its triangles lie over don't fit the device's memory (", 0), 0u)
      << mesh.notice();
}

}  // namespace gale::test
