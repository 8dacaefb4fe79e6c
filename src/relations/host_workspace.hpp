#pragma once

#include <memory>

#include <gale/relations/kernels/segment_kernel.hpp>

namespace gale::detail {

/// The scratch memory of one host thread, and a kernel that runs in it. It grows to what the largest segment so far has
/// needed.
class HostWorkspace {
 public:
  HostWorkspace(const Mesh& mesh, RelationSet wanted) : kernel_(mesh, wanted) {}

  /// Computes the blocks of one segment into `pool`, whose directory has room for them alone. False if the pool lacks
  /// room for some.
  bool compute(Id segment, BlockPool pool) {
    require(kernel_.bound(segment));
    const Offset used_before = *pool.used;
    for (;;) {
      StarSizes needed;
      pool.needed = &needed;
      kernel_.run({&segment, sizes_, 0, pool}, scratch_.get());
      if (sizes_.contains(needed)) break;
      require(needed);
      *pool.used = used_before;
    }
    return are_there(kernel_.wanted(), &segment, pool.directory, 1);
  }

 private:
  void require(const StarSizes& sizes) {
    if (scratch_ && sizes_.contains(sizes)) return;
    const StarSizes all = larger(sizes_, sizes);
    scratch_.reset(new char[kernel_.scratch_bytes(all, 1)]);  // may throw: the old memory serves the old sizes then
    sizes_ = all;
  }

  SegmentKernel<HostMemory> kernel_;
  StarSizes sizes_;
  std::unique_ptr<char[]> scratch_;
};

}  // namespace gale::detail
