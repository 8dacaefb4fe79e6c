#include <atomic>

#include <gtest/gtest.h>

#include <gale/runtime/make_structure.hpp>

#include "runtime/ways.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

/// Where Kokkos has Serial alone it doesn't count references atomically: without help, the count would be wrong here,
/// and the View gone or leaked.
TEST(Bodies, may_copy_views_and_take_subviews_on_many_threads) {
  const Mesh mesh = encode(mesh_named("holed_grid_9"), 7);
  for (const NamedWay& way : ways()) {
    SCOPED_TRACE(way.name);
    const auto structure = way.make(mesh, Relation::VV);
    const Kokkos::View<int*, HostMemory> values("test_values", 64);
    Kokkos::deep_copy(values, 1);
    const int before = values.use_count();
    std::atomic<std::int64_t> sum{0};
    SweepOptions options;
    options.threads = 8;
    structure->for_each_segment(Relation::VV, options, [&](int, const SegmentRows&) {
      for (int i = 0; i < 200; ++i) {
        const auto copy = values;
        const auto half = Kokkos::subview(copy, std::make_pair(0, 32));
        sum += half(i % 32);
      }
    });
    EXPECT_EQ(sum, 200 * std::int64_t(mesh.segments()));
    EXPECT_EQ(values.use_count(), before);
    EXPECT_EQ(values(63), 1);
  }
}

/// What a mesh makes when it is first asked for lasts, also where that is in a body.
TEST(Bodies, may_ask_a_mesh_for_what_it_makes_at_the_first_request) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, 7), other = encode(input, 7);
  const SimplexNeeds everything{Enumeration::triangles, true, true};
  const auto structure = make_structure(mesh, Relation::VV);
  SweepOptions options;
  options.threads = 4;
  structure->for_each_segment(Relation::VV, options, [&](int, const SegmentRows&) {
    mesh.simplices(everything);
    mesh.vertex_internal();
    mesh.interval_begin(2);
  });
  const auto made = mesh.simplices(everything), expected = other.simplices(everything);
  ASSERT_EQ(made.triangle_apex.extent(0), expected.triangle_apex.extent(0));
  for (std::size_t f = 0; f < expected.triangle_apex.extent(0); ++f) {
    ASSERT_EQ(made.triangle_apex(f), expected.triangle_apex(f));
  }
  for (Id v = 0; v < mesh.vertices(); ++v) ASSERT_EQ(mesh.vertex_internal()(v), other.vertex_internal()(v));
}

}  // namespace gale::test
