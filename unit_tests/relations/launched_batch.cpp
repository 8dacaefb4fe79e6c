#include "relations/launched_batch.hpp"

#include <algorithm>

#include <gale/base/device.hpp>

#include "support/arrays.hpp"

namespace gale::test {

namespace {

/// Behind the pool, where nobody has anything to write.
constexpr Offset guard_words = 64;
constexpr Id untouched = -77;

bool is_missing(Offset entry) { return entry < 0; }

}  // namespace

LaunchedBatch::LaunchedBatch(const Mesh& mesh, RelationSet wanted, const BatchMemory& memory)
    : mesh_(mesh), wanted_(wanted) {
  const Id segments = mesh.segments();
  std::vector<Id> backwards(segments);
  for (Id s = 0; s < segments; ++s) backwards[s] = segments - 1 - s;
  const auto list = to_worker(backwards);
  const auto words = to_worker(std::vector<Id>(memory.pool_words + guard_words, untouched));
  const Array<Offset, WorkerMemory> used("used", 1), directory("directory", Offset(segments) * wanted.count());
  const auto needed = to_worker(std::vector<StarSizes>(1));
  SegmentKernel<WorkerMemory> kernel(mesh, wanted);
  const BlockPool pool = {words.data(), memory.pool_words, used.data(), directory.data(), needed.data()};
  const WorkerSpace instance = make_instance();
  kernel.launch(instance, {list.data(), memory.sizes, memory.scratch_level, pool}, segments, memory.warps);
  instance.fence();
  words_ = to_vector(words);
  directory_ = to_vector(directory);
  used_ = to_vector(used)[0];
  needed_ = to_vector(needed)[0];
  kept_to_the_pool_ = std::count(words_.end() - guard_words, words_.end(), untouched) == guard_words;
}

bool LaunchedBatch::has_all() const { return std::none_of(directory_.begin(), directory_.end(), is_missing); }

SegmentRows LaunchedBatch::rows(Id segment) const {
  SegmentRows rows(segment, mesh_.intervals_of(segment));
  const Batch<HostMemory> batch{wanted_, 1, &segment, entry_of(segment), words_.data(), interval_tables(mesh_)};
  add_rows(batch, 0, rows);
  return rows;
}

int LaunchedBatch::missing_blocks(Id segment) const {
  const Offset* const entry = entry_of(segment);
  return static_cast<int>(std::count_if(entry, entry + wanted_.count(), is_missing));
}

const Offset* LaunchedBatch::entry_of(Id segment) const {
  return directory_.data() + Offset(mesh_.segments() - 1 - segment) * wanted_.count();
}

bool fits_level_0(const Mesh& mesh, RelationSet wanted, const StarSizes& sizes, int warps) {
  constexpr std::size_t portion = 32 * 1024;
  return SegmentKernel<WorkerMemory>(mesh, wanted).scratch_bytes(sizes, warps) <= portion;
}

}  // namespace gale::test
