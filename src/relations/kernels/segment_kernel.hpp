#pragma once

#include <memory>
#include <type_traits>
#include <vector>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/batch.hpp>
#include <gale/relations/kernels/block_pool.hpp>
#include <gale/relations/kernels/launch.hpp>
#include <gale/relations/relation.hpp>

namespace gale {

/// The sets of relations that one kernel computes together: the members of star_relations, and each other one by
/// itself. These first, in the order of `Relation`.
std::vector<RelationSet> kernels_for(RelationSet relations, int dimension = 3);

/// Are all the blocks of a batch there? Throws gale::Error, naming the segment, if one has more entries than an Id
/// counts.
bool are_there(const Batch<HostMemory>& batch);

/// What a kernel is run on.
struct KernelTask {
  SegmentList segments;  ///< one a team, where the kernel can read them
  StarSizes sizes;       ///< what teams have scratch memory for
  int scratch_level = 0;
  BlockPool pool;
};

/// The kernel of one of the sets that `kernels_for` gives, whichever that is: a StarKernel or a RowKernel. `Memory` is
/// the workers' or the host's.
template <class Memory>
class SegmentKernel {
 public:
  /// Enumerates what the kernel needs of the mesh's simplices.
  SegmentKernel(const Mesh& mesh, RelationSet wanted);
  ~SegmentKernel();
  SegmentKernel(SegmentKernel&&) noexcept;
  SegmentKernel& operator=(SegmentKernel&&) noexcept;

  RelationSet wanted() const;

  /// At least what a segment needs, unless its neighbourhoods are unusual: then the kernel says so.
  StarSizes bound(Id segment) const;

  /// What a team of `warps` warps asks for.
  std::size_t scratch_bytes(const StarSizes& sizes, int warps) const;

  /// The space that works in `Memory`.
  using Space = SpaceOf<Memory>;

  /// On `teams` teams (see `gale::launch`).
  void launch(const Space& instance, const KernelTask& task, int teams, TeamShape shape);

  /// On the calling thread, for the one segment of `task`, in `scratch`. Only in host memory.
  void run(const KernelTask& task, char* scratch);

 private:
  struct Any;
  std::unique_ptr<Any> any_;
};

}  // namespace gale
