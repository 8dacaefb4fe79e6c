#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/exchange/global_index.hpp>

// Small meshes, on one rank, of some simplices of a mesh that lies on several.

namespace gale::detail {

/// An excerpt's mesh knows its simplices by the ids that all ranks have for them, and asks nobody.
class ExcerptExchange final : public Exchange {
 public:
  ExcerptExchange(const GlobalIds& vertices, const GlobalIds& cells) : vertices_(vertices), cells_(cells) {}

  GlobalId vertices() const override { return vertices_.count(); }
  GlobalId cells() const override { return cells_.count(); }
  GlobalId vertex_id(Id vertex) const override { return vertices_[vertex]; }
  GlobalId cell_id(Id cell) const override { return cells_[cell]; }
  Id vertex_of(GlobalId id) const override { return vertices_.find(id); }
  Id cell_of(GlobalId id) const override { return cells_.find(id); }

 private:
  GlobalIndex vertices_, cells_;
};

/// A mesh of vertices with these ids, ascending, and of cells of these, whose corners are places among the vertices.
/// GALE's ids of vertices are these places, too. Segments have `capacity` vertices, 1 or more, the last one the rest:
/// where nobody asks for relations, one for all is made soonest.
template <int corners>
Mesh excerpt_mesh(const GlobalIds& vertex_ids, const GlobalIds& cell_ids,
                  const CellCorners<corners, Id, HostMemory>& cells, Id capacity = default_capacity) {
  const Id vertices = static_cast<Id>(vertex_ids.extent(0));
  const Id segments = vertices / capacity + (vertices % capacity > 0);
  Segmentation segmentation;
  segmentation.vertex_input = iota("GALE::excerpt_vertices", HostExecutionSpace(), vertices);
  const auto begin = allocate<Array<Id, HostMemory>>("GALE::excerpt_segments", segments + Offset(1));
  for (Id s = 0; s <= segments; ++s) begin(s) = s < segments ? s * capacity : vertices;
  segmentation.vertex_begin = begin;
  segmentation.owned_segments = segments;
  return Mesh(cells, segmentation, std::make_shared<ExcerptExchange>(vertex_ids, cell_ids));
}

/// The order of its vertices by value(vertex), a number of 64 bits without sign, then by id.
template <class Value>
VertexOrder excerpt_order(const Mesh& mesh, const Value& value) {
  const Id count = mesh.vertices();
  const auto keys = allocate<Array<std::uint64_t, HostMemory>>("GALE::excerpt_keys", count);
  parallel_for("GALE::excerpt_keys", HostExecutionSpace(), count,
               [&](Offset v) { keys(v) = value(static_cast<Id>(v)); });
  const auto sorted = stable_sort_places(HostExecutionSpace(), "GALE::excerpt_order", keys);
  std::vector<Id> rank(count);
  parallel_for("GALE::excerpt_ranks", HostExecutionSpace(), count,
               [&](Offset i) { rank[sorted(i)] = static_cast<Id>(i); });
  return VertexOrder(mesh, rank.data(), rank.size());
}

}  // namespace gale::detail
