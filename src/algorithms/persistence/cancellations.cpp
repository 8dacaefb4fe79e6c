#include <functional>

#include <gale/algorithms/persistence/cancel_extrema.hpp>
#include <gale/algorithms/persistence/cancellations.hpp>
#include <gale/algorithms/persistence/pairs.hpp>
#include <gale/base/threads.hpp>

namespace gale::detail {

Cancellations::Cancellations(const DiscreteGradient& gradient)
    : minima(gradient.vertex_successors()),
      maxima(gradient.tetrahedron_successors()),
      edges(gradient.mesh().vertices()) {
  for (int d = 0; d < 4; ++d) is_left[d].assign(gradient.critical().counts()[d], 1);
}

namespace {

void leave_out(const std::vector<PersistencePair>& pairs, int type, Cancellations& all) {
  for (const PersistencePair& pair : pairs) all.is_left[type][pair.lower] = all.is_left[type + 1][pair.upper] = 0;
}

void cancel_minima(const std::vector<PersistencePair>& pairs, const CriticalSimplices& critical, const PathEnds& ends,
                   Cancellations& all) {
  all.heir_of_minimum = cancel_extrema(pairs, &PersistencePair::lower, &PersistencePair::upper, ends,
                                       sides_of_edges(critical), critical.vertices.size(), all.minima);
  for (const PersistencePair& pair : pairs) {
    const auto& edge = critical.edges[pair.upper];
    all.edges.set(edge[0], edge[1], TurnedEdges::with_vertex);
  }
  leave_out(pairs, 0, all);
}

void cancel_maxima(const std::vector<PersistencePair>& pairs, const CriticalSimplices& critical, const PathEnds& ends,
                   Cancellations& all) {
  all.heir_of_maximum = cancel_extrema(pairs, &PersistencePair::upper, &PersistencePair::lower, ends,
                                       sides_of_triangles(critical), critical.tetrahedra.size(), all.maxima);
  leave_out(pairs, 2, all);
}

}  // namespace

Cancellations cancel_below(double threshold, const MorseSmaleComplex& complex, const CriticalValues& values,
                           bool extrema_only, bool want_joined, int threads) {
  const DiscreteGradient& gradient = complex.gradient;
  const CriticalSimplices& critical = gradient.critical();
  const CriticalPlaces places(critical);
  const ExtremumEnds ends{ends_of_edges(gradient, places), ends_of_triangles(gradient, places)};
  const PersistencePairs pairs = pairs_along_successors(gradient, places, ends, threads);
  Cancellations all(gradient);
  const std::function<void()> extrema[] = {
      [&] { cancel_minima(pairs_below(threshold, 0, pairs.pairs[0], values), critical, ends.of_edges, all); },
      [&] { cancel_maxima(pairs_below(threshold, 2, pairs.pairs[2], values), critical, ends.of_triangles, all); }};
  in_turns(threads, 2, [&](int, std::int64_t i) { extrema[i](); });
  DoomedSaddles doomed{pairs_below(threshold, 1, pairs.pairs[1], values), values[1], values[2], {}, threshold};
  if (extrema_only) return all;
  doomed.minimum_below.resize(values[1].size());
  for (const PersistencePair& pair : pairs.pairs[0]) doomed.minimum_below[pair.upper] = values[0][pair.lower];
  all.saddles = cancel_saddles(complex, places, doomed, want_joined, all.minima, all.edges);
  for (const auto& [lower, instead] : all.saddles.exchanged) {
    all.is_left[1][lower] = 0;
    all.is_left[1][instead] = 1;
  }
  leave_out(all.saddles.pairs, 1, all);
  all.kept_below = all.saddles.kept;
  return all;
}

}  // namespace gale::detail
