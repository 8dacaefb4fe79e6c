#include <gale/algorithms/numbers/numbering_sweep.hpp>
#include <gale/algorithms/order/whole_mesh.hpp>
#include <gale/algorithms/simplex_numbers.hpp>

namespace gale {

namespace {

/// Turns the counts of so many vertices into the number of each vertex's first simplex.
const Array<Id, HostMemory>& scan(const char* name, Id vertices, const Array<Id, HostMemory>& counts) {
  const auto count = [&](Offset i) { return counts(i); };
  require_ids(name, reduce_sum("GALE::sum_simplices", HostExecutionSpace(), vertices, count));
  exclusive_scan("GALE::number_first_simplices", HostExecutionSpace(), vertices, counts, count);
  return counts;
}

}  // namespace

SimplexNumbers number_simplices(const Mesh& mesh, const NamedSimplices& named, const ComputeOptions& options,
                                Computed* computed) {
  detail::Computing computing(mesh, options, computed);
  return number_simplices(computing.structure(simplex_numbers_relations), named, options);
}

SimplexNumbers number_simplices(Structure& structure, const NamedSimplices& named, const SweepOptions& options) {
  const Mesh& mesh = structure.mesh();
  detail::require_whole_mesh("the numbers of simplices", mesh);
  const ThreadLimit limit(options.threads);
  detail::NumberingSweep found(structure, named, options);
  return {found.edges().take_numbers(scan("edges", mesh.vertices(), found.edge_counts())),
          found.triangles().take_numbers(scan("triangles", mesh.vertices(), found.triangle_counts())),
          found.on_surface()};
}

}  // namespace gale
