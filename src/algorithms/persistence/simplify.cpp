#include <algorithm>
#include <cstring>
#include <set>
#include <string>
#include <tuple>

#include <gale/algorithms/excerpt/gradient_excerpt.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/algorithms/order/require.hpp>
#include <gale/algorithms/persistence/cancellations.hpp>
#include <gale/algorithms/simplify.hpp>
#include <gale/base/error.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>

namespace gale {

namespace {

void require_whole(const MorseSmaleComplex& complex, bool extrema_only) {
  if (!extrema_only && complex.critical.dimension == 3 && !complex.parts.saddle_connectors)
    throw Error("simplify needs parts that the complex was computed without: saddle connectors");
  const auto all = complex.gradient.critical().counts(), there = complex.critical.counts();
  if (all == there) return;
  const auto sum = [](const auto& counts) {
    std::int64_t sum = 0;
    for (const Id count : counts) sum += count;
    return std::to_string(sum);
  };
  throw Error("simplify takes a complex that isn't simplified: this one has " + sum(there) + " of the gradient's " +
              sum(all) + " critical simplices");
}

template <class Simplex>
std::vector<Simplex> left_of(const std::vector<Simplex>& simplices, const std::vector<char>& is_left) {
  std::vector<Simplex> left;
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    if (is_left[i]) left.push_back(simplices[i]);
  }
  return left;
}

CriticalSimplices critical_left(const CriticalSimplices& all, const std::array<std::vector<char>, 4>& is_left) {
  CriticalSimplices left;
  left.dimension = all.dimension;
  left.vertices = left_of(all.vertices, is_left[0]);
  left.edges = left_of(all.edges, is_left[1]);
  if (all.dimension == 3) left.triangles = left_of(all.triangles, is_left[2]);
  left.cells = left_of(all.cells, is_left[all.dimension]);
  for (std::size_t i = 0; i + 1 < all.star_begin.size(); ++i) {
    if (!is_left[all.dimension - 1][i]) continue;
    left.star.insert(left.star.end(), all.star.begin() + all.star_begin[i], all.star.begin() + all.star_begin[i + 1]);
    left.star_begin.push_back(static_cast<Id>(left.star.size()));
  }
  return left;
}

/// The manifolds of extrema as parts of those of their heirs.
Mirrored<Id> manifold_left(const Mirrored<Id>& manifold, const std::vector<Id>& heirs,
                           const std::vector<char>& is_left) {
  if (manifold.size() == 0) return manifold;
  std::vector<Id> place(heirs.size(), no_id), heir_place(heirs.size(), no_id);
  Id next = 0;
  for (std::size_t i = 0; i < heirs.size(); ++i) {
    if (is_left[i]) place[i] = next++;
  }
  for (std::size_t i = 0; i < heirs.size(); ++i) heir_place[i] = heirs[i] == no_id ? no_id : place[heirs[i]];
  return detail::renamed(manifold, heir_place);
}

/// The walls that make up that of a saddle: its own, then the others, in the order of their places.
std::vector<Id> parts_of(const std::vector<std::vector<Id>>& joined, Id saddle) {
  std::set<Id> found = {saddle};
  std::vector<Id> rest = {saddle};
  while (!rest.empty()) {
    const Id at = rest.back();
    rest.pop_back();
    for (const Id other : joined[at]) {
      if (found.insert(other).second) rest.push_back(other);
    }
  }
  found.erase(saddle);
  std::vector<Id> parts = {saddle};
  parts.insert(parts.end(), found.begin(), found.end());
  return parts;
}

/// The ascending walls of the 1-saddles for which `is_left` is set: each is made of its own and of those of the
/// 1-saddles that are joined to it, directly or not, by place; a cell that is in several is there once.
AscendingWalls ascending_walls_left(const AscendingWalls& all, const std::vector<std::vector<Id>>& joined,
                                    const std::vector<char>& is_left) {
  AscendingWalls left;
  Id place = 0;
  for (Id saddle = 0; saddle < all.walls.count(); ++saddle) {
    if (!is_left[saddle]) continue;
    const std::vector<Id> parts = parts_of(joined, saddle);
    std::set<std::array<Id, 2>> seen;
    for (const Id part : parts) {
      for (Offset cell = all.walls.begin[part]; cell < all.walls.begin[part + 1]; ++cell) {
        if (parts.size() > 1 && !seen.insert(all.walls.cells[cell]).second) continue;
        left.walls.cells.push_back(all.walls.cells[cell]);
        left.star.insert(left.star.end(), all.star.begin() + all.star_begin[cell],
                         all.star.begin() + all.star_begin[cell + 1]);
        left.star_begin.push_back(static_cast<Offset>(left.star.size()));
      }
    }
    left.walls.sources.push_back(place++);
    left.walls.begin.push_back(static_cast<Offset>(left.walls.cells.size()));
  }
  return left;
}

}  // namespace

