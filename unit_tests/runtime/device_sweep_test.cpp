#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/runtime/device_sweep.hpp>
#include <gale/runtime/graph_of.hpp>

#include "support/arrays.hpp"
#include "support/brute_force.hpp"
#include "support/every_mesh.hpp"
#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

using Memory = detail::MemoryOfSweep<WorkerSpace>;

constexpr int columns = relation_count + 1;  // the last for links

/// Tells rows apart by their entries and their order.
KOKKOS_INLINE_FUNCTION std::uint64_t mix(std::uint64_t sum, std::uint64_t entry) {
  return (sum ^ (entry + 1)) * 0x9e3779b97f4a7c15u;
}

KOKKOS_INLINE_FUNCTION std::uint64_t sum_of(const Row& row) {
  std::uint64_t sum = row.size();
  for (const Id id : row) sum = mix(sum, id);
  return sum;
}

KOKKOS_INLINE_FUNCTION std::uint64_t sum_of(const LinkRow& link) {
  std::uint64_t sum = link.size();
  for (Id t = 0; t < link.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) sum = mix(sum, link(t, corner));
  }
  return sum;
}

/// Adds the sum of each row to what is there: nothing, if each comes once.
struct AddSums {
  RelationSet wanted;
  Kokkos::View<std::uint64_t**, Memory> sums;  // by column and simplex

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team, const SegmentRowsIn<Memory>& segment) const {
    for (int r = 0; r < relation_count; ++r) {
      const auto relation = static_cast<Relation>(r);
      if (!wanted.has(relation)) continue;
      const Rows rows = segment[relation];
      const Interval simplices = segment.interval(relation);
      Kokkos::parallel_for(Kokkos::TeamVectorRange(team, simplices.size()), [&](int i) {
        const Id simplex = simplices.first + i;
        sums(r, simplex) += sum_of(rows[simplex]);
      });
    }
    if (!wanted.has_links()) return;
    const LinkRows links = segment.links();
    Kokkos::parallel_for(Kokkos::TeamVectorRange(team, links.count),
                         [&](int i) { sums(relation_count, links.first + i) += sum_of(links[links.first + i]); });
  }
};

struct AddRow {
  Kokkos::View<std::uint64_t*, Memory> sums;
  KOKKOS_FUNCTION void operator()(Id simplex, const Row& row) const { sums(simplex) += sum_of(row); }
};

std::uint64_t sum_of(const std::vector<Id>& row) { return sum_of(Row{row.data(), static_cast<Id>(row.size())}); }

std::uint64_t sum_of(const std::vector<std::array<Id, 3>>& link) {
  return sum_of(LinkRow{link.data(), static_cast<Id>(link.size()), 4});
}

template <class Table, class Sums>
void expect_sums(const Table& rows, const Sums& sums, const std::string& name) {
  ASSERT_LE(rows.size(), sums.extent(0));
  for (std::size_t i = 0; i < rows.size(); ++i) ASSERT_EQ(sums(i), sum_of(rows[i])) << name << " of " << i;
}

void expect_sweep(const Mesh& mesh, const ExpectedRows& expected, RelationSet wanted,
                  const DeviceSweepOptions& options) {
  std::size_t most = mesh.vertices();
  for (const Relation relation : members_of(wanted)) most = std::max(most, expected[relation].size());
  const Kokkos::View<std::uint64_t**, Memory> sums("sums", columns, most);
  for_each_segment(WorkerSpace(), mesh, wanted, AddSums{wanted, sums}, options);
  const auto found = Kokkos::create_mirror_view_and_copy(HostMemory(), sums);
  for (const Relation relation : members_of(wanted)) {
    expect_sums(expected[relation], Kokkos::subview(found, static_cast<int>(relation), Kokkos::ALL()),
                name_of(relation));
  }
  if (wanted.has_links()) expect_sums(expected.link, Kokkos::subview(found, relation_count, Kokkos::ALL()), "link");
}

DeviceSweepOptions with_memory(std::size_t bytes, int batches) {
  DeviceSweepOptions options;
  options.memory = bytes;
  options.batches = batches;
  return options;
}

}  // namespace

class DeviceSweepOf : public EveryMesh {};

