#include <algorithm>
#include <set>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/persistence.hpp>
#include <gale/algorithms/persistence/cancellations.hpp>
#include <gale/algorithms/simplify.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/brute_force_complex.hpp"
#include "algorithms/structure_kinds.hpp"
#include "algorithms/surface_cases.hpp"
#include "algorithms/turned_gradient.hpp"
#include "support/message_of.hpp"

namespace gale::test {

namespace {

/// The place of each critical simplex in `left` among those of `all`: 1 where it is there.
std::vector<Simplex> gone(const std::vector<Simplex>& all, const std::vector<char>& is_left) {
  std::vector<Simplex> gone;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_left[i] == 0) gone.push_back(all[i]);
  }
  return gone;
}

}  // namespace

class SurfaceComplex : public SurfaceTest {};

TEST_P(SurfaceComplex, is_that_of_brute_force_whatever_segments_and_threads) {
  for (const Field& field : fields_on(points_of_surface(surface()))) {
    SCOPED_TRACE(field.name);
    const NamedComplex expected = brute_force_complex(surface(), BruteForceGradient(surface(), field.values));
    for (const int capacity : {5, 100}) {
      const Mesh mesh = encode(surface(), capacity);
      const DiscreteGradient gradient = gradient_on_surface(mesh, field.values);
      ComputeOptions options;
      options.threads = capacity == 5 ? 1 : 8;
      const MorseSmaleComplex found = find_morse_smale_complex(gradient, {}, options);
      EXPECT_TRUE(equal(as_defined(named(found)), expected));
      EXPECT_EQ(found.connectors.count(), 0);
      const VertexOrder order(mesh, field.values.data(), field.values.size());
      const auto structure = make_structure(mesh, discrete_gradient_relations_of(2));
      EXPECT_TRUE(equal(find_morse_smale_complex(*structure, find_discrete_gradient(WorkerSpace(), order)), found));
    }
  }
}

/// A number for each pair of manifolds that occurs, in the order of the pairs.
TEST_P(SurfaceComplex, has_manifolds_of_pairs) {
  const Mesh mesh = encode(surface(), 20);
  const MorseSmaleComplex found =
      find_morse_smale_complex(gradient_on_surface(mesh, random_field(points_of_surface(surface()), 8)));
  const auto up = found.ascending_manifold.in<HostMemory>(), down = found.descending_manifold.in<HostMemory>(),
             both = found.morse_smale_manifold.in<HostMemory>();
  std::set<std::pair<Id, Id>> pairs;
  for (Id v = 0; v < mesh.vertices(); ++v) {
    if (up(v) != no_id) pairs.insert({up(v), down(v)});
  }
  EXPECT_EQ(found.morse_smale_manifolds, static_cast<Id>(pairs.size()));
  for (Id v = 0; v < mesh.vertices(); ++v) {
    const auto pair = pairs.find({up(v), down(v)});
    EXPECT_EQ(both(v), pair == pairs.end() ? no_id : static_cast<Id>(std::distance(pairs.begin(), pair)));
  }
}

TEST_P(SurfaceComplex, simplified_is_that_of_the_gradient_that_cancelling_makes) {
  if (has_forks(surface())) GTEST_SKIP() << "the definition cancels where one path leads";
  for (const Field& field : fields_on(points_of_surface(surface()))) {
    if (field.name == "infinities") continue;
    const Mesh mesh = encode(surface(), 20);
    const auto value = [&](Id v) { return field.values.at(v); };
    const MorseSmaleComplex complex = find_morse_smale_complex(gradient_on_surface(mesh, field.values));
    const auto critical = named(complex).critical;
    for (const double threshold : {0.0, 1.0, 3.0, 7.5, 1e9}) {
      SCOPED_TRACE(field.name + " below " + std::to_string(threshold));
      const auto values = detail::critical_values(complex.gradient, value);
      const auto cancelled = detail::cancel_below(threshold, complex, values, false, false, 2);
      // Which edges go with minima, and which with maxima, is what the pairs say.
      std::vector<char> with_minimum(critical[1].size(), 1), with_maximum(critical[1].size(), 1);
      const PersistencePairs pairs = find_persistence_pairs(complex.gradient);
      for (const auto& pair : detail::pairs_below(threshold, 0, pairs.pairs[0], values)) with_minimum[pair.upper] = 0;
      for (const auto& pair : detail::pairs_below(threshold, 1, pairs.pairs[1], values)) with_maximum[pair.lower] = 0;
      TurnedGradient turned(surface(), field.values, BruteForceGradient(surface(), field.values));
      turned.cancel_with_minima(gone(critical[1], with_minimum));
      turned.cancel_with_maxima(gone(critical[1], with_maximum));
      const NamedComplex expected = brute_force_complex(surface(), turned.gradient());
      for (const bool extrema_only : {false, true}) {
        SimplifyOptions options;
        options.extrema_only = extrema_only;
        options.threads = extrema_only ? 1 : 8;
        const MorseSmaleComplex left = simplify(complex, value, threshold, options);
        EXPECT_TRUE(equal(as_defined(named(left)), expected));
        EXPECT_EQ(left.kept_below.count(), 0);
        EXPECT_EQ(left.critical.euler(), surface().euler);
      }
      EXPECT_EQ(gone(critical[0], cancelled.is_left[0]).size() + gone(critical[2], cancelled.is_left[2]).size(),
                gone(critical[1], cancelled.is_left[1]).size());
    }
  }
}

