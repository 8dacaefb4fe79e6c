#include <algorithm>

#include <gale/algorithms/excerpt/wider_simplices.hpp>
#include <gale/base/hash_table.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>

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
  name_others();
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
  const auto& received = reached.vertices.entries;
  const Offset count = reached.vertices.count();
  vertex_of_.resize(count);
  parallel_for("GALE::reached_vertices", HostExecutionSpace(), count,
               [&](Offset i) { vertex_of_[i] = mesh_.vertex_of(received(i).id); });
  for (Offset i = 0; i < count; ++i) {
    if (vertex_of_[i] == no_id) beyond_.push_back(received(i));
  }
  const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
  parallel_sort("GALE::sort_reached", beyond_.begin(), beyond_.end(), by_id);
  beyond_.erase(std::unique(beyond_.begin(), beyond_.end(), [](const auto& a, const auto& b) { return a.id == b.id; }),
                beyond_.end());
  const OtherIds internal = mesh_.vertices_of_input();
  parallel_for("GALE::reached_vertices", HostExecutionSpace(), count, [&](Offset i) {
    const auto at = std::lower_bound(beyond_.begin(), beyond_.end(), received(i), by_id);
    vertex_of_[i] =
        vertex_of_[i] == no_id ? own_vertices_ + static_cast<Id>(at - beyond_.begin()) : internal[vertex_of_[i]];
  });
}

/// Finds which of the cells this rank has, and numbers the rest; their vertices are numbered.
void WiderSimplices::number_cells(const Reached& reached, const PathSimplices& cells) {
  cell_begin_ = reached.cells.begin;
  HashTable<Id> others;
  for_each_received(reached.cells, [&](int rank, const ReceivedCell& cell) {
    if (exchange_.cell_of(cell.id) != no_id) {
      cell_of_.push_back(cells.local(cell.id));
      return;
    }
    const auto [number, is_new] = others.insert(static_cast<std::uint64_t>(cell.id));
    if (is_new) {
      number = own_cells_ + static_cast<Id>(cell_ids_.size());
      cell_ids_.push_back(cell.id);
      std::array<Id, 4> corners = cell.corners;
      for (Id& corner : corners) corner = vertex(rank, corner);
      cell_corners_.push_back(corners);
    }
    cell_of_.push_back(number);
  });
}

void WiderSimplices::name_others() {
  const Offset count = static_cast<Offset>(beyond_.size());
  own_before_.resize(count);
  for_parts("GALE::own_before", count, threads_for(count), [&](int, Offset begin, Offset end) {
    Id at = 0;
    for (Offset i = begin; i < end; ++i) {
      stop_if_asked_at(i);
      const auto is_before = [&](Id input) { return mesh_.vertex_id(input) < beyond_[i].id; };
      at = i == begin ? bisect(at, own_vertices_, is_before) : gallop(at, own_vertices_, is_before);
      own_before_[i] = at;
    }
  });
  const auto place = [&](auto at) { return static_cast<Id>(at - own_before_.begin()); };
  const auto first = std::upper_bound(own_before_.begin(), own_before_.end(), 0);
  names_ = {vertex_input_,
            own_vertices_,
            own_before_.data(),
            {place(first), place(std::lower_bound(first, own_before_.end(), own_vertices_))}};
}

}  // namespace gale::detail
