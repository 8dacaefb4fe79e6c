#include <gtest/gtest.h>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/base/error.hpp>
#include <map>

#include "algorithms/brute_force_complex.hpp"
#include "algorithms/fields.hpp"
#include "algorithms/structure_kinds.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

MorseSmaleParts all_parts() {
  MorseSmaleParts parts;
  parts.separatrices2 = true;
  return parts;
}

MorseSmaleComplex complex_of(Structure& structure, const Field& field, int threads,
                             const MorseSmaleParts& parts = all_parts()) {
  const VertexOrder order(structure.mesh(), field.values.data(), field.values.size());
  const auto gradient = find_discrete_gradient(structure, order, with_threads(threads));
  return find_morse_smale_complex(structure, gradient, parts, with_threads(threads));
}

/// What the first test that asked found, whatever its segmentation.
NamedComplex& first_found(const std::string& mesh_and_field, const NamedComplex& found) {
  static std::map<std::string, NamedComplex> known;
  return known.emplace(mesh_and_field, found).first->second;
}

}  // namespace

class MorseSmaleComplexOf : public EveryMesh {};

TEST_P(MorseSmaleComplexOf, every_mesh_is_that_of_brute_force_whatever_the_structure_segments_and_threads) {
  const Mesh mesh = encode(input(), segmentation());
  const auto& expected = brute_force_complexes(mesh_name());
  const auto fields = fields_on(input());
  std::vector<MorseSmaleComplex> first;
  int threads = 1;
  for (const auto& kind : structure_kinds()) {
    const auto structure = kind.make(mesh, morse_smale_relations);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      SCOPED_TRACE(kind.name + ", " + fields[i].name);
      const auto complex = complex_of(*structure, fields[i], threads);
      if (first.size() == i) {
        const NamedComplex found = named(complex);
        ASSERT_TRUE(equal(as_defined(found), expected[i]));
        ASSERT_TRUE(equal(found, first_found(mesh_name() + fields[i].name, found))) << "than with other segments";
        first.push_back(complex);
      }
      EXPECT_TRUE(equal(complex, first[i]));
    }
    threads = threads == 1 ? 8 : 2;
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, MorseSmaleComplexOf, every_mesh_and_segmentation(), mesh_and_segmentation);

TEST(MorseSmaleComplex, of_some_parts_has_them_as_the_whole_has_them) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, octree_of(input, 100));
  const auto structure = structure_kinds().front().make(mesh, morse_smale_relations);
  const Field field = fields_on(input).front();
  const MorseSmaleComplex whole = complex_of(*structure, field, 2);
  for (unsigned wanted = 0; wanted < 64; ++wanted) {
    SCOPED_TRACE(wanted);
    MorseSmaleParts parts;
    parts.descending_separatrices = wanted & 1;
    parts.ascending_separatrices = wanted & 2;
    parts.saddle_connectors = wanted & 4;
    parts.separatrices2 = wanted & 8;
    parts.descending_manifolds = wanted & 16;
    parts.ascending_manifolds = wanted & 32;
    MorseSmaleComplex expected = whole;
    if (!parts.descending_separatrices) expected.descending = {};
    if (!parts.ascending_separatrices) expected.ascending = {};
    if (!parts.saddle_connectors) expected.connectors = {};
    if (!parts.separatrices2) expected.descending_walls = {}, expected.ascending_walls = {};
    if (!parts.descending_manifolds) expected.descending_manifold = {};
    if (!parts.ascending_manifolds) expected.ascending_manifold = {};
    if (!parts.descending_manifolds || !parts.ascending_manifolds) {
      expected.morse_smale_manifold = {};
      expected.morse_smale_manifolds = 0;
    }
    EXPECT_TRUE(equal(complex_of(*structure, field, 2, parts), expected));
  }
}

TEST(MorseSmaleComplex, needs_VT_for_its_surfaces) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, octree_of(input, 100));
  const auto structure = structure_kinds().front().make(mesh, morse_smale_relations);
  const auto field = fields_on(input).front();
  const VertexOrder order(mesh, field.values.data(), field.values.size());
  const auto gradient = find_discrete_gradient(*structure, order);
  const auto without = structure_kinds().front().make(mesh, Relation::VV);
  EXPECT_THROW(find_morse_smale_complex(*without, gradient, all_parts()), Error);
  EXPECT_TRUE(equal(find_morse_smale_complex(*without, gradient), find_morse_smale_complex(*structure, gradient)))
      << "what reads no relation";
}

}  // namespace gale::test
