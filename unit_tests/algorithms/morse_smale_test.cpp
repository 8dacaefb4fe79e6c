#include <atomic>
#include <map>

#include <gtest/gtest.h>

#include <gale/algorithms/excerpt/triangle_names.hpp>
#include <gale/algorithms/excerpt/wall_rows.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/base/error.hpp>
#include <gale/base/threads.hpp>
#include <gale/baselines/discrete_gradient_from_cells.hpp>

#include "algorithms/brute_force_complex.hpp"
#include "algorithms/fields.hpp"
#include "algorithms/structure_kinds.hpp"
#include "support/every_mesh.hpp"
#include "support/message_of.hpp"

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

/// The complex of the gradient that kernels find.
MorseSmaleComplex complex_of_kernels(Structure& structure, const Field& field) {
  const VertexOrder order(structure.mesh(), field.values.data(), field.values.size());
  return find_morse_smale_complex(structure, find_discrete_gradient(WorkerSpace(), order));
}

MorseSmaleComplex without_separatrices2(MorseSmaleComplex complex) {
  complex.descending_walls = {};
  complex.ascending_walls = {};
  return complex;
}

/// Is this what brute force finds, and in the same order as with other segments?
void expect_the_one(const std::string& mesh_name, std::size_t field, const NamedComplex& found) {
  static std::map<std::pair<std::string, std::size_t>, NamedComplex> known;
  const auto [entry, is_new] = known.emplace(std::make_pair(mesh_name, field), found);
  if (is_new) {
    EXPECT_TRUE(equal(as_defined(found), brute_force_complexes(mesh_name)[field]));
  } else {
    EXPECT_TRUE(equal(found, entry->second)) << "than with other segments";
  }
}

}  // namespace

/// Copies have one gradient, which the first thread makes; if that fails the next one tries.
TEST(Excerpt, is_made_once_and_anew_after_an_error) {
  const Mesh mesh(Grid({3, 4, 5}));
  const std::vector<Id> values(mesh.vertices(), 1);
  const DiscreteGradient gradient = find_discrete_gradient(VertexOrder(mesh, values.data(), values.size()));
  std::atomic<int> calls = 0;
  const Excerpt excerpt([&] {
    if (++calls == 1) throw Error("not yet");
    return gradient;
  });
  const Excerpt copy = excerpt;
  EXPECT_EQ(message_of([&] { copy.gradient(); }), "not yet");
  on_threads(4, [&](int) { EXPECT_EQ(&excerpt.gradient(), &copy.gradient()); });
  EXPECT_EQ(calls, 2);
  EXPECT_TRUE(excerpt.mesh() == mesh);
  EXPECT_TRUE(Excerpt(gradient).mesh() == mesh);
}

class MorseSmaleComplexOf : public EveryMesh {};

TEST_P(MorseSmaleComplexOf, every_mesh_is_that_of_brute_force_whatever_the_structure_segments_and_threads) {
  const Mesh mesh = encode(input(), segmentation());
  const auto fields = fields_on(input());
  const auto kinds = structure_kinds();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    SCOPED_TRACE(fields[i].name);
    const auto structure = kinds[0].make(mesh, morse_smale_relations);
    const auto complex = complex_of(*structure, fields[i], 1);
    expect_the_one(mesh_name(), i, named(complex));
    const auto& kind = kinds[(i + 1) % kinds.size()];
    const int threads = i % 2 == 0 ? 8 : 2;
    EXPECT_TRUE(equal(complex_of(*kind.make(mesh, morse_smale_relations), fields[i], threads), complex)) << kind.name;
    EXPECT_TRUE(equal(complex_of_kernels(*structure, fields[i]), without_separatrices2(complex))) << "by kernels";
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, MorseSmaleComplexOf, every_mesh_and_segmentations_in_turn(), mesh_and_segmentation);

TEST(MorseSmaleComplex, of_some_parts_has_them_as_the_whole_has_them) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, 100);
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

