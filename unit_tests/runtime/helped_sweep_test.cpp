#include <atomic>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/runtime/helpers/helped_sweep.hpp>
#include <gale/runtime/make_structure.hpp>
#include <gale/runtime/sweep.hpp>

#include "support/brute_force.hpp"
#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

constexpr std::size_t much = std::size_t(1) << 30;
constexpr int ring = 8;  ///< blocks that a helper keeps

using Hook = std::function<void(Id)>;

/// Computes VV, and does something before it.
class Hooked : public detail::SegmentWorker {
 public:
  Hooked(const Mesh& mesh, ConsumerStatistics& statistics, int kept, Hook hook)
      : SegmentWorker(mesh, Relation::VV, statistics, kept), hook_(std::move(hook)) {}

  SegmentRows compute(Id segment) override {
    if (hook_) hook_(segment);
    return SegmentWorker::compute(segment);
  }

 private:
  Hook hook_;
};

struct HelpedMesh {
  const InputMesh& input = mesh_named("holed_grid_9");
  Mesh mesh = encode(input, 7);
  ExpectedRows expected{input, brute_force_of("holed_grid_9"), mesh};

  detail::MakeWorker hooked(Hook hook) const {
    return [this, hook](ConsumerStatistics& statistics, int kept) {
      return std::make_unique<Hooked>(mesh, statistics, kept, hook);
    };
  }

  /// Sweeps over all segments. Before each body, calls `before` with its segment.
  void sweep(detail::HelpedSweep& helped, int consumers, const Hook& before = {}) const {
    std::vector<std::atomic<int>> visits(mesh.segments());
    std::atomic<int> wrong{0};
    SweepOptions options;
    options.threads = consumers;
    detail::sweep(mesh.segments(), options, [&](int consumer, Id) {
      helped.read_next(consumer, [&](const SegmentRows& rows) {
        if (before) before(rows.segment());
        ++visits[rows.segment()];
        wrong += !expected.match(rows, Relation::VV);
      });
    });
    helped.end();
    EXPECT_EQ(wrong, 0);
    for (const auto& count : visits) ASSERT_EQ(count, 1);
  }
};

void wait_until(const std::function<bool()>& condition) {
  while (!condition()) std::this_thread::yield();
}

std::int64_t hits(const detail::HelpedSweep& helped) {
  StructureStatistics statistics;
  statistics.consumers = helped.of_consumers();
  return statistics.all_consumers().hits;
}

}  // namespace

TEST(HelpedSweep, runs_ahead_of_a_consumer_until_the_ring_is_full) {
  const HelpedMesh fixture;
  std::atomic<int> made{0};
  detail::HelpedSweep helped({0, fixture.mesh.segments()}, 1, fixture.hooked({}), 1,
                             fixture.hooked([&](Id) { ++made; }), much);
  bool first = true;
  fixture.sweep(helped, 1, [&](Id) {
    if (std::exchange(first, false)) wait_until([&] { return made >= ring; });
  });
  EXPECT_GE(hits(helped), ring - 1);
  EXPECT_EQ(helped.of_helpers().segments_computed, made);
  EXPECT_GT(helped.block_bytes(), 0u);
}

TEST(HelpedSweep, keeps_no_more_blocks_than_the_ring_has) {
  const HelpedMesh fixture;
  constexpr int consumers = 2;
  std::vector<std::atomic<bool>> by_helper(fixture.mesh.segments());
  std::atomic<int> unread{0}, most{0};
  const auto make = fixture.hooked([&](Id segment) {
    by_helper[segment] = true;
    most = std::max<int>(most, ++unread);
  });
  detail::HelpedSweep helped({0, fixture.mesh.segments()}, consumers, fixture.hooked({}), 1, make, much);
  fixture.sweep(helped, consumers, [&](Id segment) { unread -= by_helper[segment]; });
  EXPECT_LE(most, ring) << "those that are being read not counted";
}

