// The kernels of single relations over a whole mesh, by threads per segment: their time beside that of copying what
// they make to the host.
//   usage: relation_rates [N [CAPACITY [RELATION...]]]

#include <cstdio>
#include <cstdlib>
#include <vector>

#include <gale/base/transfer.hpp>
#include <gale/relations/kernels/segment_kernel.hpp>

#include "support/bench_mesh.hpp"
#include "support/clock.hpp"

namespace {

using namespace gale;

constexpr std::size_t copied_at_once = std::size_t(16) << 20;

/// A kernel over all segments, in as few launches as its output has room for.
class WholeMesh {
 public:
  WholeMesh(const Mesh& mesh, RelationSet wanted)
      : count_(mesh.segments()),
        kernel_(mesh, wanted),
        words_(allocate<Array<Id, WorkerMemory>>("words", pool_words())),
        directory_("directory", Offset(mesh.segments()) * wanted.count()),
        used_("used", 1),
        needed_("needed", 1) {
    for (Id s = 0; s < count_; ++s) task_.sizes = larger(task_.sizes, kernel_.bound(s));
    task_.pool = {words_.data(), static_cast<Offset>(words_.extent(0)), used_.data(), directory_.data(),
                  needed_.data()};
    batch_ = count_;
    while (!run(1)) batch_ = (batch_ + 1) / 2;
  }

  /// Does a team of this shape find room in the fast scratch memory?
  bool fits(TeamShape shape) const {
    return kernel_.scratch_bytes(task_.sizes, shape.warps) <= fast_scratch_bytes<WorkerSpace>();
  }

  /// False if the pool lacked room.
  bool run(TeamShape shape) {
    words_made_ = 0;
    for (Id begin = 0; begin < count_; begin += batch_) {
      Kokkos::deep_copy(used_, 0);
      task_.segments = SegmentList::from(begin);
      kernel_.launch(WorkerSpace(), task_, std::min(batch_, count_ - begin), shape);
      WorkerSpace().fence();
      const Offset used = on_host(used_)(0);
      if (used > task_.pool.capacity) return false;
      words_made_ += used;
    }
    return true;
  }

  Offset words_made() const { return words_made_; }

 private:
  /// Most of what there is: 8 GiB on a device, 1 on the host.
  static Offset pool_words() { return Offset(have_device ? 2 : 0) * (Offset(1) << 30) + (Offset(1) << 28); }

  Id count_;
  Id batch_ = 0;
  SegmentKernel<WorkerMemory> kernel_;
  KernelTask task_;
  Array<Id, WorkerMemory> words_;
  Array<Offset, WorkerMemory> directory_, used_;
  Array<StarSizes, WorkerMemory> needed_;
  Offset words_made_ = 0;
};

void measure(const Mesh& mesh, RelationSet wanted, double link) {
  WholeMesh whole(mesh, wanted);
  for (const int threads : {1, 4, 8, 16, 32, 48, 64, 96, 128, 256, 512}) {
    if (!have_device && threads > 1) break;
    const TeamShape shape = TeamShape::of(threads);
    if (!whole.fits(shape)) continue;
    const double seconds = perf::median_seconds_of(have_device ? 5 : 1, [&] { whole.run(shape); });
    const double bytes = 4.0 * static_cast<double>(whole.words_made());
    std::printf(
        "%-14s %4d threads a segment: %8.2f ms, %.2f GB, %.0f GB/s; its copy %.2f ms; %.2f M segments/s, %.0f M "
        "entries/s\n",
        name_of(wanted).c_str(), threads, 1e3 * seconds, bytes / 1e9, bytes / 1e9 / seconds, 1e3 * bytes / link,
        mesh.segments() / seconds / 1e6, bytes / 4e6 / seconds);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Kokkos::ScopeGuard kokkos(argc, argv);
  const int n = argc > 1 ? std::atoi(argv[1]) : 64;
  const Mesh mesh = perf::encode(io::make_grid(n), argc > 2 ? std::atoi(argv[2]) : default_capacity);
  const double link = perf::link_bandwidth(copied_at_once);
  std::printf("%s, grid:%d, %d segments; link %.1f GB/s\n", perf::context().c_str(), n, mesh.segments(), link / 1e9);
  std::vector<RelationSet> wanted;
  for (int i = 3; i < argc; ++i) {
    if (const auto relation = relation_named(argv[i])) wanted.push_back(*relation);
  }
  if (wanted.empty()) wanted = kernels_for(all_relations - star_relations);
  for (const RelationSet one : wanted) measure(mesh, one, link);
}
