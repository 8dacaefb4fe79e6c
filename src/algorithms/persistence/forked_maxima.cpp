#include <algorithm>
#include <iterator>
#include <unordered_map>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/persistence/forked_maxima.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

namespace {

/// Ranks of maxima, ascending.
using Ranks = std::vector<Id>;

void add(Ranks& to, const Ranks& more) {
  Ranks sum;
  std::set_symmetric_difference(to.begin(), to.end(), more.begin(), more.end(), std::back_inserter(sum));
  to.swap(sum);
}

/// The maxima that an odd number of paths from a tetrahedron rises to.
class ForkedEnds {
 public:
  ForkedEnds(const DiscreteGradient& gradient, const CriticalPlaces& places, const std::vector<Id>& rank)
      : successors_(gradient.tetrahedron_successors().data()),
        further_(gradient.store().further_successors),
        places_(places),
        rank_(rank) {}

  const Ranks& of(Id tetrahedron) {
    std::vector<Id> path = {tetrahedron};
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
    return ends_.at(tetrahedron);
  }

 private:
  template <class Visit>
  void for_each_successor(Id tetrahedron, const Visit& visit) const {
    if (successors_[tetrahedron] >= 0) visit(successors_[tetrahedron]);
    auto at = std::lower_bound(further_.begin(), further_.end(), std::make_pair(tetrahedron, Id(0)));
    for (; at != further_.end() && at->first == tetrahedron; ++at) visit(at->second);
  }

  Id first_unknown(Id tetrahedron) const {
    Id unknown = no_id;
    for_each_successor(tetrahedron, [&](Id next) {
      if (unknown == no_id && ends_.count(next) == 0) unknown = next;
    });
    return unknown;
  }

  Ranks sum_at(Id tetrahedron) const {
    if (successors_[tetrahedron] == no_id) return {rank_[places_.of_tetrahedron(tetrahedron)]};
    Ranks sum;
    for_each_successor(tetrahedron, [&](Id next) { add(sum, ends_.at(next)); });
    return sum;
  }

  const Id* successors_;
  const std::vector<std::pair<Id, Id>>& further_;
  const CriticalPlaces& places_;
  const std::vector<Id>& rank_;
  std::unordered_map<Id, Ranks> ends_;
};

}  // namespace

std::vector<Id> pair_forked_maxima(const DiscreteGradient& gradient, const CriticalPlaces& places,
                                   const Filtration& filtration) {
  const CriticalSimplices& critical = gradient.critical();
  const auto& maxima = filtration.by_rank[3];
  ForkedEnds ends(gradient, places, filtration.rank[3]);
  std::vector<Ranks> reduced(maxima.size());  // by the rank of the lowest maximum in each
  std::vector<Id> saddle_of(maxima.size(), no_id);
  const auto& saddles = filtration.by_rank[2];
  for (auto saddle = saddles.rbegin(); saddle != saddles.rend(); ++saddle) {
    Ranks left;
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
