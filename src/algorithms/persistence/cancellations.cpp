#include <vector>

#include <gale/algorithms/persistence/cancellations.hpp>
#include <gale/base/threads.hpp>

namespace gale::detail {

Cancellations::Cancellations(const DiscreteGradient& gradient)
    : minima(gradient.vertex_successors()), maxima(gradient.cell_successors()), edges(gradient.mesh().vertices()) {
  for (int d = 0; d < 4; ++d) is_left[d].assign(gradient.critical().counts()[d], 1);
}

namespace {

/// Cancels the extrema of these pairs with their saddles, and turns the paths between them around in `forest`. `ends`
/// and `sides` say for each saddle which extrema its paths end at, and where they begin; no_id stands for the outside.
/// The pairs are such that those that are joined by saddles have one extremum among them that stays, or the outside:
/// returns for each extremum the one that its manifold becomes part of; no_id if it is the outside.
std::vector<Id> cancel_extrema(const std::vector<PersistencePair>& pairs, Id PersistencePair::*extremum,
                               Id PersistencePair::*saddle, const PathEnds& ends,
                               const std::vector<std::array<Id, 2>>& sides, std::size_t extrema, TurnedForest& forest) {
  // The outside comes after the extrema.
  const auto place = [&](Id end) { return end == no_id ? extrema : static_cast<std::size_t>(end); };
  std::vector<std::vector<Id>> saddles_at(extrema + 1);
  std::vector<char> stays(extrema + 1, 1);
  for (const PersistencePair& pair : pairs) {
    stays[pair.*extremum] = 0;
    for (const Id end : ends[pair.*saddle]) saddles_at[place(end)].push_back(pair.*saddle);
  }
  std::vector<Id> heirs(extrema + 1, no_id), reached;
  for (std::size_t i = 0; i <= extrema; ++i) {
    if (!stays[i]) continue;
    heirs[i] = i == extrema ? no_id : static_cast<Id>(i);
    reached.push_back(static_cast<Id>(i));
  }
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const auto at = static_cast<std::size_t>(reached[k]);
    for (const Id crossed : saddles_at[at]) {
      const int side = place(ends[crossed][0]) == at ? 1 : 0;
      const std::size_t next = place(ends[crossed][side]);
      if (stays[next]) continue;
      forest.turn(sides[crossed][side], sides[crossed][1 - side], crossed);
      stays[next] = 1;
      heirs[next] = heirs[at];
      reached.push_back(static_cast<Id>(next));
    }
  }
  heirs.pop_back();
  return heirs;
}

/// The cells of each critical facet of cells; no_id for what is outside.
std::vector<std::array<Id, 2>> sides_of_facets(const CriticalSimplices& critical) {
  std::vector<std::array<Id, 2>> sides(critical.star_begin.size() - 1, {no_id, no_id});
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Id first = critical.star_begin[i], count = critical.star_begin[i + 1] - first;
    for (Id k = 0; k < count && k < 2; ++k) sides[i][k] = critical.star[first + k];
  }
  return sides;
}

void leave_out(const std::vector<PersistencePair>& pairs, int type, Cancellations& all) {
  for (const PersistencePair& pair : pairs) all.is_left[type][pair.lower] = all.is_left[type + 1][pair.upper] = 0;
}

void cancel_minima(const std::vector<PersistencePair>& pairs, const CriticalSimplices& critical, const PathEnds& ends,
                   Cancellations& all) {
  all.heir_of_minimum = cancel_extrema(pairs, &PersistencePair::lower, &PersistencePair::upper, ends, critical.edges,
                                       critical.vertices.size(), all.minima);
  for (const PersistencePair& pair : pairs) {
    const auto& edge = critical.edges[pair.upper];
    all.edges.set(edge[0], edge[1], TurnedEdges::with_vertex);
  }
  leave_out(pairs, 0, all);
}

void cancel_maxima(const std::vector<PersistencePair>& pairs, const CriticalSimplices& critical, const PathEnds& ends,
                   Cancellations& all) {
  all.heir_of_maximum = cancel_extrema(pairs, &PersistencePair::upper, &PersistencePair::lower, ends,
                                       sides_of_facets(critical), critical.cells.size(), all.maxima);
  leave_out(pairs, critical.dimension - 1, all);
}

}  // namespace

Cancellations cancel_below(double threshold, const MorseSmaleComplex& complex, const CriticalValues& values,
                           bool extrema_only, bool want_joined, int threads) {
  const DiscreteGradient& gradient = complex.gradient;
  const CriticalSimplices& critical = gradient.critical();
  const CriticalPlaces places(critical);
  const ExtremumEnds ends{ends_of_edges(gradient, places), ends_of_facets(gradient, places)};
  const int with_maxima = critical.dimension - 1;
  Cancellations all(gradient);
  all.pairs =
      pairs_of(gradient, places, ends, false, extrema_only ? WantedPairs::of_extrema : WantedPairs::all, threads);
  const auto& pairs = all.pairs.pairs;
  side_by_side([&] { cancel_minima(pairs_below(threshold, 0, pairs[0], values), critical, ends.of_edges, all); },
               [&] {
                 cancel_maxima(pairs_below(threshold, with_maxima, pairs[with_maxima], values), critical,
                               ends.of_facets, all);
               });
  if (critical.dimension == 2) return all;
  if (want_joined) all.saddles.joined.resize(critical.edges.size());
  if (extrema_only) return all;
  DoomedSaddles doomed{pairs_below(threshold, 1, pairs[1], values), values[1], values[2], {}, threshold};
  doomed.minimum_below.resize(values[1].size());
  for (const PersistencePair& pair : pairs[0]) doomed.minimum_below[pair.upper] = values[0][pair.lower];
  all.saddles = cancel_saddles(complex, places, doomed, want_joined, all.minima, all.edges);
  for (const auto& [lower, instead] : all.saddles.exchanged) {
    all.is_left[1][lower] = 0;
    all.is_left[1][instead] = 1;
  }
  leave_out(all.saddles.pairs, 1, all);
  return all;
}

}  // namespace gale::detail