/// Where edges have three triangles a rising path has several ways, and takes one of them in what is left.
TEST_P(SurfaceComplex, simplified_falls_to_the_minima_that_cancelling_leaves) {
  const Mesh mesh = encode(surface(), 20);
  const auto field = random_field(points_of_surface(surface()), 10);
  const auto value = [&](Id v) { return field.at(v); };
  const MorseSmaleComplex complex = find_morse_smale_complex(gradient_on_surface(mesh, field));
  const auto critical = named(complex).critical;
  for (const double threshold : {2.0, 0.2 * mesh.vertices(), 1e9}) {
    std::vector<char> with_minimum(critical[1].size(), 1);
    const PersistencePairs pairs = find_persistence_pairs(complex.gradient);
    const auto values = detail::critical_values(complex.gradient, value);
    for (const auto& pair : detail::pairs_below(threshold, 0, pairs.pairs[0], values)) with_minimum[pair.upper] = 0;
    TurnedGradient turned(surface(), field, BruteForceGradient(surface(), field));
    turned.cancel_with_minima(gone(critical[1], with_minimum));
    NamedComplex expected = brute_force_complex(surface(), turned.gradient());
    const NamedComplex left = named(simplify(complex, value, threshold));
    const std::set<Simplex> edges(left.critical[1].begin(), left.critical[1].end());
    auto& falling = expected.descending;
    falling.erase(
        std::remove_if(falling.begin(), falling.end(), [&](const auto& path) { return edges.count(path.source) == 0; }),
        falling.end());
    EXPECT_EQ(left.critical[0], expected.critical[0]);
    EXPECT_TRUE(left.descending == falling);
    EXPECT_EQ(left.descending_manifold, expected.descending_manifold);
    EXPECT_EQ(left.critical[0].size() + left.critical[2].size(), left.critical[1].size() + surface().euler);
    for (const auto& path : left.ascending) EXPECT_EQ(path.cells.back(), path.destination);
  }
}

/// Joined paths go on as those that they join.
TEST_P(SurfaceComplex, simplified_and_joined_ends_where_whole_paths_do) {
  const Mesh mesh = encode(surface(), 20);
  const auto field = random_field(points_of_surface(surface()), 9);
  const auto value = [&](Id v) { return field.at(v); };
  MorseSmaleParts parts;
  parts.saddle_connectors = false;
  const MorseSmaleComplex complex = find_morse_smale_complex(gradient_on_surface(mesh, field), parts);
  SimplifyOptions joined;
  joined.paths = Paths::joined;
  const double threshold = 0.2 * mesh.vertices();
  const auto left = simplify(complex, value, threshold, joined), whole = simplify(complex, value, threshold);
  EXPECT_EQ(left.critical.euler(), surface().euler);
  EXPECT_EQ(left.descending.sources, whole.descending.sources);
  EXPECT_EQ(left.descending.destinations, whole.descending.destinations);
  EXPECT_EQ(left.ascending.sources, whole.ascending.sources);
  EXPECT_EQ(left.ascending.destinations, whole.ascending.destinations);
  EXPECT_LE(left.ascending.cells.size(), whole.ascending.cells.size());
}

INSTANTIATE_TEST_SUITE_P(Tests, SurfaceComplex, surface_names(), surface_name);

/// A roof over 2 times 3 points: vertices 0 1 2 on the ground below 3 4 5, 4 the highest.
TEST(SurfaceComplexes, of_a_roof_rise_to_its_triangle) {
  InputSurface roof;
  roof.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  roof.triangles = {{0, 1, 4}, {0, 3, 4}, {1, 2, 5}, {1, 4, 5}};
  const std::vector<double> field = {0, 1, 2, 3, 5, 4};
  const Mesh mesh = encode(roof, 10);
  const NamedComplex found = named(find_morse_smale_complex(gradient_on_surface(mesh, field)));
  // The lower star of 4 is its whole star, a half disc: nothing is critical there, and each path leaves.
  EXPECT_EQ(found.critical[0], (std::vector<Simplex>{{0}}));
  EXPECT_TRUE(found.critical[1].empty());
  EXPECT_TRUE(found.critical[2].empty());
  EXPECT_EQ(found.ascending_manifold, std::vector<Simplex>(6, Simplex{}));
  EXPECT_EQ(found.descending_manifold, std::vector<Simplex>(6, Simplex{0}));
}

}  // namespace gale::test
