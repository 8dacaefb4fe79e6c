#include <gale/algorithms/excerpt/wall_rows.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

/// Puts edges, with the third vertices of triangles that they are paired with, into a table.
ToldEdges told_there(const std::vector<ToldEdge>& edges, Offset first_number) {
  if (edges.empty()) return {};
  const WorkerSpace space;
  const auto from = in_memory<WorkerMemory>(edges);
  const Offset count = from.extent(0);
  const ToldEdges told{IdTable("GALE::told_thirds", space, count), first_number};
  parallel_for(
      "GALE::told_edges", space, count, KOKKOS_LAMBDA(Offset i) {
        const ToldEdge edge = from(i);
        told.thirds.set(pair_key(edge.high, edge.low), edge.third);
      });
  space.fence();
  return told;
}

}  // namespace

WallRows wall_rows(const DiscreteGradient& gradient) {
  const Mesh& mesh = gradient.mesh();
  return {EdgesInKernels(gradient),
          {},
          {gradient.order().keys_in<WorkerMemory>().data(), mesh.vertices()},
          {mesh.vertices_in_input<WorkerMemory>(), mesh.vertices()}};
}

WiderRows::WiderRows(const WiderGradient& wider)
    : keys_(*wider.simplices()), keys_there_(keys_), rows_(wall_rows(wider.part())) {
  rows_.told = told_there(wider.told_edges(), rows_.own.count);
  rows_.keys = keys_there_.keys();
  rows_.names = keys_there_.names();
}

}  // namespace gale::detail
