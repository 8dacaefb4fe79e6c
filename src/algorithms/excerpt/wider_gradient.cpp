#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

#include <gale/algorithms/excerpt/wider_gradient.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>

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

WiderGradient::WiderGradient(const DiscreteGradient& gradient, const PathSimplices& cells, Reached reached)
    : gradient_(gradient),
      mesh_(gradient.mesh()),
      exchange_(mesh_.exchange()),
      corners_(mesh_.cell_reader()),
      vertex_input_(mesh_.vertices_in_input()),
      cell_input_(mesh_.cells_in_input()),
      own_vertices_(mesh_.vertices()),
      own_cells_(mesh_.cells()) {
  number(reached, cells);
  name_vertices();
  fill_keys();
  fill_successors(reached);
  add_critical(reached);
}

WallGround WiderGradient::ground() const {
  return {pairs_, vertex_successors_.data(), keys_.data(), {names_.data()}, {0, vertices()}};
}

WiderSuccessors WiderGradient::cell_successors() const {
  return {gradient_.cell_successors().data(), own_cells_, steps_beyond_.data(), steps_of_exits_.data(),
          static_cast<Id>(steps_of_exits_.size())};
}

GlobalId WiderGradient::vertex_id(Id vertex) const {
  return vertex < own_vertices_ ? exchange_.vertex_id(vertex_input_[vertex]) : beyond_[vertex - own_vertices_].id;
}

GlobalId WiderGradient::cell_id(Id cell) const {
  return is_own_cell(cell) ? exchange_.cell_id(cell_input_[cell]) : cell_ids_[cell - own_cells_];
}

std::uint64_t WiderGradient::value(Id vertex) const {
  return vertex < own_vertices_ ? gradient_.order().value_key(vertex) : beyond_[vertex - own_vertices_].value;
}

template <class T, class Visit>
void WiderGradient::for_each(const Dealt<T>& received, const Visit& visit) const {
  for (int rank = 0; rank + 1 < static_cast<int>(received.begin.size()); ++rank) {
    for (Offset i = received.begin[rank]; i < received.begin[rank + 1]; ++i) visit(rank, received.entries(i));
  }
}

