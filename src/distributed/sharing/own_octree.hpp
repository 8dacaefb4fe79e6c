#pragma once

#include <future>
#include <optional>

#include <gale/base/threads.hpp>
#include <gale/distributed/mesh_part.hpp>
#include <gale/distributed/sharing/vertex_directory.hpp>

namespace gale::detail {

/// The octree of what a rank owns, and whether a part's points are finite. Where the rank owns points as it hands them
/// over, one after the other, a device makes the octree and looks at them while ranks exchange cells.
class OwnOctree {
 public:
  OwnOctree(const HostPoints& points, const VertexDirectory& directory, const IdInterval& owned, int rank);

  /// Throws gale::Error for a point that isn't finite, but for those that a device is to look at.
  void require_finite() const;

  /// Has the device begin. Until get(), loops of this thread use fewer threads than they may.
  void begin(int capacity);

  /// The octree, of `owned` where no device has begun it. Throws gale::Error as octree_of does; for a point that isn't
  /// finite by its place in the part.
  Segmentation get(const HostPoints& owned, int capacity);

 private:
  HostPoints points_;
  Offset first_ = 0, count_ = 0;  ///< places of those that a device looks at
  std::future<Segmentation> begun_;
  std::optional<ThreadLimit> others_;  ///< the threads beside those that begin
};

}  // namespace gale::detail
