#pragma once

#include <vector>

#include <gale/relations/batch.hpp>
#include <gale/relations/kernels/segment_kernel.hpp>
#include <gale/relations/segment_rows.hpp>

namespace gale::test {

/// What a kernel that is launched on a batch may use.
struct BatchMemory {
  StarSizes sizes;  ///< that teams have scratch memory for
  int scratch_level = 0;
  Offset pool_words = 0;
  int warps = 4;  ///< a team
};

/// The blocks of all segments of a mesh, from a kernel that was launched in the workers' space on a batch of them,
/// the last segment first.
class LaunchedBatch {
 public:
  /// `wanted`: what one kernel computes. The mesh must outlive it.
  LaunchedBatch(const Mesh& mesh, RelationSet wanted, const BatchMemory& memory);

  /// Whether all blocks of a segment are there, or none.
  bool has(Id segment) const { return missing_blocks(segment) == 0; }
  bool lacks(Id segment) const { return missing_blocks(segment) == wanted_.count(); }
  bool has_all() const;

  /// The rows that are there.
  SegmentRows rows(Id segment) const;

  /// What the kernel says that the whole batch takes of the pool, in words, and what those that are missing take of
  /// scratch memory.
  Offset used() const { return used_; }
  const StarSizes& needed() const { return needed_; }

  /// Did it leave the memory behind the pool as it was?
  bool kept_to_the_pool() const { return kept_to_the_pool_; }

 private:
  int missing_blocks(Id segment) const;
  const Offset* entry_of(Id segment) const;

  const Mesh& mesh_;
  RelationSet wanted_;
  std::vector<Id> words_;
  std::vector<Offset> directory_;
  Offset used_ = 0;
  StarSizes needed_;
  bool kept_to_the_pool_ = false;
};

/// Does a team find room for so much in the scratch memory that is fast?
bool fits_level_0(const Mesh& mesh, RelationSet wanted, const StarSizes& sizes, int warps);

}  // namespace gale::test
