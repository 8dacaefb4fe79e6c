#include "outputs/outputs_of.hpp"

#include <numeric>

#include <gale/outputs/named_simplices.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/segmentations.hpp"

namespace gale::test {

InputMesh unit_tetrahedron() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{2, 0, 3, 1}}}; }

InputMesh two_tetrahedra() {
  return {{{0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, 0, -1}}, {{0, 1, 2, 3}, {4, 2, 1, 3}}};
}

InputMesh octahedron() { return cone_over_caps(6, 2); }

io::Dataset dataset_of(const InputMesh& mesh) {
  io::Dataset dataset;
  const io::Dataset::Points<double> points("points", mesh.points.size());
  Kokkos::deep_copy(points, points_of<double>(mesh));
  dataset.points = points;
  dataset.tetrahedra = decltype(dataset.tetrahedra)("tetrahedra", mesh.tetrahedra.size());
  Kokkos::deep_copy(dataset.tetrahedra, tetrahedra_of<std::int32_t>(mesh));
  return dataset;
}

OutputsOf outputs_of(const InputMesh& input, const std::vector<double>& field, const MorseSmaleParts& parts) {
  io::Dataset dataset = dataset_of(input);
  std::vector<std::int32_t> places(field.size());
  std::iota(places.begin(), places.end(), 0);
  dataset.arrays = {{"field", 1, field}, {"place", 1, places}};
  const Mesh mesh = encode(input, 3);
  const VertexOrder order(mesh, field.data(), field.size());
  const auto structure = make_structure(mesh, morse_smale_relations);
  const DiscreteGradient gradient = find_discrete_gradient(*structure, order);
  MorseSmaleComplex complex = find_morse_smale_complex(*structure, gradient, parts);
  outputs::NamedPaths named = outputs::named_simplices(complex);
  SimplexNumbers numbers = number_simplices(*structure, named);
  outputs::KnownSimplices critical = outputs::known_simplices(gradient, complex.critical, numbers);
  return {dataset, dataset.arrays.front(), complex, named, numbers, critical};
}

std::vector<std::string> names_of(const std::vector<io::PointArray>& arrays) {
  std::vector<std::string> names;
  for (const auto& array : arrays) names.push_back(array.name);
  return names;
}

void expect_points(const std::variant<io::Dataset::Points<float>, io::Dataset::Points<double>>& points,
                   const std::vector<std::array<double, 3>>& expected) {
  std::visit(
      [&](const auto& all) {
        ASSERT_EQ(all.extent(0), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
          for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(all(i, axis), expected[i][axis], 1e-12) << i << ' ' << axis;
        }
      },
      points);
}

}  // namespace gale::test
