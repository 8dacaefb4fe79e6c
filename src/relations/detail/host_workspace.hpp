#pragma once

#include <memory>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/star_kernel.hpp>

namespace gale::detail {

/// The scratch memory of one host thread, and the star kernel that runs in it. It grows to what the largest segment so far has needed.
class HostWorkspace {
 public:
  HostWorkspace(const Mesh& mesh, RelationSet wanted) {
    kernel_.mesh = mesh.host();
    kernel_.wanted = wanted;
    kernel_.sizes = {128, 4096, 2048, 256};
    grow();
  }

  /// Computes the blocks of one segment into `pool`, whose directory has room for them alone. False if the pool lacks room for some.
  bool compute(Id segment, BlockPool pool) {
    kernel_.segments = &segment;
    const Offset used_before = *pool.used;
    for (;;) {
      StarSizes needed;
      pool.needed = &needed;
      kernel_.pool = pool;
      kernel_(HostTeam(0, scratch_.get()));
      if (kernel_.sizes.contains(needed)) break;
      kernel_.sizes = larger(kernel_.sizes, needed);
      grow();
      *pool.used = used_before;
    }
    for (int i = 0; i < kernel_.wanted.count(); ++i) {
      if (pool.directory[i] == BlockPool::missing) return false;
    }
    return true;
  }

 private:
  void grow() { scratch_.reset(new char[StarScratch::bytes(kernel_.sizes, 1)]); }

  StarKernel<HostMemory> kernel_;
  std::unique_ptr<char[]> scratch_;
};

}  // namespace gale::detail
