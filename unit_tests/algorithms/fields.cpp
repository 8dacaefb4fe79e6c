#include "algorithms/fields.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace gale::test {

std::vector<Field> fields_on(const InputMesh& mesh) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::mt19937 random(20261121);
  std::vector<Field> fields = {{"few_values", {}}, {"constant", {}}, {"slope", {}}, {"infinities", {}}};
  for (const auto& point : mesh.points) {
    const int any = static_cast<int>(random() % 16);
    fields[0].values.push_back(any - 8);
    fields[1].values.push_back(3.5);
    fields[2].values.push_back(static_cast<float>(point[0] + 0.1 * point[1]));
    fields[3].values.push_back(any < 3 ? -infinity : any > 12 ? infinity : any);
  }
  fields.push_back({"permutation", random_field(mesh, 5)});
  return fields;
}

std::vector<double> random_field(const InputMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> values(mesh.points.size());
  std::iota(values.begin(), values.end(), 0);
  std::shuffle(values.begin(), values.end(), random);
  return values;
}

}  // namespace gale::test
