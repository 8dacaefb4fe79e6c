#include <algorithm>
#include <cstddef>

#include <gtest/gtest.h>

#include <gale/base/device.hpp>
#include <gale/base/error.hpp>
#include <gale/relations/batch.hpp>
#include <gale/relations/kernels/launch.hpp>
#include <gale/relations/kernels/star_kernel.hpp>

#include "relations/star_subsets.hpp"
#include "support/arrays.hpp"
#include "support/brute_force.hpp"
#include "support/every_mesh.hpp"

namespace gale::test {

namespace {

/// A batch of all segments of a mesh, launched in the workers' space, with memory of given sizes.
class LaunchedStars {
 public:
  LaunchedStars(const Mesh& mesh, RelationSet wanted, const StarSizes& sizes, int level, Offset capacity)
      : mesh_(mesh), wanted_(wanted), sizes_(sizes), level_(level), capacity_(capacity) {}

  void run(int warps) {
    const Id segments = mesh_.segments();
    std::vector<Id> list(segments);
    for (Id s = 0; s < segments; ++s) list[s] = segments - 1 - s;
    const auto segment_list = to_worker(list);
    const auto words = allocate<Array<Id, WorkerMemory>>("words", capacity_);
    const Array<Offset, WorkerMemory> used("used", 1), directory("directory", Offset(segments) * wanted_.count());
    const auto needed = to_worker(std::vector<StarSizes>(1));
    StarKernel<WorkerMemory, 4> kernel;
    kernel.mesh = mesh_.encoded<WorkerMemory>();
    kernel.segments = segment_list.data();
    kernel.wanted = wanted_;
    kernel.sizes = sizes_;
    kernel.scratch_level = level_;
    kernel.pool = {words.data(), capacity_, used.data(), directory.data(), needed.data()};
    const WorkerSpace instance = make_instance();
    launch(instance, kernel, segments, warps);
    instance.fence();
    words_ = to_vector(words);
    directory_ = to_vector(directory);
    used_ = to_vector(used)[0];
    needed_ = to_vector(needed)[0];
  }

  bool has(Id segment) const { return missing_blocks(segment) == 0; }
  bool lacks(Id segment) const { return missing_blocks(segment) == wanted_.count(); }

  bool has_all() const { return std::count(directory_.begin(), directory_.end(), BlockPool::missing) == 0; }

  SegmentRows rows(Id segment) const {
    SegmentRows rows(segment, mesh_.intervals_of(segment));
    add_rows({wanted_, 1, &segment, entry_of(segment), words_.data(), interval_tables(mesh_)}, 0, rows);
    return rows;
  }

  Offset used() const { return used_; }
  const StarSizes& needed() const { return needed_; }

 private:
  int missing_blocks(Id segment) const {
    const Offset* const entry = entry_of(segment);
    return static_cast<int>(std::count(entry, entry + wanted_.count(), BlockPool::missing));
  }

  const Offset* entry_of(Id segment) const {
    return directory_.data() + Offset(mesh_.segments() - 1 - segment) * wanted_.count();
  }

