#include <gale/base/transfer.hpp>
#include <gale/mesh/input_numbers.hpp>
#include <gale/mesh/number_by_sorting.hpp>
#include <gale/mesh/number_by_vertex.hpp>

namespace gale {

namespace {

template <class Space>
InputNumbers numbers_in(const Space& space, const Mesh& mesh, bool edges, bool triangles) {
  using Memory = MemoryOf<Space>;
  SimplexNeeds needs;
  needs.upto = triangles ? Enumeration::triangles : Enumeration::edges;
  needs.triangle_edge = false;
  const auto simplices = mesh.simplices<Memory>(needs);
  const detail::VertexInput<Memory> input = mesh.vertex_input<Memory>();
  if constexpr (is_device<Space>) {
    InputNumbers numbers;
    if (edges) numbers.edges = on_host(detail::sort_edges(space, simplices, input));
    if (triangles) numbers.triangles = on_host(detail::sort_triangles(space, simplices, input));
    return numbers;
  } else {
    return detail::number_by_vertex(simplices, input, edges, triangles);
  }
}

InputNumbers numbers_of(const Mesh& mesh, bool edges, bool triangles) {
  return in_worker_or_host_space(mesh, [&](const auto& space) { return numbers_in(space, mesh, edges, triangles); });
}

}  // namespace

Array<const Id, HostMemory> input_numbers(const Mesh& mesh, int dimension) {
  if (dimension == 0) return mesh.vertex_input();
  if (dimension == 3) return mesh.tetrahedron_input();
  return dimension == 1 ? numbers_of(mesh, true, false).edges : numbers_of(mesh, false, true).triangles;
}

InputNumbers input_numbers(const Mesh& mesh) { return numbers_of(mesh, true, true); }

}  // namespace gale
