#pragma once

#include <gale/mesh/mesh.hpp>
#include <gale/runtime/explicit/global_graph.hpp>

namespace gale::detail {

/// The links of all vertices, on the host.
struct GlobalLinks {
  Array<std::uint8_t, HostMemory> places;
  int width = 1;

  /// `vt`: the rows of VT, of which the offsets are read.
  LinkRows rows(const Rows& vt) const { return {0, vt.count, vt.offsets, places.data(), width}; }
};

/// Looks the vertices of each tetrahedron up in the VV rows of the others, on all our threads.
GlobalLinks global_links(const Mesh& mesh, const GlobalRows& vt, const GlobalRows& vv);

}  // namespace gale::detail
