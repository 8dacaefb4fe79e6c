#pragma once

#include <cstdint>
#include <vector>

#include <gale/algorithms/merge_tree/gathered_graph.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sorted_keys.hpp>

namespace gale::detail {

/// Finds where this rank's vertices stand among some others, which may be anywhere, by comparing keys alone. For code
/// that runs on `Memory`.
template <class Memory>
class KeysHere {
 public:
  /// `vertices` ascend in the order, none twice. A rank without vertices asks for no place.
  KeysHere(const VertexOrder& order, const std::vector<TreeVertex>& vertices)
      : KeysHere(order, vertices, allocate<Array<char, HostMemory>>("GALE::are_here", vertices.size())) {}

  struct Place {
    std::int64_t first;
    bool is_one;
  };

  /// The first of the vertices that isn't below the one with this key, and whether it is that one.
  KOKKOS_FUNCTION Place place_of(std::uint64_t key) const {
    const auto range = keys_.around(key);
    const std::int64_t end = bisect(range.first, range.last, [&](std::int64_t at) { return keys_[at] <= key; });
    const bool is_one = end > 0 && keys_[end - 1] == key && are_here_(end - 1) != 0;
    return {is_one ? end - 1 : end, is_one};
  }

 private:
  KeysHere(const VertexOrder& order, const std::vector<TreeVertex>& vertices, const Array<char, HostMemory>& are_here)
      : keys_(keys_of(order, vertices, are_here)), are_here_(in_memory<Memory>(are_here)) {}

  /// The key of each vertex; of one that isn't here, of the first here that is above it.
  static std::vector<std::uint64_t> keys_of(const VertexOrder& order, const std::vector<TreeVertex>& vertices,
                                            const Array<char, HostMemory>& are_here) {
    const Mesh& mesh = order.mesh();
    if (mesh.vertices() == 0) return {};
    const OtherIds input = mesh.vertices_in_input(), internal = mesh.vertices_of_input();
    // Short keys have the input id, which ascends with the global one; others are places in the order.
    std::vector<Id> in_order(order.has_short_values() ? 0 : mesh.vertices());
    if (!in_order.empty()) {
      const std::uint64_t* const keys = order.keys();
      parallel_for("GALE::vertices_in_order", HostExecutionSpace(), in_order.size(),
                   [&](Offset v) { in_order[keys[v]] = static_cast<Id>(v); });
    }
    const auto id_of = [&](Id vertex) { return mesh.vertex_id(input[vertex]); };
    std::vector<Id> vertex_here(vertices.size());  // any one for a vertex that isn't
    parallel_for("GALE::vertices_here", HostExecutionSpace(), vertices.size(), [&](Offset i) {
      const Id here = mesh.vertex_of(vertices[i].id);
      are_here(i) = here != no_id;
      vertex_here[i] = here == no_id ? 0 : internal[here];
    });
    std::vector<std::uint64_t> keys_here = order.keys_of(vertex_here);
    parallel_for("GALE::keys_here", HostExecutionSpace(), vertices.size(), [&](Offset i) {
      const TreeVertex& one = vertices[i];
      if (are_here(i) != 0) return;
      if (order.has_short_values()) {
        const Id above = bisect(Id(0), mesh.vertices(), [&](Id at) { return mesh.vertex_id(at) < one.id; });
        keys_here[i] = one.value << 32 | static_cast<std::uint32_t>(above);
      } else {
        keys_here[i] = bisect(Id(0), mesh.vertices(), [&](Id place) {
          const Id vertex = in_order[place];
          return TreeVertex{id_of(vertex), order.value_key(vertex), {}} < one;
        });
      }
    });
    return keys_here;
  }

  SortedKeys<Memory> keys_;
  Array<const char, Memory> are_here_;
};

}  // namespace gale::detail
