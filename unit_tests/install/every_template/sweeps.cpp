#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
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
  const gale::Graph<Memory> graph = gale::graph_of(space, mesh, Relation::VT);
  expect(graph.row_map.extent(0) == vertices + 1 && graph.entries.extent(0) == 4 * tetrahedra, "a graph");
}

}  // namespace

void use_sweeps() {
  const gale::Mesh mesh = two_tetrahedra();
  sweep_in(Kokkos::DefaultExecutionSpace(), mesh);
  sweep_in(Kokkos::DefaultHostExecutionSpace(), mesh);
  const Kokkos::RangePolicy<gale::WorkerSpace> policy(0, 1);
  expect(gale::overlapping(policy).end() == 1, "a policy");

  const int values[vertices] = {0, 1, 2, 3, 4};
  const gale::VertexOrder order(mesh, values, vertices);
  expect(gale::find_critical_points(gale::WorkerSpace(), order).counts[0] == 1, "one minimum");
  expect(gale::find_discrete_gradient(gale::WorkerSpace(), order).critical().vertices.size() == 1,
         "one critical vertex");
}

}  // namespace every_template
