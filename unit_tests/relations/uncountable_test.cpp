#include <gtest/gtest.h>

#include <gale/relations/kernels/segment_kernel.hpp>
#include <gale/runtime/batches/host_worker.hpp>

#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

/// Each of 70000 edges at one vertex has the others for neighbours: nearly 5 billion entries.
TEST(Uncountable, entries_of_one_segment_are_refused_by_name) {
  const InputMesh input = cone_over_disc(70000);
  const Mesh mesh = encode(input, 1000000);
  HostWorker worker(mesh, Relation::EE);
  EXPECT_EQ(message_of([&] { worker.compute(0); }),
            "segment 0 has more than 2147483647 entries of EE: use smaller segments");
}

TEST(Uncountable, blocks_of_a_batch_are_refused_by_their_segment) {
  const Id segments[] = {3, 8};
  const Offset all[] = {0, 16, 32, 64}, some[] = {0, 16, 32, BlockPool::missing},
               more[] = {0, 16, BlockPool::uncountable, 64};
  const auto batch_of = [&](const Offset* directory) {
    return Batch<HostMemory>{Relation::VV | Relation::VT, 2, segments, directory, nullptr, {}};
  };
  EXPECT_TRUE(are_there(batch_of(all)));
  EXPECT_FALSE(are_there(batch_of(some)));
  EXPECT_EQ(message_of([&] { are_there(batch_of(more)); }),
            "segment 8 has more than 2147483647 entries of VT, VV: use smaller segments");
}

}  // namespace gale::test
