#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/io/write.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/named_simplices.hpp>

#include "support/input_mesh.hpp"

namespace gale::test {

/// A tetrahedron at the origin and one unit along each axis: input vertices 0, 1 (x), 2 (y) and 3 (z).
InputMesh unit_tetrahedron();

/// Tetrahedra 0123 and 1234. Triangle 123 lies in the plane z = 0, vertex 0 at z = 1 and vertex 4 at z = -1.
InputMesh two_tetrahedra();

/// An octahedron around its centre 0: vertices 1 (z = 1) and 2 (z = -1), and 3 to 6 around in the plane z = 0.
InputMesh octahedron();

/// A mesh as readers give it, without arrays.
io::Dataset dataset_of(const InputMesh& mesh);

/// A mesh with the point array "field" and "place" (0, 1, 2 ...), its complex, and what all outputs take.
struct OutputsOf {
  io::Dataset dataset;
  io::PointArray field;
  MorseSmaleComplex complex;
  outputs::NamedPaths named;
  SimplexNumbers numbers;
  outputs::KnownSimplices critical;
};

/// All parts, 2-separatrices too, unless others are wanted.
OutputsOf outputs_of(const InputMesh& mesh, const std::vector<double>& field,
                     const MorseSmaleParts& parts = {true, true, true, true, true, true});

std::vector<std::string> names_of(const std::vector<io::PointArray>& arrays);

/// The values of the array of that name. Fails, and returns none, if there is none or it has another type.
template <class T>
std::vector<T> values_of(const std::vector<io::PointArray>& arrays, const std::string& name) {
  for (const auto& array : arrays) {
    if (array.name != name) continue;
    if (const auto* const values = std::get_if<std::vector<T>>(&array.values)) return *values;
    ADD_FAILURE() << name << " is of another type";
    return {};
  }
  ADD_FAILURE() << "no array " << name;
  return {};
}

/// Are these the points, to 1e-12?
void expect_points(const std::variant<io::Dataset::Points<float>, io::Dataset::Points<double>>& points,
                   const std::vector<std::array<double, 3>>& expected);

}  // namespace gale::test
