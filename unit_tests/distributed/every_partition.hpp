#pragma once

#include <algorithm>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "distributed/given_parts.hpp"
#include "support/segmentations.hpp"
#include "support/surfaces.hpp"

namespace gale::test {

/// A test that is run with each of `input_names()` cut in each of the ways `partition_names()`, on all ranks together.
class EveryPartition : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  const std::string& mesh_name() const { return std::get<0>(GetParam()); }
  const std::string& partition() const { return std::get<1>(GetParam()); }
  const InputMesh& input() const { return input_named(mesh_name()); }
  bool is_surface() const { return surfaces().count(mesh_name()) != 0; }

  /// The whole mesh, on this rank alone.
  Mesh whole_mesh() const { return is_surface() ? encode(surfaces().at(mesh_name()), 100) : encode(input(), 100); }

  const Communicator ranks_{MPI_COMM_WORLD, 1000};  // so that messages are cut
  const GivenPart part_ = part_of(input(), partition(), ranks_);
  const DistributedMesh mesh_ = distribute(ranks_, part_, partition());

  /// The input's number of a local vertex (GALE's id), of a cell.
  Id input_vertex(Id vertex) const { return vertex_named(mesh_.vertex_ids()(mesh_.vertex_input()(vertex))); }
  Id input_cell(Id cell) const { return cell_named(mesh_.cell_ids()(mesh_.cell_input()(cell))); }

  /// For each vertex of the input whether this rank owns it.
  std::vector<bool> owned() const {
    std::vector<bool> owned(input().vertices(), false);
    for (const Id v : mesh_.owned_vertices()) owned[input_vertex(v)] = true;
    return owned;
  }
};

inline auto every_mesh_and_partition() {
  return testing::Combine(testing::ValuesIn(input_names()), testing::ValuesIn(partition_names()));
}

inline std::string mesh_and_partition(const testing::TestParamInfo<EveryPartition::ParamType>& info) {
  std::string name = std::get<0>(info.param) + "__" + std::get<1>(info.param);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

}  // namespace gale::test
