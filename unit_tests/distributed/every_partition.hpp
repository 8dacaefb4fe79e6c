#pragma once

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include <gtest/gtest.h>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/base/threads.hpp>

#include "algorithms/fields.hpp"
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

  /// Threads of this rank: of one mesh more than it has processors, which find things in other orders.
  class Threads {
   public:
    explicit Threads(const std::string& mesh) : before_(host_threads()) {
      if (mesh == input_names()[1]) set_host_threads(3);
    }
    ~Threads() { set_host_threads(before_); }

   private:
    const int before_;
  };

  const Threads threads_{mesh_name()};
  const Communicator ranks_{MPI_COMM_WORLD, 1000};  // so that messages are cut
  const GivenPart part_ = part_of(input(), partition(), ranks_);
  const DistributedMesh mesh_ = distribute(ranks_, part_, partition());

  /// What make() finds of the whole mesh with the field `name`: once for all partitions of it, which follow one
  /// another.
  template <class Make>
  const auto& once(const std::string& name, const Make& make) const {
    using Found = std::map<std::string, std::decay_t<decltype(make())>>;
    static auto& found = *new Found;  // which outlives Kokkos
    static std::string of_mesh;
    if (std::exchange(of_mesh, mesh_name()) != mesh_name()) found.clear();
    const auto at = found.find(name);
    return at != found.end() ? at->second : found.emplace(name, make()).first->second;
  }

  /// Two of `fields_on(input())`; on three ranks and more, each of which finds again what is expected, one of them, the
  /// other with the next mesh. All where GALE_WHOLE_BRAINS asks for what takes long.
  std::vector<Field> fields_of_turn(int one, int other) const {
    const auto all = fields_on(input());
    if (ranks_.size() <= 2 || std::getenv("GALE_WHOLE_BRAINS") != nullptr) return {all[one], all[other]};
    const auto& names = input_names();
    const auto place = std::find(names.begin(), names.end(), mesh_name()) - names.begin();
    return {all[(place + ranks_.size() / 2) % 2 == 0 ? one : other]};
  }

  /// A field on this rank's part: a permutation in 64 bits a value, others, with their ties, in 32.
  VertexOrder order_here(const Field& field) const {
    if (field.name == "permutation") return VertexOrder(mesh_, part_.values(field.values));
    return VertexOrder(mesh_, part_.values(field.floats()));
  }

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
