#include <gale/outputs/manifolds.hpp>

#include "outputs/outputs_of.hpp"

namespace gale::test {

namespace {

std::vector<Id> sizes_of(const OutputsOf& of) {
  const io::PointArray sizes = outputs::manifold_sizes(of.complex);
  return values_of<Id>({sizes}, "ManifoldSize");
}

MorseSmaleParts manifolds(bool descending, bool ascending) { return {true, true, true, true, descending, ascending}; }

const std::vector<double> between_two_minima{0, 2, 3, 4, 1};        ///< of two tetrahedra; without a maximum
const std::vector<double> around_a_maximum{10, 5, -5, 1, 2, 3, 4};  ///< of the octahedron

}  // namespace

TEST(Manifolds, of_two_minima_without_a_maximum) {
  const OutputsOf of = outputs_of(two_tetrahedra(), between_two_minima);
  const auto arrays = outputs::manifold_arrays(of.complex);
  EXPECT_EQ(names_of(arrays),
            (std::vector<std::string>{"AscendingManifold", "DescendingManifold", "MorseSmaleManifold"}));
  EXPECT_EQ(values_of<Id>(arrays, "DescendingManifold"), (std::vector<Id>{0, 0, 0, 0, 1}));
  EXPECT_EQ(values_of<Id>(arrays, "AscendingManifold"), std::vector<Id>(5, no_id));
  EXPECT_EQ(values_of<Id>(arrays, "MorseSmaleManifold"), std::vector<Id>(5, no_id));
  EXPECT_EQ(sizes_of(of), (std::vector<Id>{4, 1, 0})) << "two minima and a saddle";
}

TEST(Manifolds, of_one_maximum_are_the_whole_mesh) {
  const OutputsOf of = outputs_of(octahedron(), around_a_maximum);
  for (const auto& array : outputs::manifold_arrays(of.complex))
    EXPECT_EQ(values_of<Id>({array}, array.name), std::vector<Id>(7, 0)) << array.name;
  EXPECT_EQ(sizes_of(of), (std::vector<Id>{7, 0, 7})) << "minimum, 2-saddle, maximum";
}

TEST(Manifolds, that_were_not_wanted_are_left_out) {
  const OutputsOf falling = outputs_of(octahedron(), around_a_maximum, manifolds(true, false));
  EXPECT_EQ(names_of(outputs::manifold_arrays(falling.complex)), (std::vector<std::string>{"DescendingManifold"}));
  EXPECT_EQ(sizes_of(falling), (std::vector<Id>{7, 0, -1}));
  const OutputsOf rising = outputs_of(octahedron(), around_a_maximum, manifolds(false, true));
  EXPECT_EQ(names_of(outputs::manifold_arrays(rising.complex)), (std::vector<std::string>{"AscendingManifold"}));
  EXPECT_EQ(sizes_of(rising), (std::vector<Id>{-1, 0, 7}));
  const OutputsOf none = outputs_of(octahedron(), around_a_maximum, manifolds(false, false));
  EXPECT_TRUE(outputs::manifold_arrays(none.complex).empty());
  EXPECT_EQ(sizes_of(none), (std::vector<Id>{-1, 0, -1}));
}

}  // namespace gale::test
