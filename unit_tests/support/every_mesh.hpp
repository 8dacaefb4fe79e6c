#pragma once

#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "support/segmentations.hpp"

namespace gale::test {

/// A test that is run with each of `mesh_names()` and each of `segmentation_names()`.
class EveryMesh : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  const std::string& mesh_name() const { return std::get<0>(GetParam()); }
  const InputMesh& input() const { return mesh_named(mesh_name()); }
  Segmentation segmentation() const { return segmentation_named(std::get<1>(GetParam()), input()); }
};

inline auto every_mesh_and_segmentation() {
  return testing::Combine(testing::ValuesIn(mesh_names()), testing::ValuesIn(segmentation_names()));
}

/// Each mesh with every second segmentation, each of these with every second mesh: for analyses, whose rows have been
/// compared on every mesh with every segmentation.
inline auto every_mesh_and_segmentations_in_turn() {
  std::vector<EveryMesh::ParamType> all;
  std::size_t turn = 0;
  for (const std::string& mesh : mesh_names()) {
    const auto& segmentations = segmentation_names();
    for (std::size_t i = turn++ % 2; i < segmentations.size(); i += 2) all.emplace_back(mesh, segmentations[i]);
  }
  return testing::ValuesIn(all);
}

inline std::string mesh_and_segmentation(const testing::TestParamInfo<EveryMesh::ParamType>& info) {
  return std::get<0>(info.param) + "__" + std::get<1>(info.param);
}

}  // namespace gale::test
