#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/discrete_gradient.hpp>

#include "algorithms/fields.hpp"
#include "support/surfaces.hpp"

namespace gale::test {

/// Loops over `surfaces()`.
class SurfaceTest : public testing::TestWithParam<std::string> {
 protected:
  const InputSurface& surface() const { return surfaces().at(GetParam()); }
};

/// For INSTANTIATE_TEST_SUITE_P.
testing::internal::ParamGenerator<std::string> surface_names();
std::string surface_name(const testing::TestParamInfo<std::string>& info);

/// Its points, for those that make fields.
InputMesh points_of_surface(const InputSurface& surface);

/// The vertices that share an edge with each, ascending.
std::vector<std::vector<Id>> neighbours_on_surface(const InputSurface& surface);

/// Finds the gradient as users do.
DiscreteGradient gradient_on_surface(const Mesh& mesh, const std::vector<double>& field);

/// Whether an edge has three triangles or more.
bool has_forks(const InputSurface& surface);

/// Any triangles, or a plane with holes two vertices of which are one, of few vertices.
InputSurface random_surface(unsigned seed);

/// N^2 points with the field of a known grid's lowest layer, which other programs were run on.
struct KnownPlane {
  explicit KnownPlane(Id n);

  InputSurface surface;
  std::vector<float> field;
};

}  // namespace gale::test