TEST_P(DeviceSweepOf, small_meshes_have_the_rows_of_brute_force) {
  const Mesh mesh = encode(input(), segmentation());
  const ExpectedRows expected(input(), brute_force_of(mesh_name()), mesh, (all_relations | link_form));
  expect_sweep(mesh, expected, all_relations | link_form, {});
  expect_sweep(mesh, expected, all_relations | link_form, with_memory(1, 2));  // too little for most segments
  expect_sweep(mesh, expected, star_relations, with_memory(1 << 16, 3));
  for (const Relation relation : members_of(all_relations)) {
    const Kokkos::View<std::uint64_t*, Memory> sums("sums", expected[relation].size());
    for (const int threads : {0, 1, 33, 256}) {
      DeviceSweepOptions options = with_memory(threads % 2, threads % 3);  // where it is 1 byte, batches lack room
      options.threads_per_team = threads;
      Kokkos::deep_copy(sums, 0);
      for_each_row(WorkerSpace(), mesh, relation, AddRow{sums}, options);
      expect_sums(expected[relation], Kokkos::create_mirror_view_and_copy(HostMemory(), sums), name_of(relation));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, DeviceSweepOf,
                         testing::Combine(testing::Values("the_papers", "two_sharing_an_edge", "isolated_vertices",
                                                          "several_components", "seven_on_one_triangle",
                                                          "random_tetrahedra", "cone_over_sphere_200", "thick_shell"),
                                          testing::ValuesIn(segmentation_names())),
                         mesh_and_segmentation);

TEST(DeviceSweep, goes_through_many_batches) {
  const InputMesh input = holed_grid(20);
  const Mesh mesh = encode(input, 30);
  const ExpectedRows expected(input, BruteForce(input), mesh, star_relations | Relation::EF);
  for (const std::size_t memory : {std::size_t(1), std::size_t(1) << 14, std::size_t(1) << 18, std::size_t(0)}) {
    for (const int batches : {0, 1, 2, 5})
      expect_sweep(mesh, expected, star_relations | Relation::EF, with_memory(memory, batches));
  }
}

TEST(DeviceSweep, goes_through_large_segments_between_small_ones) {
  const InputMesh input = holed_grid(18);
  const Mesh mesh = encode(input, large_and_small(input));
  const RelationSet relations = all_relations | link_form;
  const ExpectedRows expected(input, BruteForce(input), mesh, relations);
  for (const std::size_t memory : {std::size_t(1), std::size_t(1) << 18, std::size_t(0)})
    expect_sweep(mesh, expected, relations, with_memory(memory, 2));
}

TEST(DeviceSweep, leaves_what_its_functor_wrote_for_any_reader) {
  const InputMesh input = holed_grid(12);
  const Mesh mesh = encode(input, 100);
  const ExpectedRows expected(input, BruteForce(input), mesh, Relation::VV);
  const auto graph = graph_of(WorkerSpace(), mesh, Relation::VV);
  const auto offsets = to_vector(graph.offsets);
  const auto entries = to_vector(graph.entries);
  ASSERT_EQ(offsets.size(), expected.vv.size() + 1);
  for (std::size_t v = 0; v < expected.vv.size(); ++v) {
    const std::vector<Id> row(entries.begin() + offsets[v], entries.begin() + offsets[v + 1]);
    ASSERT_EQ(row, expected.vv[v]) << v;
  }
}

TEST(DeviceSweep, refuses_what_it_cannot_do) {
  const Mesh mesh = encode(mesh_named("the_papers"), 100);
  const auto sweep = [&](RelationSet relations, const DeviceSweepOptions& options) {
    return message_of([&] { for_each_segment(WorkerSpace(), mesh, relations, AddSums{relations, {}}, options); });
  };
  EXPECT_EQ(sweep({}, {}), "a sweep needs a relation to read");
  EXPECT_EQ(sweep(Relation::VV, with_memory(0, -1)), "batches must be at least 1, not -1");
  DeviceSweepOptions options;
  options.threads_per_team = -5;
  EXPECT_EQ(sweep(Relation::VV, options), "threads per team must be at least 1, not -5");
  options = {};
  options.threads_per_segment = -2;
  EXPECT_EQ(sweep(Relation::VV, options), "threads per segment must be at least 1, not -2");
}

}  // namespace gale::test