/// Finds what of that which was received this rank has, and numbers the rest.
void WiderGradient::number(const Reached& reached, const PathSimplices& cells) {
  vertex_begin_ = reached.vertices.begin;
  cell_begin_ = reached.cells.begin;
  for_each(reached.vertices, [&](int, const ReachedVertex& vertex) {
    if (mesh_.vertex_of(vertex.id) == no_id) beyond_.push_back(vertex);
  });
  const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
  std::sort(beyond_.begin(), beyond_.end(), by_id);
  beyond_.erase(std::unique(beyond_.begin(), beyond_.end(), [](const auto& a, const auto& b) { return a.id == b.id; }),
                beyond_.end());
  for_each(reached.vertices, [&](int, const ReachedVertex& vertex) {
    const Id here = mesh_.vertex_of(vertex.id);
    const auto at = std::lower_bound(beyond_.begin(), beyond_.end(), vertex, by_id);
    vertex_of_.push_back(here == no_id ? own_vertices_ + static_cast<Id>(at - beyond_.begin())
                                       : mesh_.vertices_of_input()[here]);
  });
  std::unordered_map<GlobalId, Id> others;
  for_each(reached.cells, [&](int rank, const ReachedCell& cell) {
    if (mesh_.exchange().cell_of(cell.id) != no_id) {
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
void WiderGradient::name_vertices() {
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

void WiderGradient::fill_keys() {
  const VertexOrder& order = gradient_.order();
  const auto keys = allocate<Array<std::uint64_t, HostMemory>>("GALE::wider_keys", vertices());
  keys_ = keys;
  if (order.has_short_values()) {
    parallel_for("GALE::wider_keys", HostExecutionSpace(), vertices(),
                 [&](Offset v) { keys(v) = value(static_cast<Id>(v)) << 32 | static_cast<std::uint32_t>(names_(v)); });
    return;
  }
  // Keys are ranks: those of others come between.
  std::vector<Id> by_rank(own_vertices_), others(beyond_.size());
  for (Id v = 0; v < own_vertices_; ++v) by_rank[order.keys()[v]] = v;
  std::iota(others.begin(), others.end(), own_vertices_);
  const auto is_less = [&](Id a, Id b) {
    const std::uint64_t value_a = value(a), value_b = value(b);
    return value_a != value_b ? value_a < value_b : names_(a) < names_(b);
  };
  std::sort(others.begin(), others.end(), is_less);
  std::vector<Id> all(vertices());
  std::merge(by_rank.begin(), by_rank.end(), others.begin(), others.end(), all.begin(), is_less);
  for (std::size_t i = 0; i < all.size(); ++i) keys(all[i]) = i;
}

void WiderGradient::fill_successors(const Reached& reached) {
  const auto& own = gradient_.vertex_successors();
  const auto of_vertices = allocate<Array<Id, HostMemory>>("GALE::wider_successors", vertices());
  parallel_for("GALE::wider_successors", HostExecutionSpace(), vertices(),
               [&](Offset v) { of_vertices(v) = v < own_vertices_ ? own(v) : DiscreteGradient::elsewhere; });
  steps_beyond_.assign(cell_corners_.size(), DiscreteGradient::elsewhere);
  for_each(reached.vertex_steps, [&](int rank, const auto& step) {
    of_vertices(vertex(rank, step[0])) = step[1] == no_id ? no_id : vertex(rank, step[1]);
  });
  for_each(reached.cell_steps, [&](int rank, const auto& step) {
    const Id from = cell(rank, step[0]), to = step[1] < 0 ? step[1] : cell(rank, step[1]);
    if (is_own_cell(from)) {
      steps_of_exits_.emplace_back(from, to);
    } else {
      steps_beyond_[from - own_cells_] = to;
    }
  });
  std::sort(steps_of_exits_.begin(), steps_of_exits_.end());
  if (mesh_.dimension() == 3) fill_rows(reached, of_vertices);
  vertex_successors_ = of_vertices;
}

/// Others' vertices, ghosts among them, get rows of those edges that were reached. One that is neither critical nor
/// paired with a triangle is paired with its higher end.
void WiderGradient::fill_rows(const Reached& reached, const Array<Id, HostMemory>& vertex_successors) {
  pairs_ = EdgePairs(gradient_.store().pairs(), mesh_.owned_vertices(), vertices());
  std::vector<std::uint64_t> in_rows, told;
  std::vector<std::pair<std::uint64_t, Id>> paired;
  for_each(reached.edges, [&](int rank, const auto& edge) {
    const Id high = vertex(rank, edge[0]), low = vertex(rank, edge[1]);
    in_rows.push_back(pair_key(high, low));
    told.push_back(in_rows.back());
    if (edge[2] < 0) return;
    const Id third = vertex(rank, edge[2]);
    in_rows.push_back(pair_key(high, third));
    paired.push_back({pair_key(high, low), third});
  });
  std::sort(in_rows.begin(), in_rows.end());
  in_rows.erase(std::unique(in_rows.begin(), in_rows.end()), in_rows.end());
  std::sort(told.begin(), told.end());
  for (const std::uint64_t edge : in_rows) {
    if (!std::binary_search(told.begin(), told.end(), edge)) vertex_successors(pair_first(edge)) = pair_second(edge);
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
    EdgePairRow row = pairs_[pair_first(edge)];
    row.pair(row.find(pair_second(edge)), row.find(third));
  }
}

void WiderGradient::add_critical(const Reached& reached) {
  const CriticalSimplices& own = gradient_.critical();
  CriticalSimplices others;
  for_each(reached.vertex_steps, [&](int rank, const auto& step) {
    if (step[1] == no_id) others.vertices.push_back(vertex(rank, step[0]));
  });
  for_each(reached.cell_steps, [&](int rank, const auto& step) {
    if (step[1] == no_id) others.cells.push_back(cell(rank, step[0]));
  });
  for_each(reached.edges, [&](int rank, const auto& edge) {
    if (edge[2] == edge_is_critical) others.edges.push_back({vertex(rank, edge[0]), vertex(rank, edge[1])});
  });
  critical_ = own;
  const OtherIds names{names_.data()};
  const auto merge = [&](int dimension, auto member, const auto& key) {
    std::vector<Id> places;
    critical_.*member = merged(own.*member, others.*member, key, places);
    is_own_[dimension].assign((critical_.*member).size(), 0);
    for (const Id place : places) is_own_[dimension][place] = 1;
    return places;
  };
  merge(0, &CriticalSimplices::vertices, [&](Id v) { return names_(v); });
  own_edges_ = merge(1, &CriticalSimplices::edges, [&](const auto& e) { return written(names, e); });
  if (own.dimension == 3) is_own_[2].assign(own.triangles.size(), 1);  // nobody tells of others'
  merge(own.dimension, &CriticalSimplices::cells, [&](Id t) { return cell_id(t); });
}

}  // namespace gale::detail