TEST(HelpedSweep, waits_for_no_helper_that_is_put_aside) {
  const HelpedMesh fixture;
  for (const int consumers : {1, 3}) {
    constexpr int helpers = 4;
    std::vector<std::atomic<bool>> read(fixture.mesh.segments());
    std::atomic<int> aside{0};
    const auto make = fixture.hooked([&](Id segment) {
      ++aside;
      wait_until([&] { return read[segment].load(); });
    });
    detail::HelpedSweep helped({0, fixture.mesh.segments()}, consumers, fixture.hooked({}), helpers, make, much);
    fixture.sweep(helped, consumers, [&](Id segment) {
      wait_until([&] { return aside == helpers; });
      read[segment] = true;
    });
    EXPECT_EQ(hits(helped), 0);
    EXPECT_EQ(helped.of_helpers().segments_computed, helpers) << "in vain";
  }
}

TEST(HelpedSweep, goes_on_without_helpers_that_fail) {
  const HelpedMesh fixture;
  std::atomic<int> failed{0};
  const auto fail = [&](Id) {
    ++failed;
    throw std::bad_alloc();
  };
  const detail::MakeWorker cannot_make = [&](ConsumerStatistics&, int) -> std::unique_ptr<detail::SegmentWorker> {
    fail(0);
    return nullptr;
  };
  for (const auto& make : {fixture.hooked(fail), cannot_make}) {
    failed = 0;
    detail::HelpedSweep helped({0, fixture.mesh.segments()}, 2, fixture.hooked({}), 5, make, much);
    fixture.sweep(helped, 2, [&](Id) { wait_until([&] { return failed == 5; }); });
    EXPECT_EQ(hits(helped), 0);
  }
}

TEST(HelpedSweep, hands_a_failure_that_consumers_have_as_well_to_the_caller) {
  const HelpedMesh fixture;
  const Id bad = fixture.mesh.segments() / 2;
  const auto make = fixture.hooked([&](Id segment) {
    if (segment == bad) throw Error("segment " + std::to_string(segment) + " is bad");
  });
  for (const int helpers : {1, 5}) {
    detail::HelpedSweep helped({0, fixture.mesh.segments()}, 2, make, helpers, make, much);
    EXPECT_EQ(message_of([&] { fixture.sweep(helped, 2); }), "segment " + std::to_string(bad) + " is bad");
  }
}

TEST(HelpedSweep, has_no_help_from_those_that_the_budget_is_too_small_for) {
  const HelpedMesh fixture;
  detail::HelpedSweep helped({0, fixture.mesh.segments()}, 1, fixture.hooked({}), 3, fixture.hooked({}), 1000);
  fixture.sweep(helped, 1);
  EXPECT_EQ(helped.of_helpers().segments_computed, 0);
}

TEST(Helpers, are_as_many_as_cores_without_a_consumer) {
  const HelpedMesh fixture;
  StructureOptions options;
  options.way = Way::helpers;
  options.cores = 4;
  for (const int threads : {1, 3, 4, 9}) {
    const auto runtime = make_structure(fixture.mesh, Relation::VV, options);
    SweepOptions sweep;
    sweep.threads = threads;
    runtime->for_each_segment(Relation::VV, sweep, [](int, const SegmentRows&) {});
    const auto statistics = runtime->statistics();
    const auto consumers = statistics.all_consumers();
    EXPECT_EQ(runtime->way(), Way::helpers);
    EXPECT_EQ(statistics.consumers.size(), static_cast<std::size_t>(threads));
    EXPECT_EQ(consumers.hits + consumers.segments_computed, fixture.mesh.segments());
    EXPECT_GE(statistics.helpers.segments_computed, consumers.hits);
    if (threads >= options.cores) EXPECT_EQ(statistics.helpers.segments_computed, 0);
  }
}

TEST(Ways, refuse_options_below_0) {
  const HelpedMesh fixture;
  for (const Way way : {Way::helpers, Way::inline_, Way::explicit_}) {
    const auto message = [&](StructureOptions options) {
      options.way = way;
      return message_of([&] { make_structure(fixture.mesh, Relation::VV, options); });
    };
    StructureOptions cores, blocks;
    cores.cores = -1;
    EXPECT_EQ(message(cores), "cores must be at least 1, not -1");
    blocks.blocks_per_request = -3;
    EXPECT_EQ(message(blocks), "blocks per request must be at least 1, not -3");
  }
}

}  // namespace gale::test
