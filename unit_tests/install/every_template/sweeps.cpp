#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/team.hpp>
#include <gale/runtime/device_sweep.hpp>
#include <gale/runtime/graph_of.hpp>

#include "parts.hpp"

namespace every_template {

namespace {

using gale::Id;
using gale::Relation;

/// Writes down how many neighbours each vertex has.
template <class Memory>
struct CountRow {
  Kokkos::View<Id*, Memory> sizes;
  KOKKOS_FUNCTION void operator()(Id vertex, const gale::Row& row) const { sizes(vertex) = row.size(); }
};
template <class Memory>
struct CountRows {
  Kokkos::View<Id*, Memory> sizes;

  template <class Team, class SegmentRows>
  KOKKOS_FUNCTION void operator()(const Team&, const SegmentRows& segment) const {
    for (const Id vertex : segment.interval(0)) sizes(vertex) = segment[Relation::VV][vertex].size();
  }
};

/// Uses all that a team may be used for, in bytes of its scratch memory, and counts segments.
template <class Memory>
struct UseTeam {
  static constexpr int words = 8;
  Kokkos::View<std::uint32_t*, Memory> counts;

  template <class Team, class SegmentRows>
  KOKKOS_FUNCTION void operator()(const Team& team, const SegmentRows&) const {
    namespace steps = gale::team;
    auto* const shared = reinterpret_cast<std::uint32_t*>(steps::scratch<0>(team, (words + 1) * sizeof(std::uint32_t)));
    steps::for_all(team, words, [&](int i) { shared[i] = 1; });
    steps::exclusive_scan(team, words, shared);
    steps::for_all_loaded(
        team, words, [&](int i) { return shared[i]; }, [&](int i, std::uint32_t sum) { shared[i] = sum - i; });
    steps::barrier(team);
    steps::for_warps(team, words, [&](int i) {
      steps::for_lanes(team, 1,
                       [&](int) { steps::reconverge_after([&] { steps::add(team, &shared[i], std::uint32_t(1)); }); });
      steps::warp_barrier(team);
      steps::once_per_warp(team, [&] { steps::raise(team, &shared[i], std::uint32_t(2)); });
    });
    steps::barrier(team);
    steps::once(team, [&] {
      steps::set_bits(team, &shared[0], 4);
      steps::exchange_if(team, &shared[0], std::uint32_t(6), std::uint32_t(1));
      if (steps::warp(team) < steps::warps(team)) gale::atomic_add(&counts(0), shared[0]);
    });
  }
};

/// Counts in every way, by pairs of a row and an entry.
template <class T, class Memory>
struct UseAtomics {
  Kokkos::View<T*, Memory> values;
  KOKKOS_FUNCTION void operator()(Id vertex, const gale::Row& row) const {
    gale::atomic_add(&values(0), row.size());
    gale::atomic_max(&values(1), vertex);
    gale::atomic_min(&values(2), vertex);
    if (gale::atomic_exchange(&values(3), 7) != 7) gale::atomic_write(&values(4), gale::atomic_read(&values(3)));
    gale::atomic_compare_exchange(&values(5), 0, 3);
  }
};

template <class T, class Memory, class Space>
void use_atomics(const Space& space, const gale::Mesh& mesh) {
  const Kokkos::View<T*, Memory> values("values", 6);
  gale::for_each_row(space, mesh, Relation::VV, UseAtomics<T, Memory>{values});
  const auto found = Kokkos::create_mirror_view_and_copy(gale::HostMemory(), values);
  const int expected[6] = {2 * edges, vertices - 1, 0, 7, 7, 3};
  for (int i = 0; i < 6; ++i) expect(found(i) == static_cast<T>(expected[i]), "atomics");
}

template <class Sizes>
void expect_sizes(const Sizes& sizes) {
  const auto host = Kokkos::create_mirror_view_and_copy(gale::HostMemory(), sizes);
  Id sum = 0;
  for (int v = 0; v < vertices; ++v) sum += host(v);
  expect(sum == 2 * edges, "the rows of a sweep");
}

template <class Space>
void sweep_in(const Space& space, const gale::Mesh& mesh) {
  using Memory = gale::detail::MemoryOfSweep<Space>;
  const Kokkos::View<Id*, Memory> by_row("by_row", vertices), by_segment("by_segment", vertices);
  gale::for_each_row(space, mesh, Relation::VV, CountRow<Memory>{by_row});
  gale::for_each_segment(space, mesh, Relation::VV | Relation::EF, CountRows<Memory>{by_segment});
  expect_sizes(by_row);
  expect_sizes(by_segment);
  const Kokkos::View<std::uint32_t*, Memory> segments("segments", 1);
  gale::DeviceSweepOptions with_scratch;
  with_scratch.team_scratch = 64;
  gale::for_each_segment(space, mesh, Relation::VV, UseTeam<Memory>{segments}, with_scratch);
  expect(Kokkos::create_mirror_view_and_copy(gale::HostMemory(), segments)(0) == std::uint32_t(mesh.segments()),
         "the segments of a sweep");
  use_atomics<int, Memory>(space, mesh);
  use_atomics<unsigned long long, Memory>(space, mesh);
  use_atomics<float, Memory>(space, mesh);
  use_atomics<double, Memory>(space, mesh);
  const gale::Csr<const gale::Id, Memory> graph = gale::graph_of(space, mesh, Relation::VT);
  expect(graph.offsets.extent(0) == vertices + 1 && graph.entries.extent(0) == 4 * tetrahedra, "a graph");
  const gale::Csr<const gale::Id, gale::HostMemory> rows = gale::relation_of(mesh, Relation::TV, gale::Ids::input);
  const gale::Span<const gale::Id> row = rows.row(0);
  expect(row.size() == 4 && row[0] < row[3], "a row");
}

}  // namespace

void use_sweeps() {
  const gale::Mesh mesh = two_tetrahedra();
  sweep_in(Kokkos::DefaultExecutionSpace(), mesh);
  sweep_in(Kokkos::DefaultHostExecutionSpace(), mesh);
#if defined(KOKKOS_ENABLE_SERIAL)
  sweep_in(Kokkos::Serial(), mesh);
#endif
  sweep_in(gale::HostThreads(), mesh);
  const Kokkos::RangePolicy<gale::WorkerSpace> policy(0, 1);
  expect(gale::overlapping(policy).end() == 1, "a policy");

  const int values[vertices] = {0, 1, 2, 3, 4};
  const gale::VertexOrder order(mesh, values, vertices);
  expect(gale::find_critical_points(gale::WorkerSpace(), order).counts[0] == 1, "one minimum");
  expect(gale::find_discrete_gradient(gale::WorkerSpace(), order).critical().vertices.size() == 1,
         "one critical vertex");
}

}  // namespace every_template
