#include <gtest/gtest.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/runtime/computation.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/fields.hpp"
#include "support/full_device.hpp"
#include "support/message_of.hpp"
#include "support/segmentations.hpp"

/// Analyses that choose by themselves where they compute.
namespace gale::test {

class Computation : public testing::Test {
 protected:
  const InputMesh input_ = holed_grid(9);
  const Mesh mesh_ = encode(input_, 20);
  const std::vector<double> field_ = random_field(input_, 1);
  const VertexOrder order_{mesh_, field_.data(), field_.size()};

  static ComputeOptions on(ConsumerPlace place, Way way = Way::gale) {
    ComputeOptions options;
    options.consumers = place;
    options.structure.way = way;
    return options;
  }
};

TEST_F(Computation, is_on_the_device_if_there_is_one) {
  Computed computed;
  const CriticalPoints found = find_critical_points(order_, {}, &computed);
  EXPECT_EQ(found.vertices, find_critical_points(*make_structure(mesh_, critical_points_relations), order_).vertices);
  EXPECT_EQ(computed.on_device, have_device);
  EXPECT_EQ(computed.structure == nullptr, have_device);
  EXPECT_TRUE(computed.notices.empty());
  EXPECT_GT(computed.seconds_running, 0);
}

TEST_F(Computation, is_on_the_host_if_that_is_wanted) {
  const auto counts = find_discrete_gradient(order_).critical().counts();
  for (const ComputeOptions& options :
       {on(ConsumerPlace::host), on(ConsumerPlace::host, Way::inline_), on(ConsumerPlace::best, Way::leaders)}) {
    Computed computed;
    EXPECT_EQ(find_discrete_gradient(order_, options, &computed).critical().counts(), counts);
    EXPECT_FALSE(computed.on_device);
    ASSERT_NE(computed.structure, nullptr);
    if (options.structure.way != Way::gale) EXPECT_EQ(computed.structure->way(), options.structure.way);
    EXPECT_GT(computed.seconds_preparing, 0);
  }
}

TEST_F(Computation, is_refused_where_kernels_are_wanted_that_cannot_be) {
  if (!have_device) {
    EXPECT_EQ(message_of([&] { find_critical_points(order_, on(ConsumerPlace::device)); }),
              "this gale has no device for consumers");
  } else {
    EXPECT_EQ(message_of([&] { find_critical_points(order_, on(ConsumerPlace::device, Way::inline_)); }),
              "the way 'inline' computes rows for consumers on the host");
  }
}

TEST_F(Computation, is_refused_without_a_structure_or_with_threads_that_nobody_has) {
  ComputeOptions options = on(ConsumerPlace::host);
  options.make_structure = [](const Mesh&, RelationSet) { return nullptr; };
  EXPECT_EQ(message_of([&] { find_critical_points(order_, options); }),
            "the options' make_structure has made no structure");
  ComputeOptions many;
  for (const int threads : {0, 100000}) {
    many.threads = threads;
    EXPECT_EQ(message_of([&] { find_critical_points(order_, many); }),
              "threads is " + std::to_string(threads) + ", not 1 to 1024");
  }
}

TEST_F(Computation, goes_on_with_the_structure_of_the_one_before) {
  Computed computed;
  const ComputeOptions host = on(ConsumerPlace::host);
  const DiscreteGradient gradient = find_discrete_gradient(order_, host, &computed);
  const auto made = computed.structure;
  MorseSmaleParts parts;
  parts.separatrices2 = true;
  find_morse_smale_complex(gradient, parts, host, &computed);
  number_simplices(mesh_, {gradient.critical().edges, gradient.critical().triangles}, host, &computed);
  EXPECT_EQ(computed.structure, made);
  const Mesh other = encode(input_, 7);
  number_simplices(other, {}, host, &computed);
  EXPECT_NE(computed.structure, made);
  EXPECT_TRUE(computed.structure->mesh() == other);
  EXPECT_TRUE(made->mesh() == mesh_);
}

/// What a device without room throws, from kernels that never run: so hosts test it, too.
TEST_F(Computation, goes_to_the_host_where_kernels_find_no_room) {
  const auto kernels = [](const DeviceSweepOptions&) -> int { throw OutOfMemory("Cuda has no 80 bytes for a test"); };
  const auto threads = [](Structure& structure) { return static_cast<int>(structure.relations().count()); };
  Computed computed;
  const ComputeOptions best;
  EXPECT_EQ(detail::Computing(mesh_, best, &computed).find_on(true, Relation::VV, kernels, threads), 1);
  EXPECT_FALSE(computed.on_device);
  ASSERT_EQ(computed.notices.size(), 1u);
  EXPECT_EQ(computed.notices[0],
            "the sweep doesn't fit the device's memory (Cuda has no 80 bytes for a test): consumers are on the host");
  EXPECT_EQ(computed.structure->way(), have_device ? Way::leaders : Way::helpers);

  if (!have_device) return;
  const ComputeOptions device = on(ConsumerPlace::device);
  EXPECT_THROW(detail::Computing(mesh_, device, &computed).find_on(true, Relation::VV, kernels, threads), OutOfMemory);
  const auto counts = find_discrete_gradient(order_).critical().counts();
  const FullDevice full(0);
  EXPECT_EQ(find_discrete_gradient(order_, {}, &computed).critical().counts(), counts);  // memory kept may have served
}

}  // namespace gale::test
