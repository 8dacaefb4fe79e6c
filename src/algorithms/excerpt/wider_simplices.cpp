#include <algorithm>
#include <unordered_map>

#include <gale/algorithms/excerpt/wider_simplices.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

WiderSimplices::WiderSimplices(const DiscreteGradient& gradient, const PathSimplices& cells, const Reached& reached)
    : mesh_(gradient.mesh()),
      order_(gradient.order()),
      exchange_(mesh_.exchange()),
      corners_(mesh_.cell_reader()),
      vertex_input_(mesh_.vertices_in_input()),
      cell_input_(mesh_.cells_in_input()),
      own_vertices_(mesh_.vertices()),
      own_cells_(mesh_.cells()) {
  number_vertices(reached);
  number_cells(reached, cells);
  name_vertices();
}

GlobalId WiderSimplices::vertex_id(Id vertex) const {
  return vertex < own_vertices_ ? exchange_.vertex_id(vertex_input_[vertex]) : beyond_[vertex - own_vertices_].id;
}

GlobalId WiderSimplices::cell_id(Id cell) const {
  return is_own_cell(cell) ? exchange_.cell_id(cell_input_[cell]) : cell_ids_[cell - own_cells_];
}

std::uint64_t WiderSimplices::value(Id vertex) const {
  return vertex < own_vertices_ ? order_.value_key(vertex) : beyond_[vertex - own_vertices_].value;
}

/// Finds which of the vertices that were received this rank has, and numbers the rest.
void WiderSimplices::number_vertices(const Reached& reached) {
  vertex_begin_ = reached.vertices.begin;
  for_each_received(reached.vertices, [&](int, const ReachedVertex& vertex) {
    if (mesh_.vertex_of(vertex.id) == no_id) beyond_.push_back(vertex);
  });
  const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
  std::sort(beyond_.begin(), beyond_.end(), by_id);
  beyond_.erase(std::unique(beyond_.begin(), beyond_.end(), [](const auto& a, const auto& b) { return a.id == b.id; }),
                beyond_.end());
  for_each_received(reached.vertices, [&](int, const ReachedVertex& vertex) {
    const Id here = mesh_.vertex_of(vertex.id);
    const auto at = std::lower_bound(beyond_.begin(), beyond_.end(), vertex, by_id);
    vertex_of_.push_back(here == no_id ? own_vertices_ + static_cast<Id>(at - beyond_.begin())
                                       : mesh_.vertices_of_input()[here]);
  });
}

/// Finds which of the cells this rank has, and numbers the rest; their vertices are numbered.
void WiderSimplices::number_cells(const Reached& reached, const PathSimplices& cells) {
  cell_begin_ = reached.cells.begin;
  std::unordered_map<GlobalId, Id> others;
  for_each_received(reached.cells, [&](int rank, const ReachedCell& cell) {
    if (exchange_.cell_of(cell.id) != no_id) {
      cell_of_.push_back(cells.local(cell.id));
      return;
    }
    const auto [at, is_new] = others.try_emplace(cell.id, own_cells_ + static_cast<Id>(cell_ids_.size()));
    cell_of_.push_back(at->second);
    if (!is_new) return;
    cell_ids_.push_back(cell.id);
    std::array<Id, 4> corners = cell.corners;
    for (Id& corner : corners) corner = vertex(rank, corner);
    cell_corners_.push_back(corners);
  });
}

/// Names a vertex by how many have a lower global id, with which input ids ascend: an own one by its input id and the
/// others before it, another by its place among these and the own ones before it.
void WiderSimplices::name_vertices() {
  const auto names = allocate<Array<Id, HostMemory>>("GALE::wider_names", own_vertices_ + beyond_.size());
  std::vector<Id> own_before(beyond_.size());
  for (Id other = 0; other < static_cast<Id>(beyond_.size()); ++other) {
    own_before[other] =
        bisect(Id(0), own_vertices_, [&](Id input) { return mesh_.vertex_id(input) < beyond_[other].id; });
    names(own_vertices_ + other) = own_before[other] + other;
  }
  const OtherIds internal = mesh_.vertices_of_input();
  for_parts("GALE::wider_names", own_vertices_, threads_for(own_vertices_), [&](int, Offset begin, Offset end) {
    auto others = static_cast<Id>(std::upper_bound(own_before.begin(), own_before.end(), begin) - own_before.begin());
    for (Id input = static_cast<Id>(begin); input < end; ++input) {
      while (others < static_cast<Id>(own_before.size()) && own_before[others] <= input) ++others;
      names(internal[input]) = input + others;
    }
  });
  names_ = names;
}

}  // namespace gale::detail
