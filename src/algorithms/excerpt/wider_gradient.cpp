#include <algorithm>
#include <numeric>
#include <utility>

#include <gale/algorithms/excerpt/wider_gradient.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>

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
    : gradient_(gradient),
      simplices_(std::move(simplices)),
      own_vertices_(simplices_->own_vertices()),
      own_cells_(simplices_->own_cells()),
      vertices_(simplices_->vertices()) {
  fill_keys();
  fill_successors(reached);
  add_critical(reached);
}

WallGround WiderGradient::ground() const {
  return {
      pairs_, vertex_successors_.beside(gradient_.store().vertex_steps()), keys_, simplices_->names(), {0, vertices_}};
}

void WiderGradient::fill_keys() {
  const VertexOrder& order = gradient_.order();
  if (!order.has_short_values()) return rank_vertices();
  others_keys_.resize(vertices_ - own_vertices_);
  parallel_for("GALE::wider_keys", HostExecutionSpace(), others_keys_.size(), [&](Offset i) {
    const Id vertex = own_vertices_ + static_cast<Id>(i);
    others_keys_[i] = simplices_->value(vertex) << 32 | static_cast<std::uint32_t>(simplices_->names()[vertex]);
  });
  keys_ = {order.keys(), own_vertices_, others_keys_.data(), simplices_->names()};
}

/// Makes keys of all vertices' ranks: those of others come between.
void WiderGradient::rank_vertices() {
  std::vector<Id> by_rank(own_vertices_), others(vertices_ - own_vertices_);
  for (Id v = 0; v < own_vertices_; ++v) by_rank[gradient_.order().keys()[v]] = v;
  std::iota(others.begin(), others.end(), own_vertices_);
  const auto is_less = [&](Id a, Id b) {
    const std::uint64_t value_a = simplices_->value(a), value_b = simplices_->value(b);
    return value_a != value_b ? value_a < value_b : simplices_->names()[a] < simplices_->names()[b];
  };
  std::sort(others.begin(), others.end(), is_less);
  std::vector<Id> all(vertices_);
  std::merge(by_rank.begin(), by_rank.end(), others.begin(), others.end(), all.begin(), is_less);
  ranks_.resize(vertices_);
  for (std::size_t i = 0; i < all.size(); ++i) ranks_[all[i]] = i;
  keys_ = {ranks_.data(), vertices_};
}

void WiderGradient::fill_successors(const Reached& reached) {
  const auto begin = [](MoreSuccessors& successors, const Mirrored<Id>& own, Id others) {
    successors.own = own;
    successors.beyond.assign(others, DiscreteGradient::elsewhere);
  };
  begin(vertex_successors_, gradient_.store().vertex_successors(), vertices_ - own_vertices_);
  begin(cell_successors_, gradient_.store().cell_successors(), simplices_->cells() - own_cells_);
  for_each_received(reached.vertex_steps, [&](int rank, const auto& step) {
    vertex_successors_.tell(vertex(rank, step[0]), step[1] == no_id ? no_id : vertex(rank, step[1]));
  });
  for_each_received(reached.cell_steps, [&](int rank, const auto& step) {
    cell_successors_.tell(cell(rank, step[0]), step[1] < 0 ? step[1] : cell(rank, step[1]));
  });
  if (gradient_.mesh().dimension() == 3) fill_rows(reached);
  vertex_successors_.sort();
  cell_successors_.sort();
}

/// Others' vertices, ghosts among them, get rows of those edges that were reached. One that is neither critical nor
/// paired with a triangle is paired with its higher end.
void WiderGradient::fill_rows(const Reached& reached) {
  pairs_ = EdgePairs(gradient_.store().pairs(), gradient_.mesh().owned_vertices(), vertices_);
  std::vector<std::uint64_t> in_rows, told;
  std::vector<std::pair<std::uint64_t, Id>> paired;
  for_each_received(reached.edges, [&](int rank, const auto& edge) {
    const Id high = vertex(rank, edge[0]), low = vertex(rank, edge[1]);
    told.push_back(pair_key(high, low));
    if (edge[2] < 0) return;
    const Id third = vertex(rank, edge[2]);
    in_rows.push_back(pair_key(high, third));
    paired.push_back({pair_key(high, low), third});
  });
  in_rows.insert(in_rows.end(), told.begin(), told.end());
  parallel_sort("GALE::sort_reached", in_rows.begin(), in_rows.end());
  parallel_sort("GALE::sort_reached", told.begin(), told.end());
  in_rows.erase(std::unique(in_rows.begin(), in_rows.end()), in_rows.end());
  auto at = told.begin();
  for (const std::uint64_t edge : in_rows) {
    while (at != told.end() && *at < edge) ++at;
    if (at == told.end() || *at != edge) vertex_successors_.tell(pair_first(edge), pair_second(edge));
  }
  for (std::size_t first = 0; first < in_rows.size();) {
    const Id high = pair_first(in_rows[first]);
    std::size_t end = first;
    while (end < in_rows.size() && pair_first(in_rows[end]) == high) ++end;
    EdgePairRow row = pairs_.begin(0, high, static_cast<Id>(end - first));
    for (std::size_t i = first; i < end; ++i) row.set_id(static_cast<Id>(i - first), pair_second(in_rows[i]));
    first = end;
  }
  for (const auto& [edge, third] : paired) {
    EdgePairRow row = pairs_.row(pair_first(edge));
    row.pair(row.find(pair_second(edge)), row.find(third));
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
  for_each_received(reached.edges, [&](int rank, const auto& edge) {
    if (edge[2] == edge_is_critical) others.edges.push_back({vertex(rank, edge[0]), vertex(rank, edge[1])});
  });
  critical_ = own;
  const VertexNames& names = simplices_->names();
  const auto merge = [&](int dimension, auto member, const auto& key) {
    std::vector<Id> places;
    critical_.*member = merged(own.*member, others.*member, key, places);
    is_own_[dimension].assign((critical_.*member).size(), 0);
    for (const Id place : places) is_own_[dimension][place] = 1;
    return places;
  };
  merge(0, &CriticalSimplices::vertices, [&](Id v) { return names[v]; });
  own_edges_ = merge(1, &CriticalSimplices::edges, [&](const auto& e) { return written(names, e); });
  if (own.dimension == 3) is_own_[2].assign(own.triangles.size(), 1);  // nobody tells of others'
  merge(own.dimension, &CriticalSimplices::cells, [&](Id t) { return simplices_->cell_id(t); });
}

}  // namespace gale::detail
