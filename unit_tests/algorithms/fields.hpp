#pragma once

#include <string>
#include <vector>

#include "support/input_mesh.hpp"

namespace gale::test {

/// A value for each vertex, in input order. Floats hold them exactly.
struct Field {
  std::string name;
  std::vector<double> values;

  std::vector<float> floats() const { return {values.begin(), values.end()}; }
};

/// Few values, so that ties matter; one value; a slope; infinities; and a permutation, which has no ties.
std::vector<Field> fields_on(const InputMesh& mesh);

/// A permutation of 0..vertices-1.
std::vector<double> random_field(const InputMesh& mesh, unsigned seed);

}  // namespace gale::test
