#include "algorithms/complexes.hpp"

#include <gale/algorithms/simplify.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/segmentations.hpp"

namespace gale::test {

ComplexOf::ComplexOf(const InputMesh& input, const std::vector<double>& field) : input_(input), field_(field) {
  const Mesh mesh = encode(input, 50);
  const auto runtime = make_structure(mesh, morse_smale_relations);
  const VertexOrder order(mesh, field.data(), field.size());
  MorseSmaleParts parts;
  parts.separatrices2 = true;
  complex_ = std::make_shared<MorseSmaleComplex>(
      find_morse_smale_complex(*runtime, find_discrete_gradient(*runtime, order), parts));
  named_ = named(*complex_);
}

NamedComplex ComplexOf::simplified(double threshold) const {
  return named(simplify(
      *complex_, [this](Id v) { return field_.at(v); }, threshold));
}

std::vector<double> field_by(const InputMesh& mesh, const std::function<double(double x, double y, double z)>& value) {
  std::vector<double> field;
  for (const auto& point : mesh.points) field.push_back(value(point[0], point[1], point[2]));
  return field;
}

}  // namespace gale::test
