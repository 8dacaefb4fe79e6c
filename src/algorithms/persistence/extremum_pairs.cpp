#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>

#include <gale/algorithms/gradient/follow_each_path.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/persistence/pairs.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

PathEnds ends_of_edges(const DiscreteGradient& gradient, const CriticalPlaces& places) {
  const auto& edges = gradient.critical().edges;
  PathEnds ends(edges.size());
  follow_each_path(
      "GALE::ends_of_edges", gradient.store().vertex_successors(), 2 * static_cast<Offset>(edges.size()),
      [&](Offset i) { return edges[i / 2][i % 2]; },
      [&](Offset i, Id last, Id) { ends[i / 2][i % 2] = places.of_vertex(last); });
  return ends;
}

PathEnds ends_of_facets(const DiscreteGradient& gradient, const CriticalPlaces& places) {
  const CriticalSimplices& critical = gradient.critical();
  std::vector<Id> end_of_star(critical.star.size(), no_id);
  follow_each_path(
      "GALE::ends_of_facets", gradient.store().cell_successors(), static_cast<Offset>(critical.star.size()),
      [&](Offset i) { return critical.star[i]; },
      [&](Offset i, Id last, Id next) {
        if (next == no_id) end_of_star[i] = places.of_cell(last);
      });
  PathEnds ends(critical.star_begin.size() - 1, {no_id, no_id});
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Id first = critical.star_begin[i], count = critical.star_begin[i + 1] - first;
    for (Id k = 0; k < count && count <= 2; ++k) ends[i][k] = end_of_star[first + k];
  }
  return ends;
}

namespace {

/// Ranks of maxima, ascending.
using MaximumRanks = std::vector<Id>;

void add(MaximumRanks& to, const MaximumRanks& more) {
  MaximumRanks sum;
  std::set_symmetric_difference(to.begin(), to.end(), more.begin(), more.end(), std::back_inserter(sum));
  to.swap(sum);
}

/// The maxima that an odd number of paths from a cell rises to.
class ForkedEnds {
 public:
  ForkedEnds(const DiscreteGradient& gradient, const CriticalPlaces& places, const std::vector<Id>& rank)
      : successors_(gradient.cell_successors().data()),
        further_(gradient.store().further_successors),
        places_(places),
        rank_(rank) {}

  const MaximumRanks& of(Id cell) {
    std::vector<Id> path = {cell};
    while (!path.empty()) {
      stop_if_asked();
      const Id at = path.back();
      const Id next = ends_.count(at) != 0 ? no_id : first_unknown(at);
      if (next != no_id) {
        path.push_back(next);
        continue;
      }
      ends_.try_emplace(at, sum_at(at));
      path.pop_back();
    }
    return ends_.at(cell);
  }

 private:
  template <class Visit>
  void for_each_successor(Id cell, const Visit& visit) const {
    if (successors_[cell] >= 0) visit(successors_[cell]);
    auto at = std::lower_bound(further_.begin(), further_.end(), std::make_pair(cell, Id(0)));
    for (; at != further_.end() && at->first == cell; ++at) visit(at->second);
  }

  Id first_unknown(Id cell) const {
    Id unknown = no_id;
    for_each_successor(cell, [&](Id next) {
      if (unknown == no_id && ends_.count(next) == 0) unknown = next;
    });
    return unknown;
  }

  MaximumRanks sum_at(Id cell) const {
    if (successors_[cell] == no_id) return {rank_[places_.of_cell(cell)]};
    MaximumRanks sum;
    for_each_successor(cell, [&](Id next) { add(sum, ends_.at(next)); });
    return sum;
  }

  const Id* successors_;
  const std::vector<std::pair<Id, Id>>& further_;
  const CriticalPlaces& places_;
  const std::vector<Id>& rank_;
  std::unordered_map<Id, MaximumRanks> ends_;
};

}  // namespace

std::vector<Id> pair_forked_maxima(const DiscreteGradient& gradient, const CriticalPlaces& places,
                                   const Filtration& filtration) {
  const CriticalSimplices& critical = gradient.critical();
  const auto& maxima = filtration.by_rank[critical.dimension];
  ForkedEnds ends(gradient, places, filtration.rank[critical.dimension]);
  std::vector<MaximumRanks> reduced(maxima.size());  // by the rank of the lowest maximum in each
  std::vector<Id> saddle_of(maxima.size(), no_id);
  const auto& saddles = filtration.by_rank[critical.dimension - 1];
  for (auto saddle = saddles.rbegin(); saddle != saddles.rend(); ++saddle) {
    MaximumRanks left;
    for (Id i = critical.star_begin[*saddle]; i < critical.star_begin[*saddle + 1]; ++i)
      add(left, ends.of(critical.star[i]));
    while (!left.empty() && !reduced[left[0]].empty()) {
      stop_if_asked();
      add(left, reduced[left[0]]);
    }
    if (left.empty()) continue;
    const Id lowest = left[0];
    saddle_of[maxima[lowest]] = *saddle;
    reduced[lowest].swap(left);
  }
  return saddle_of;
}

}  // namespace gale::detail