namespace {

/// A table of the first rank, on all. Collective.
std::vector<Id> broadcast(const Ranks& ranks, const Mirrored<Id>& table) {
  std::string bytes;
  detail::together(ranks, [&] {
    const auto& here = table.in<HostMemory>();
    bytes.assign(reinterpret_cast<const char*>(here.data()), here.extent(0) * sizeof(Id));
  });
  bytes = ranks.broadcast(bytes, 0);
  std::vector<Id> all(bytes.size() / sizeof(Id));
  std::memcpy(all.data(), bytes.data(), bytes.size());
  return all;
}

/// The places 0 to count - 1: each extremum is its own manifold, and becomes that of the one that takes it over.
Mirrored<Id> places_of(std::size_t count) { return iota("GALE::places", HostExecutionSpace(), count); }

/// Simplifies on the first rank what is gathered there, and manifolds on all. Collective.
MorseSmaleComplex simplify_on_ranks(const MorseSmaleComplex& complex, const std::function<double(Id)>& value,
                                    double threshold, const SimplifyOptions& options) {
  const Mesh& mesh = complex.gradient.mesh();
  const Ranks& ranks = mesh.exchange().ranks();
  const DiscreteGradient gathered = detail::gathered_with_walls(complex.gradient, complex.parts.separatrices2);
  const std::vector<double> values = detail::values_at(gathered.mesh(), mesh, value);
  MorseSmaleComplex left{complex.gradient, complex.parts, {}};
  detail::together(ranks, [&] {
    MorseSmaleComplex whole{gathered, complex.parts, gathered.critical()};
    if (ranks.rank() == 0) {
      MorseSmaleParts parts = complex.parts;
      parts.descending_manifolds = parts.ascending_manifolds = false;
      parts.saddle_connectors = mesh.dimension() == 3 && (parts.saddle_connectors || !options.extrema_only);
      ComputeOptions how;
      how.threads = options.threads;
      whole = find_morse_smale_complex(gathered, parts, how);
      whole.descending_manifold = places_of(whole.critical.vertices.size());
      whole.ascending_manifold = places_of(whole.critical.cells.size());
      whole = simplify(
          whole, [&](Id vertex) { return values[vertex]; }, threshold, options);
    }
    whole.gradient = complex.gradient;
    whole.excerpt = gathered;
    whole.parts = complex.parts;
    left = std::move(whole);
  });
  left.kept_below.several_paths = static_cast<Id>(ranks.sum(left.kept_below.several_paths));
  left.kept_below.no_path = static_cast<Id>(ranks.sum(left.kept_below.no_path));
  const std::vector<Id> down = broadcast(ranks, left.descending_manifold),
                        up = broadcast(ranks, left.ascending_manifold);
  detail::together(ranks, [&] {
    left.descending_manifold = left.ascending_manifold = {};
    if (complex.descending_manifold.size() > 0)
      left.descending_manifold = detail::renamed(complex.descending_manifold, down);
    if (complex.ascending_manifold.size() > 0)
      left.ascending_manifold = detail::renamed(complex.ascending_manifold, up);
  });
  if (complex.parts.descending_manifolds && complex.parts.ascending_manifolds) {
    std::tie(left.morse_smale_manifold, left.morse_smale_manifolds) =
        detail::morse_smale_manifolds(mesh, left.ascending_manifold, left.descending_manifold);
  }
  return left;
}

}  // namespace

MorseSmaleComplex simplify(const MorseSmaleComplex& complex, const std::function<double(Id)>& value, double threshold,
                           const SimplifyOptions& options) {
  const Ranks& ranks = complex.gradient.mesh().exchange().ranks();
  detail::together(ranks, [&] {
    detail::require_threshold(threshold);
    detail::require_thread_count(options.threads);
    if (!value) throw Error("a complex simplified by persistence needs the field's values");
  });
  if (ranks.size() > 1) return simplify_on_ranks(complex, value, threshold, options);
  require_whole(complex, options.extrema_only);
  const ThreadLimit limit(options.threads);
  const int threads = options.threads;
  const DiscreteGradient& gradient = complex.gradient;
  const MorseSmaleParts& parts = complex.parts;
  const bool want_ascending_walls = !complex.ascending_walls.walls.sources.empty();
  const auto cancelled = detail::cancel_below(threshold, complex, detail::critical_values(gradient, value),
                                              options.extrema_only, want_ascending_walls, threads);
  MorseSmaleComplex left{gradient, parts, critical_left(complex.critical, cancelled.is_left)};
  const detail::CriticalPlaces places(left.critical);
  if (parts.descending_separatrices) {
    left.descending = detail::descending_separatrices(gradient.mesh(), cancelled.minima.successors(), left.critical,
                                                      places, options.paths);
  }
  if (parts.ascending_separatrices)
    left.ascending =
        detail::ascending_separatrices(cancelled.maxima.successors(), left.critical, places, options.paths);
  if (left.critical.dimension == 3 && (parts.saddle_connectors || parts.separatrices2)) {
    auto surfaces = detail::descending_surfaces(gradient, left.critical, places, parts.separatrices2,
                                                parts.saddle_connectors, threads, &cancelled.edges, options.paths);
    left.connectors = std::move(surfaces.connectors);
    left.descending_walls = std::move(surfaces.walls);
  }
  if (want_ascending_walls) {
    left.ascending_walls =
        ascending_walls_left(complex.ascending_walls, cancelled.saddles.joined, cancelled.is_left[1]);
  }

  left.descending_manifold =
      manifold_left(complex.descending_manifold, cancelled.heir_of_minimum, cancelled.is_left[0]);
  left.ascending_manifold =
      manifold_left(complex.ascending_manifold, cancelled.heir_of_maximum, cancelled.is_left[left.critical.dimension]);
  if (complex.morse_smale_manifold.size() != 0) {
    std::tie(left.morse_smale_manifold, left.morse_smale_manifolds) =
        detail::morse_smale_manifolds(gradient.mesh(), left.ascending_manifold, left.descending_manifold);
  }
  left.kept_below = cancelled.saddles.kept;
  return left;
}

}  // namespace gale
