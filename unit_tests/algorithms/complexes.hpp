#pragma once

#include <functional>
#include <memory>

#include "algorithms/fields.hpp"
#include "algorithms/named_complex.hpp"

namespace gale::test {

/// A mesh and a field on it, and what GALE finds: all parts, with one structure.
class ComplexOf {
 public:
  ComplexOf(const InputMesh& input, const std::vector<double>& field);

  const InputMesh& input() const { return input_; }
  const std::vector<double>& field() const { return field_; }
  const MorseSmaleComplex& complex() const { return *complex_; }
  const NamedComplex& all() const { return named_; }

  NamedComplex simplified(double threshold) const;

 private:
  InputMesh input_;
  std::vector<double> field_;
  std::shared_ptr<const MorseSmaleComplex> complex_;
  NamedComplex named_;
};

/// A value by the position of each vertex.
std::vector<double> field_by(const InputMesh& mesh, const std::function<double(double x, double y, double z)>& value);

}  // namespace gale::test