  const Mesh& mesh_;
  RelationSet wanted_;
  StarSizes sizes_;
  int level_;
  Offset capacity_;
  std::vector<Id> words_;
  std::vector<Offset> directory_;
  Offset used_ = 0;
  StarSizes needed_;
};

constexpr Offset plenty = Offset(1) << 18;
constexpr int warps = 4;

/// The rows of the segments that are there; how many are.
Id expect_rows(const LaunchedStars& batch, const Mesh& mesh, RelationSet wanted, const ExpectedRows& expected) {
  Id there = 0;
  for (Id s = 0; s < mesh.segments(); ++s) {
    if (!batch.has(s)) {
      EXPECT_TRUE(batch.lacks(s)) << "segment " << s << " has some of its blocks";
      continue;
    }
    EXPECT_TRUE(expected.match(batch.rows(s), wanted)) << "wanted " << name_of(wanted);
    ++there;
  }
  return there;
}

/// Does a team of these sizes find room in the scratch memory that is fast?
bool fits_level_0(const StarSizes& sizes) {
  constexpr std::size_t portion = 32 * 1024;
  return StarKernel<WorkerMemory, 4>::scratch_bytes(sizes, warps) < portion;
}

/// What every segment of the mesh needs, found as a runtime does: by trying.
StarSizes sizes_that_suffice(const Mesh& mesh, RelationSet wanted, const ExpectedRows& expected) {
  StarSizes sizes{4, 16, 16, 8};
  for (int attempt = 0; attempt < 8; ++attempt) {
    LaunchedStars batch(mesh, wanted, sizes, fits_level_0(sizes) ? 0 : 1, plenty);
    batch.run(warps);
    expect_rows(batch, mesh, wanted, expected);
    if (batch.has_all()) return sizes;
    EXPECT_FALSE(sizes.contains(batch.needed())) << "some segments are missing, but nothing more was needed";
    sizes = larger(sizes, batch.needed());
  }
  ADD_FAILURE() << "needs more and more for " << name_of(wanted);
  return sizes;
}

}  // namespace

class LaunchedStarsOf : public EveryMesh {};

TEST_P(LaunchedStarsOf, every_mesh_are_those_of_brute_force_whatever_the_scratch_memory) {
  const Mesh mesh = encode(input(), segmentation());
  const ExpectedRows expected(input(), brute_force_of(mesh_name()), mesh);
  for (const RelationSet wanted : star_subsets) {
    const StarSizes sizes = sizes_that_suffice(mesh, wanted, expected);
    LaunchedStars batch(mesh, wanted, sizes, 1, plenty);
    batch.run(2 * warps);
    EXPECT_EQ(expect_rows(batch, mesh, wanted, expected), mesh.segments());
    EXPECT_EQ(batch.needed().rows, 0) << "needs nothing more";
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, LaunchedStarsOf, every_mesh_and_segmentation(), mesh_and_segmentation);

TEST(LaunchedStars, leave_out_what_the_pool_lacks_room_for_and_say_how_much_it_takes) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, 7);
  const ExpectedRows expected(input, brute_force_of("holed_grid_9"), mesh);
  for (const RelationSet wanted : star_subsets) {
    const StarSizes sizes = sizes_that_suffice(mesh, wanted, expected);
    LaunchedStars small(mesh, wanted, sizes, 1, 5000);
    small.run(warps);
    EXPECT_GT(small.used(), 5000);
    EXPECT_EQ(small.needed().rows, 0) << "it is the pool that lacks, not the scratch memory";
    EXPECT_LT(expect_rows(small, mesh, wanted, expected), mesh.segments());
    LaunchedStars enough(mesh, wanted, sizes, 1, small.used());
    enough.run(warps);
    EXPECT_EQ(enough.used(), small.used());
    EXPECT_EQ(expect_rows(enough, mesh, wanted, expected), mesh.segments());
  }
}

TEST(LaunchedStars, touch_no_pool_that_has_no_room) {
  const InputMesh& input = mesh_named("holed_grid_9");
  const Mesh mesh = encode(input, 100000);
  const ExpectedRows expected(input, brute_force_of("holed_grid_9"), mesh);
  ASSERT_EQ(mesh.segments(), 1);
  for (const RelationSet wanted : star_subsets) {
    const Id segment = 0;
    Offset used = 0;
    std::vector<Offset> directory(wanted.count(), 0);
    StarSizes needed;
    StarKernel<HostMemory, 4> kernel;
    kernel.mesh = mesh.encoded();
    kernel.segments = &segment;
    kernel.wanted = wanted;
    kernel.sizes = sizes_that_suffice(mesh, wanted, expected);
    kernel.pool = {nullptr, 0, &used, directory.data(), &needed};
    std::vector<std::max_align_t> scratch(kernel.scratch_bytes(kernel.sizes, 1) / sizeof(std::max_align_t) + 1);
    kernel(HostTeam(0, reinterpret_cast<char*>(scratch.data())));
    EXPECT_GT(used, 0);
    EXPECT_EQ(directory, std::vector<Offset>(wanted.count(), BlockPool::missing));
  }
}

TEST(LaunchedStars, of_a_vertex_of_degree_70000) {
  const InputMesh input = cone_over_disc(70000);
  const Mesh mesh = encode(input, 1000);
  const ExpectedRows expected(input, BruteForce(input), mesh);
  const StarSizes sizes = {1000, 300000, 300000, 262144, 80000, 0};
  LaunchedStars batch(mesh, star_relations, sizes, 1, 16 * plenty);
  batch.run(warps);
  EXPECT_EQ(expect_rows(batch, mesh, star_relations, expected), mesh.segments());
}

TEST(LaunchedStars, of_no_segments_are_nothing) { launch(WorkerSpace(), StarKernel<WorkerMemory, 4>(), 0, warps); }

TEST(LaunchedStars, refuse_more_scratch_memory_than_a_team_can_have) {
  StarKernel<WorkerMemory, 4> kernel;
  kernel.sizes = {1000, 600000000, 8, 8};
  try {
    launch(WorkerSpace(), kernel, 1, 1);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a segment of 1000 rows takes 24000"), std::string::npos) << error.what();
  }
}

}  // namespace gale::test
