#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/order/require_mesh.hpp>
#include <gale/algorithms/persistence/pairs.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/threads.hpp>

namespace gale {

namespace detail {

namespace {

/// Pairs saddles with the extrema between which they are: goes through the saddles in the order of `saddles`, and joins
/// the sets of its two ends. Of these two the one whose oldest extremum is younger ends there: that extremum is paired
/// with the saddle. `age[extremum]` counts from 0, the oldest; the outside (no_id) is older than all. Returns for each
/// extremum the saddle that it is paired with, no_id if it is with none. Sequential, nearly O(n).
std::vector<Id> join_ends(const std::vector<Id>& saddles, const PathEnds& ends, const std::vector<Id>& age) {
  // The outside has age 0 here, and the extrema follow. Sets are known by the ages of their oldest.
  std::vector<Id> extremum(age.size() + 1, no_id), older(age.size() + 1), saddle_of(age.size(), no_id);
  for (std::size_t i = 0; i < age.size(); ++i) extremum[age[i] + 1] = static_cast<Id>(i);
  std::iota(older.begin(), older.end(), Id(0));
  const auto oldest = [&](Id end) {
    Id at = end == no_id ? 0 : age[end] + 1;
    while (older[at] != at) at = older[at] = older[older[at]];
    return at;
  };
  for (const Id saddle : saddles) {
    stop_if_asked_at(saddle);
    Id one = oldest(ends[saddle][0]), other = oldest(ends[saddle][1]);
    if (one == other) continue;
    if (one < other) std::swap(one, other);
    saddle_of[extremum[one]] = saddle;
    older[one] = other;
  }
  return saddle_of;
}

/// For each maximum the saddle that it is paired with, where paths don't fork: one for which is_free(saddle).
template <class IsFree>
std::vector<Id> pair_maxima(const PathEnds& ends, const Filtration& filtration, int dimension, const IsFree& is_free) {
  const auto& rising = filtration.by_rank[dimension - 1];
  std::vector<Id> falling;
  std::copy_if(rising.rbegin(), rising.rend(), std::back_inserter(falling), is_free);
  std::vector<Id> age = filtration.rank[dimension];
  for (Id& rank : age) rank = static_cast<Id>(age.size()) - 1 - rank;
  return join_ends(falling, ends, age);
}

/// Whether a rising path forks: at a triangle of three tetrahedra or more, or on a triangle mesh at such an edge.
bool has_forks(const DiscreteGradient& gradient) {
  const auto& begin = gradient.critical().star_begin;
  for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
    if (begin[i + 1] - begin[i] > 2) return true;
  }
  return !gradient.store().further_successors.empty();
}

/// What each simplex is paired with, by dimension and place.
class Partners {
 public:
  explicit Partners(const std::array<Id, 4>& counts) {
    for (int d = 0; d < 4; ++d) is_paired_[d].assign(counts[d], 0);
  }

  /// `upper[i]`: what the i-th simplex of `dimension` is paired with, no_id if with nothing.
  std::vector<PersistencePair> from_lower(int dimension, const std::vector<Id>& upper) {
    std::vector<PersistencePair> pairs;
    for (std::size_t i = 0; i < upper.size(); ++i) {
      if (upper[i] == no_id) continue;
      pairs.push_back({static_cast<Id>(i), upper[i]});
      is_paired_[dimension][i] = is_paired_[dimension + 1][upper[i]] = 1;
    }
    return pairs;
  }

  /// The pairs, from what the simplices of `dimension` + 1 are paired with.
  std::vector<PersistencePair> from_upper(int dimension, const std::vector<Id>& lower) {
    std::vector<Id> upper(is_paired_[dimension].size(), no_id);
    for (std::size_t i = 0; i < lower.size(); ++i) {
      if (lower[i] != no_id) upper[lower[i]] = static_cast<Id>(i);
    }
    return from_lower(dimension, upper);
  }

  bool is_paired(int dimension, Id place) const { return is_paired_[dimension][place] != 0; }

  std::vector<Id> unpaired(int dimension) const {
    std::vector<Id> unpaired;
    for (std::size_t i = 0; i < is_paired_[dimension].size(); ++i) {
      if (!is_paired(dimension, static_cast<Id>(i))) unpaired.push_back(static_cast<Id>(i));
    }
    return unpaired;
  }

 private:
  std::array<std::vector<char>, 4> is_paired_;
};

/// What pairs_of does on a triangle mesh, where a saddle is in a pair with a minimum, or with a maximum, or in none.
/// That no saddle is in both has to be seen to where rising paths don't take all their ways.
PersistencePairs pairs_on_triangles(const DiscreteGradient& gradient, const CriticalPlaces& places,
                                    const Filtration& filtration, const ExtremumEnds& ends, bool forks) {
  PersistencePairs found;
  Partners partners(gradient.critical().counts());
  found.pairs[0] = partners.from_lower(0, join_ends(filtration.by_rank[1], ends.of_edges, filtration.rank[0]));
  const auto is_free = [&](Id saddle) { return !partners.is_paired(1, saddle); };
  found.pairs[1] = partners.from_upper(1, forks ? pair_forked_maxima(gradient, places, filtration)
                                                : pair_maxima(ends.of_facets, filtration, 2, is_free));
  for (int d = 0; d < 3; ++d) found.essential[d] = partners.unpaired(d);
  return found;
}

}  // namespace

PersistencePairs pairs_of(const DiscreteGradient& gradient, const CriticalPlaces& places, const ExtremumEnds& ends,
                          bool forks, WantedPairs wanted, int threads) {
  const Filtration filtration = filtration_of(gradient, threads);
  if (gradient.mesh().dimension() == 2) return pairs_on_triangles(gradient, places, filtration, ends, forks);
  std::vector<Id> saddle_of_minimum, saddle_of_maximum;
  const std::function<void()> extrema[] = {
      [&] { saddle_of_minimum = join_ends(filtration.by_rank[1], ends.of_edges, filtration.rank[0]); },
      [&] {
        saddle_of_maximum = forks ? pair_forked_maxima(gradient, places, filtration)
                                  : pair_maxima(ends.of_facets, filtration, 3, [](Id) { return true; });
      }};
  in_turns(threads, 2, [&](int, std::int64_t i) { extrema[i](); });
  PersistencePairs found;
  Partners partners(gradient.critical().counts());
  found.pairs[0] = partners.from_lower(0, saddle_of_minimum);
  found.pairs[2] = partners.from_upper(2, saddle_of_maximum);
  if (wanted == WantedPairs::all) {
    std::vector<Id> columns;
    for (const Id triangle : filtration.by_rank[2]) {
      if (!partners.is_paired(2, triangle)) columns.push_back(triangle);
    }
    found.pairs[1] = partners.from_lower(1, pair_saddles(gradient, places, filtration, columns, threads));
  }
  for (int d = 0; d < 4; ++d) found.essential[d] = partners.unpaired(d);
  return found;
}

}  // namespace detail

PersistencePairs find_persistence_pairs(const DiscreteGradient& gradient, const SweepOptions& options) {
  detail::require_whole_mesh("persistence pairs", gradient.mesh(), ", which gather_gradient() brings together");
  const ThreadLimit limit(options.threads);
  const detail::CriticalPlaces places(gradient.critical());
  const bool forks = detail::has_forks(gradient);
  detail::ExtremumEnds ends{ends_of_edges(gradient, places), {}};
  if (!forks) ends.of_facets = ends_of_facets(gradient, places);
  return pairs_of(gradient, places, ends, forks, detail::WantedPairs::all, std::max(options.threads, 1));
}

}  // namespace gale
