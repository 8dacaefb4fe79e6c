#include <functional>
#include <limits>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/baselines/discrete_gradient_from_cells.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/runtime/explicit/explicit_structure.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/every_mesh.hpp"
#include "support/with_threads.hpp"

namespace gale::test {

namespace {

struct FormulatedStructure {
  const char* name;
  std::function<std::unique_ptr<Structure>(const Mesh&, RelationSet)> make;
};

std::unique_ptr<Structure> make_runtime(const Mesh& mesh, RelationSet relations, Way production) {
  StructureOptions options;
  options.way = production;
  return make_structure(mesh, relations, options);
}

std::vector<FormulatedStructure> kinds_of_structures() {
  std::vector<FormulatedStructure> kinds = {
      {"consumers",
       [](const Mesh& mesh, RelationSet relations) { return make_runtime(mesh, relations, Way::inline_); }},
      {"leaders", [](const Mesh& mesh, RelationSet relations) { return make_runtime(mesh, relations, Way::leaders); }}};
#if defined(GALE_ENABLE_KOKKOS_KERNELS)
  kinds.push_back({"explicit", [](const Mesh& mesh, RelationSet relations) {
                     return std::make_unique<ExplicitStructure>(mesh, relations);
                   }});
#endif
  return kinds;
}

/// Few values, so that ties matter; one value; falling from the first vertex, which is the apex of the cones, and
/// rising; any; and infinities.
std::vector<std::vector<float>> float_fields_on(const InputMesh& mesh) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::mt19937 random(20261122);
  std::vector<std::vector<float>> fields(6);
  for (Id v = 0; v < mesh.vertices(); ++v) {
    const int any = static_cast<int>(random() % 16);
    fields[0].push_back(static_cast<float>(any - 8));
    fields[1].push_back(3.5f);
    fields[2].push_back(static_cast<float>(-v));
    fields[3].push_back(static_cast<float>(v));
    fields[4].push_back(v == 0 ? infinity : static_cast<float>(random() % 1000003));
    fields[5].push_back(any < 3 ? -infinity : any > 12 ? infinity : static_cast<float>(any));
  }
  return fields;
}

void expect_equal(const Array<const Id, HostMemory>& one, const Array<const Id, HostMemory>& other, const char* what) {
  ASSERT_EQ(one.extent(0), other.extent(0));
  for (std::size_t i = 0; i < one.extent(0); ++i) ASSERT_EQ(one(i), other(i)) << what << ' ' << i;
}

/// Compares the pairs of vertices, edges and tetrahedra: the others follow from them.
void expect_same(const DiscreteGradient& gradient, const DiscreteGradient& expected) {
  EXPECT_EQ(gradient.critical().vertices, expected.critical().vertices);
  EXPECT_EQ(gradient.critical().edges, expected.critical().edges);
  EXPECT_EQ(gradient.critical().triangles, expected.critical().triangles);
  EXPECT_EQ(gradient.critical().cells, expected.critical().cells);
  EXPECT_EQ(gradient.critical().star_begin, expected.critical().star_begin);
  EXPECT_EQ(gradient.critical().star, expected.critical().star);
  expect_equal(gradient.vertex_successors(), expected.vertex_successors(), "vertex");
  expect_equal(gradient.cell_successors(), expected.cell_successors(), "tetrahedron");
  const auto simplices = expected.mesh().simplices({Enumeration::edges});
  for (std::size_t e = 0; e < simplices.edge_low.extent(0); ++e) {
    const Id a = simplices.edge_low(e), b = simplices.edge_high(e);
    ASSERT_EQ(gradient.triangle_of_edge(a, b), expected.triangle_of_edge(a, b)) << "edge " << a << ' ' << b;
  }
}

}  // namespace

class GradientFormulationsOn : public EveryMesh {};

TEST_P(GradientFormulationsOn, every_mesh_agree_pair_by_pair_on_every_structure) {
  const Mesh mesh = encode(input(), segmentation());
  const auto stars = make_structure(mesh, discrete_gradient_relations);
  std::vector<std::unique_ptr<Structure>> structures;
  for (const auto& kind : kinds_of_structures())
    structures.push_back(kind.make(mesh, discrete_gradient_from_cells_relations));
  for (const auto& field : float_fields_on(input())) {
    const VertexOrder order(mesh, field.data(), field.size());
    const DiscreteGradient expected = find_discrete_gradient(*stars, order, with_threads(2));
    for (std::size_t i = 0; i < structures.size(); ++i) {
      SCOPED_TRACE(kinds_of_structures()[i].name);
      expect_same(find_discrete_gradient_from_cells(*structures[i], order, with_threads(2)), expected);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, GradientFormulationsOn, every_mesh_and_segmentations_in_turn(), mesh_and_segmentation);

/// The counts of the synthetic meshes that other programs find too.
TEST(GradientFromCells, has_the_known_counts_on_a_grid) {
  const io::Dataset dataset = io::make_grid(32);
  const auto& points = std::get<io::Dataset::Points<float>>(dataset.points);
  const auto& field = std::get<std::vector<float>>(dataset.arrays.front().values);
  const Mesh mesh(Tetrahedra<Id, HostMemory>(dataset.tetrahedra),
                  octree_segmentation<float, HostMemory>(Points<float, HostMemory>(points), 100));
  const VertexOrder order(mesh, field.data(), field.size());
  const auto stars = make_structure(mesh, discrete_gradient_relations);
  const DiscreteGradient expected = find_discrete_gradient(*stars, order);
  for (const auto& kind : kinds_of_structures()) {
    const auto structure = kind.make(mesh, discrete_gradient_from_cells_relations);
    for (const int threads : {1, 8}) {
      SCOPED_TRACE(kind.name);
      const DiscreteGradient gradient = find_discrete_gradient_from_cells(*structure, order, with_threads(threads));
      EXPECT_EQ(gradient.critical().counts(), (std::array<Id, 4>{26, 59, 37, 3}));
      expect_same(gradient, expected);
    }
  }
}

TEST(GradientFromCells, needs_the_relations_that_it_reads) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), 100);
  const std::vector<float> field(4, 1.0f);
  const VertexOrder order(mesh, field.data(), field.size());
  const auto coboundary = make_structure(mesh, Relation::VE | Relation::VF | Relation::VT);
  EXPECT_THROW(find_discrete_gradient_from_cells(*coboundary, order), Error);
}

}  // namespace gale::test
