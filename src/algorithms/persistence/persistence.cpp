#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/order/require.hpp>
#include <gale/algorithms/persistence/pairs.hpp>
#include <gale/algorithms/persistence/saddle_columns.hpp>
#include <gale/base/ordered.hpp>
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
  const auto oldest = [&](Id end) { return root_of(older, end == no_id ? 0 : age[end] + 1); };
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

}  // namespace

bool has_forks(const DiscreteGradient& gradient) {
  const auto& begin = gradient.critical().star_begin;
  for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
    if (begin[i + 1] - begin[i] > 2) return true;
  }
  return !gradient.store().further_successors.empty();
}

PairsOfExtrema::PairsOfExtrema(const Filtration& filtration, const ExtremumEnds& ends, int dimension,
                               const std::function<std::vector<Id>()>& forked_maxima)
    : dimension_(dimension) {
  for (int d = 0; d < 4; ++d) is_paired_[d].assign(filtration.rank[d].size(), 0);
  const auto with_minima = [&] { return join_ends(filtration.by_rank[1], ends.of_edges, filtration.rank[0]); };
  const auto with_maxima = [&](const auto& is_free) {
    return forked_maxima ? forked_maxima() : pair_maxima(ends.of_facets, filtration, dimension, is_free);
  };
  if (dimension == 2) {
    // A saddle is in a pair with a minimum, or with a maximum, or in none. That none is in both has to be seen to where
    // rising paths don't take all their ways.
    found_.pairs[0] = from_lower(0, with_minima());
    found_.pairs[1] = from_upper(1, with_maxima([&](Id saddle) { return is_paired_[1][saddle] == 0; }));
    return;
  }
  std::vector<Id> saddle_of_minimum, saddle_of_maximum;
  side_by_side([&] { saddle_of_minimum = with_minima(); },
               [&] { saddle_of_maximum = with_maxima([](Id) { return true; }); });
  found_.pairs[0] = from_lower(0, saddle_of_minimum);
  found_.pairs[2] = from_upper(2, saddle_of_maximum);
  std::copy_if(filtration.by_rank[2].begin(), filtration.by_rank[2].end(), std::back_inserter(columns_),
               [&](Id triangle) { return is_paired_[2][triangle] == 0; });
}

/// `upper[i]`: what the i-th simplex of `dimension` is paired with, no_id if with nothing.
std::vector<PersistencePair> PairsOfExtrema::from_lower(int dimension, const std::vector<Id>& upper) {
  std::vector<PersistencePair> pairs;
  for (std::size_t i = 0; i < upper.size(); ++i) {
    if (upper[i] == no_id) continue;
    pairs.push_back({static_cast<Id>(i), upper[i]});
    is_paired_[dimension][i] = is_paired_[dimension + 1][upper[i]] = 1;
  }
  return pairs;
}

/// The pairs, from what the simplices of `dimension` + 1 are paired with.
std::vector<PersistencePair> PairsOfExtrema::from_upper(int dimension, const std::vector<Id>& lower) {
  std::vector<Id> upper(is_paired_[dimension].size(), no_id);
  for (std::size_t i = 0; i < lower.size(); ++i) {
    if (lower[i] != no_id) upper[lower[i]] = static_cast<Id>(i);
  }
  return from_lower(dimension, upper);
}

PersistencePairs PairsOfExtrema::with_saddles(const std::vector<Id>& upper_of_lower) {
  if (dimension_ == 3) found_.pairs[1] = from_lower(1, upper_of_lower);
  for (int d = 0; d <= dimension_; ++d) {
    for (std::size_t i = 0; i < is_paired_[d].size(); ++i) {
      if (is_paired_[d][i] == 0) found_.essential[d].push_back(static_cast<Id>(i));
    }
  }
  return std::move(found_);
}

PersistencePairs pairs_of(const DiscreteGradient& gradient, const CriticalPlaces& places, const ExtremumEnds& ends,
                          bool forks, WantedPairs wanted, int threads) {
  const Filtration filtration = filtration_of(gradient, threads);
  std::function<std::vector<Id>()> forked_maxima;
  if (forks) forked_maxima = [&] { return pair_forked_maxima(gradient, places, filtration); };
  PairsOfExtrema pairs(filtration, ends, gradient.mesh().dimension(), forked_maxima);
  std::vector<Id> upper_of_lower(gradient.critical().edges.size(), no_id);
  if (wanted == WantedPairs::all) {
    const SaddleColumns columns(gradient, places, filtration, pairs.columns(), threads);
    for (std::size_t i = 0; i < upper_of_lower.size(); ++i) {
      const Column* const column = columns.owner(static_cast<Id>(i));
      if (column != nullptr) upper_of_lower[i] = filtration.by_rank[2][column->rank];
    }
  }
  return pairs.with_saddles(upper_of_lower);
}

}  // namespace detail

PersistencePairs find_persistence_pairs(const DiscreteGradient& gradient, const SweepOptions& options) {
  detail::require_whole_mesh("persistence pairs", gradient.mesh(), ", which gather_gradient() brings together");
  detail::require_thread_count(options.threads);
  const ThreadLimit limit(options.threads);
  gradient.store().bring_pairs_to_host();
  const detail::CriticalPlaces places(gradient.critical());
  const bool forks = detail::has_forks(gradient);
  detail::ExtremumEnds ends{ends_of_edges(gradient, places), {}};
  if (!forks) ends.of_facets = ends_of_facets(gradient, places);
  return pairs_of(gradient, places, ends, forks, detail::WantedPairs::all, options.threads);
}

}  // namespace gale