TEST(MorseSmaleComplex, has_the_same_connectors_however_many_walls_grow_side_by_side) {
  const InputMesh input = holed_grid(30);
  const Mesh mesh = encode(input, 100);
  const auto structure = structure_kinds().front().make(mesh, morse_smale_relations);
  const auto field = random_field(input, 1);
  const VertexOrder order(mesh, field.data(), field.size());
  const auto gradient = find_discrete_gradient(WorkerSpace(), order);
  ASSERT_TRUE(gradient.store().is_from_kernels());
  const auto& critical = gradient.critical();
  const detail::CriticalPlaces places(critical);
  MorseSmaleComplex found{gradient, {}, critical}, expected = found;
  expected.connectors = detail::descending_surfaces(gradient, critical, places, false, true, 2).connectors;
  ASSERT_GT(expected.connectors.count(), 10'000);
  for (const Offset together : {1, 100, 10'000, 100'000'000}) {
    auto connectors = detail::device_connectors(detail::wall_rows(gradient), critical, together);
    connectors.bring();
    found.connectors = std::move(connectors.paths);
    EXPECT_TRUE(equal(found, expected)) << together;
  }
}

TEST(MorseSmaleComplex, has_connectors_named_where_they_were_found) {
  const InputMesh input = holed_grid(20);
  const Mesh mesh = encode(input, 100);
  const auto field = random_field(input, 1);
  const VertexOrder order(mesh, field.data(), field.size());
  const auto gradient = find_discrete_gradient(WorkerSpace(), order);
  const auto& critical = gradient.critical();
  const auto rows = detail::wall_rows(gradient);
  const auto find = [&](Offset together) { return detail::device_connectors(rows, critical, together); };
  auto expected = find(100'000'000);
  expected.bring();
  const OtherIds names = mesh.vertices_in_input();
  detail::NumberedSet passed(mesh.vertices());
  for (const auto& triangle : expected.paths.cells) {
    for (const Id vertex : triangle) passed.insert(names[vertex]);
  }
  passed.number();
  for (const bool are_numbered : {false, true}) {
    for (const Offset together : {20'000, 100'000'000}) {
      auto found = find(together);
      ASSERT_GT(found.triangles.size(), together == 20'000 ? 1u : 0u);
      const auto bits = detail::names_passed(found.triangles, found.names, mesh.vertices());
      for (std::size_t w = 0; w < bits.size(); ++w) ASSERT_EQ(bits[w], passed.words()[w].bits) << w;
      detail::rename_vertices(found.triangles, found.names, are_numbered ? &passed : nullptr);
      found.bring();
      ASSERT_EQ(found.paths.cells.size(), expected.paths.cells.size());
      for (std::size_t i = 0; i < expected.paths.cells.size(); ++i) {
        auto triangle = expected.paths.cells[i];
        for (Id& vertex : triangle) vertex = are_numbered ? passed[names[vertex]] : names[vertex];
        ASSERT_EQ(found.paths.cells[i], triangle) << i;
      }
    }
  }
}

TEST(MorseSmaleComplex, needs_VT_for_its_surfaces) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, 100);
  const auto structure = structure_kinds().front().make(mesh, morse_smale_relations);
  const auto field = fields_on(input).front();
  const VertexOrder order(mesh, field.values.data(), field.values.size());
  const auto gradient = find_discrete_gradient(*structure, order);
  const auto without = structure_kinds().front().make(mesh, Relation::VV);
  EXPECT_THROW(find_morse_smale_complex(*without, gradient, all_parts()), Error);
  EXPECT_TRUE(equal(find_morse_smale_complex(*without, gradient), find_morse_smale_complex(*structure, gradient)))
      << "what reads no relation";
}

TEST(MorseSmaleComplex, refuses_an_order_or_a_gradient_of_another_mesh) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, 100), other = encode(input, 50);
  const auto field = fields_on(input).front();
  const VertexOrder order(mesh, field.values.data(), field.values.size());
  constexpr RelationSet relations = morse_smale_relations | discrete_gradient_from_cells_relations;
  const auto structure = structure_kinds().front().make(mesh, relations);
  const auto structure_of_other = structure_kinds().front().make(other, relations);
  const auto gradient = find_discrete_gradient(*structure, order);
  const auto is_refused = [](const std::string& message) {
    return message.find("the structure of another one") != std::string::npos;
  };
  EXPECT_PRED1(is_refused, message_of([&] { find_discrete_gradient(*structure_of_other, order); }));
  EXPECT_PRED1(is_refused, message_of([&] { find_discrete_gradient_from_cells(*structure_of_other, order); }));
  EXPECT_PRED1(is_refused, message_of([&] { find_morse_smale_complex(*structure_of_other, gradient); }));
}

}  // namespace gale::test
