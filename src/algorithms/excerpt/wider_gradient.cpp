#include <algorithm>
#include <utility>

#include <gale/algorithms/excerpt/wider_gradient.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/threads.hpp>

namespace gale::detail {

namespace {

/// Own simplices, ascending by `key`, and others: in that order. `places` becomes those of the own ones.
template <class T, class Key>
std::vector<T> merged(const std::vector<T>& own, std::vector<T> others, const Key& key, std::vector<Id>& places) {
  const auto is_less = [&](const T& a, const T& b) { return key(a) < key(b); };
  std::sort(others.begin(), others.end(), is_less);
  std::vector<T> all;
  auto other = others.begin();
  for (const T& simplex : own) {
    for (; other != others.end() && is_less(*other, simplex); ++other) all.push_back(*other);
    places.push_back(static_cast<Id>(all.size()));
    all.push_back(simplex);
  }
  all.insert(all.end(), other, others.end());
  return all;
}

}  // namespace

WiderGradient::WiderGradient(const DiscreteGradient& gradient, std::shared_ptr<const WiderSimplices> simplices,
                             const Reached& reached)
    : gradient_(gradient), simplices_(std::move(simplices)) {
  fill_successors(reached);
  add_edges(reached);
  add_critical(reached);
}

void WiderGradient::fill_successors(const Reached& reached) {
  const auto begin = [](MoreSuccessors& successors, const Mirrored<Id>& own, Id others) {
    successors.own = own;
    successors.beyond.assign(others, DiscreteGradient::elsewhere);
  };
  begin(vertex_successors_, gradient_.store().vertex_successors(), simplices_->vertices() - simplices_->own_vertices());
  begin(cell_successors_, gradient_.store().cell_successors(), simplices_->cells() - simplices_->own_cells());
  for_each_received(reached.vertex_steps, [&](int rank, const auto& step) {
    vertex_successors_.tell(vertex(rank, step[0]), step[1] == no_id ? no_id : vertex(rank, step[1]));
  });
  for_each_received(reached.cell_steps, [&](int rank, const auto& step) {
    cell_successors_.tell(cell(rank, step[0]), step[1] < 0 ? step[1] : cell(rank, step[1]));
  });
  vertex_successors_.sort();
  cell_successors_.sort();
}

void WiderGradient::add_edges(const Reached& reached) {
  const auto& edges = reached.edges;
  told_edges_.resize(edges.count());
  for (int rank = 0; rank + 1 < static_cast<int>(edges.begin.size()); ++rank) {
    const Offset first = edges.begin[rank];
    parallel_for("GALE::told_edges", HostExecutionSpace(), edges.count(rank), [&](Offset i) {
      const auto& [high, low, third] = edges.entries(first + i);
      told_edges_[first + i] = {vertex(rank, high), vertex(rank, low), third < 0 ? third : vertex(rank, third)};
    });
  }
}

void WiderGradient::add_critical(const Reached& reached) {
  const CriticalSimplices& own = gradient_.critical();
  CriticalSimplices others;
  for_each_received(reached.vertex_steps, [&](int rank, const auto& step) {
    if (step[1] == no_id) others.vertices.push_back(vertex(rank, step[0]));
  });
  for_each_received(reached.cell_steps, [&](int rank, const auto& step) {
    if (step[1] == no_id) others.cells.push_back(cell(rank, step[0]));
  });
  for (const auto& [high, low, third] : told_edges_) {
    if (third == edge_is_critical) others.edges.push_back({high, low});
  }
  critical_ = own;
  const VertexNames& names = simplices_->names();
  const auto merge = [&](int dimension, auto member, const auto& key) {
    std::vector<Id> places;
    critical_.*member = merged(own.*member, others.*member, key, places);
    is_own_[dimension].assign((critical_.*member).size(), 0);
    for (const Id place : places) is_own_[dimension][place] = 1;
    return places;
  };
  if (own.dimension == 3) is_own_[2].assign(own.triangles.size(), 1);  // nobody tells of others'
  side_by_side(
      [&] { own_edges_ = merge(1, &CriticalSimplices::edges, [&](const auto& e) { return written(names, e); }); },
      [&] { merge(0, &CriticalSimplices::vertices, [&](Id v) { return names[v]; }); },
      [&] { merge(own.dimension, &CriticalSimplices::cells, [&](Id t) { return simplices_->cell_id(t); }); });
}

}  // namespace gale::detail
