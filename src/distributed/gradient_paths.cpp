#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/distributed/global_index.hpp>
#include <gale/distributed/gradient_paths.hpp>

namespace gale::detail {

PathSimplices falling_simplices(const DistributedGradient& gradient) {
  const Mesh& local = gradient.mesh.local();
  const Id* const input = local.vertex_input().data();
  const Id* const internal = local.vertex_internal().data();
  const auto ids = gradient.mesh.vertex_ids();
  const auto owners = gradient.mesh.owners();
  const DistributedMesh mesh = gradient.mesh;
  return {&gradient.local.store().vertex_successors(), &gradient.local.critical().vertices,
          [=](Id vertex) { return ids(input[vertex]); }, [=](GlobalId id) { return internal[mesh.vertex_of(id)]; },
          [=](Id vertex) { return owners(input[vertex]); }};
}

PathSimplices rising_simplices(const DistributedGradient& gradient) {
  const Mesh& local = gradient.mesh.local();
  const Id* const input = local.tetrahedron_input().data();
  const Id* const vertex_input = local.vertex_input().data();
  const std::uint64_t* const keys = gradient.local.order().keys();
  const auto ids = gradient.mesh.tetrahedron_ids();
  const auto owners = gradient.mesh.owners();
  const auto tetrahedra = local.encoded().tetrahedra;
  const GlobalIndex index(ids);
  const auto internal = allocate<Array<Id, HostMemory>>("GALE::tetrahedron_internal", ids.extent(0));
  parallel_for("GALE::tetrahedron_internal", HostExecutionSpace(), internal.extent(0),
               [&](Offset t) { internal(input[t]) = static_cast<Id>(t); });
  return {&gradient.local.store().tetrahedron_successors(), &gradient.local.critical().tetrahedra,
          [=](Id t) { return ids(input[t]); }, [=](GlobalId id) { return internal(index.find(id)); },
          [=](Id t) {
            Id highest = tetrahedra(t, 0);
            for (int corner = 1; corner < 4; ++corner) {
              if (keys[tetrahedra(t, corner)] > keys[highest]) highest = tetrahedra(t, corner);
            }
            return owners(vertex_input[highest]);
          }};
}

}  // namespace gale::detail
