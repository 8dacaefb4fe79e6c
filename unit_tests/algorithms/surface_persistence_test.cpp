#include <gtest/gtest.h>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/persistence.hpp>

#include "algorithms/brute_force_persistence.hpp"
#include "algorithms/named_complex.hpp"
#include "algorithms/surface_cases.hpp"
#include "support/with_threads.hpp"

namespace gale::test {

class SurfacePersistence : public SurfaceTest {};

TEST_P(SurfacePersistence, has_the_pairs_of_the_boundary_matrix) {
  for (const Field& field : fields_on(points_of_surface(surface()))) {
    SCOPED_TRACE(field.name);
    const NamedPairs expected = brute_force_pairs(field.values, BruteForceGradient(surface(), field.values));
    for (const int capacity : {5, 100}) {
      const DiscreteGradient gradient = gradient_on_surface(encode(surface(), capacity), field.values);
      for (const int threads : {1, 8}) {
        const PersistencePairs pairs = find_persistence_pairs(gradient, with_threads(threads));
        const NamedPairs found = named_pairs(gradient, pairs);
        EXPECT_EQ(found.pairs, expected.pairs);
        EXPECT_EQ(found.essential, expected.essential);
        const auto counts = gradient.critical().counts();
        EXPECT_EQ(pairs.pairs[0].size() + pairs.pairs[1].size() + pairs.essential[1].size(),
                  static_cast<std::size_t>(counts[1]));
        EXPECT_TRUE(pairs.pairs[2].empty() && pairs.essential[3].empty());
      }
    }
  }
}

/// Finds the homology from all simplices.
TEST_P(SurfacePersistence, begins_and_ends_at_the_vertices_of_the_filtration) {
  const Mesh mesh = encode(surface(), 50);
  for (const unsigned seed : {1, 2}) {
    const auto field = random_field(points_of_surface(surface()), seed);
    const DiscreteGradient gradient = gradient_on_surface(mesh, field);
    EXPECT_EQ(vertex_pairs(field, named_pairs(gradient, find_persistence_pairs(gradient))),
              brute_force_vertex_pairs(surface(), field));
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, SurfacePersistence, surface_names(), surface_name);

TEST(SurfacePersistences, have_the_betti_numbers_of_books) {
  const auto essential = [](const InputSurface& surface) {
    const Mesh mesh = encode(surface, 30);
    const auto pairs = find_persistence_pairs(gradient_on_surface(mesh, random_field(points_of_surface(surface), 6)));
    return std::array<std::size_t, 3>{pairs.essential[0].size(), pairs.essential[1].size(), pairs.essential[2].size()};
  };
  using Betti = std::array<std::size_t, 3>;
  EXPECT_EQ(essential(surfaces().at("sphere")), (Betti{1, 0, 1}));
  EXPECT_EQ(essential(surfaces().at("torus")), (Betti{1, 2, 1}));
  EXPECT_EQ(essential(surfaces().at("plane")), (Betti{1, 0, 0}));
  EXPECT_EQ(essential(surfaces().at("Moebius strip")), (Betti{1, 1, 0}));
  EXPECT_EQ(essential(surfaces().at("book of five pages")), (Betti{1, 0, 0}));
  EXPECT_EQ(essential(surfaces().at("vertices without a triangle")), (Betti{4, 0, 0}));
}

/// As TTK's Discrete Morse Sandwich counts them.
TEST(SurfacePersistences, of_a_known_plane) {
  const KnownPlane plane(600);
  const Mesh mesh = encode(plane.surface, 100);
  const DiscreteGradient gradient = gradient_on_surface(mesh, {plane.field.begin(), plane.field.end()});
  const PersistencePairs found = find_persistence_pairs(gradient);
  EXPECT_EQ(found.pairs[0].size(), 1831u);
  EXPECT_EQ(found.pairs[1].size(), 1552u);
  EXPECT_EQ(found.essential[0].size(), 1u);
  EXPECT_TRUE(found.essential[1].empty());
  EXPECT_TRUE(found.essential[2].empty());
}

}  // namespace gale::test
