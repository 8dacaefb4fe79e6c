#include <gale/algorithms/morse_smale.hpp>
#include <gale/distributed/distributed_manifolds.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/fields.hpp"
#include "distributed/every_partition.hpp"
#include "support/arrays.hpp"
#include "support/segmentations.hpp"
#include "support/with_threads.hpp"

namespace gale::test {

class ComplexOnRanks : public EveryPartition {
 protected:
  /// The complex of the whole mesh, on this rank alone.
  MorseSmaleComplex complex_on_one(const std::vector<double>& values) const {
    const Mesh whole = encode(input(), 100);
    const auto structure = make_structure(whole, discrete_gradient_relations);
    return find_morse_smale_complex(
        *structure, find_discrete_gradient(*structure, VertexOrder(whole, values.data(), values.size())));
  }

  DistributedGradient gradient_of(const std::vector<double>& values) const {
    const DistributedOrder order(mesh_, part_.values(values));
    return find_discrete_gradient(*make_structure(mesh_.local(), discrete_gradient_relations), order);
  }

  /// Has each local vertex the number that it has in the whole mesh?
  void expect_numbers(const Array<const GlobalId, HostMemory>& found, const std::vector<Id>& expected) const {
    ASSERT_EQ(found.extent(0), mesh_.vertex_ids().extent(0));
    for (std::size_t i = 0; i < found.extent(0); ++i) {
      const Id v = vertex_named(mesh_.vertex_ids()(i));
      EXPECT_EQ(found(i), expected[v]) << "vertex " << v;
    }
  }
};

TEST_P(ComplexOnRanks, manifolds_are_those_of_one_rank) {
  for (const Field& field : {fields_on(input())[0], fields_on(input())[2]}) {
    SCOPED_TRACE(field.name);
    const MorseSmaleComplex whole = complex_on_one(field.values);
    const DistributedManifolds found = find_manifolds(gradient_of(field.values));
    expect_numbers(found.descending, to_vector(whole.descending_manifold));
    expect_numbers(found.ascending, to_vector(whole.ascending_manifold));
    expect_numbers(found.morse_smale, to_vector(whole.morse_smale_manifold));
    EXPECT_EQ(found.morse_smale_manifolds, whole.morse_smale_manifolds);
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, ComplexOnRanks, every_mesh_and_partition(), mesh_and_partition);

TEST(DistributedManifolds, take_few_rounds_for_long_paths) {
  const Communicator ranks(MPI_COMM_WORLD);
  const InputMesh& input = mesh_named("slivers");  // a strip of 60 vertices
  const GivenPart part = part_of(input, "random", ranks);
  const DistributedMesh mesh = distribute(ranks, part, "random");
  std::vector<int> values(input.vertices());
  for (Id v = 0; v < input.vertices(); ++v) values[v] = v;
  const auto structure = make_structure(mesh.local(), discrete_gradient_relations);
  const auto manifolds =
      find_manifolds(find_discrete_gradient(*structure, DistributedOrder(mesh, part.values(values))));
  for (std::size_t i = 0; i < manifolds.descending.extent(0); ++i) EXPECT_EQ(manifolds.descending(i), 0);
  EXPECT_LE(manifolds.rounds, 2 * 6);  // 2^6 steps are more than any path has
  if (ranks.size() == 1) EXPECT_EQ(manifolds.rounds, 0);
}

}  // namespace gale::test
