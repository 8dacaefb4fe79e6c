#include <algorithm>
#include <type_traits>

#include <gale/base/device.hpp>
#include <gale/base/threads.hpp>
#include <gale/distributed/sharing/local_mesh.hpp>
#include <gale/distributed/sharing/own_octree.hpp>
#include <gale/mesh/octree.hpp>

namespace gale::detail {

namespace {

void require_finite_points(const HostPoints& points) {
  points.visit([](const auto& rows) {
    gale::detail::require_finite<typename std::decay_t<decltype(rows)>::non_const_value_type>(HostExecutionSpace(),
                                                                                              rows);
  });
}

/// Returns what use_some() does. Where that throws, it says by its place among all points which one isn't finite.
template <class UseSome>
auto naming_points_among(const HostPoints& all, const UseSome& use_some) {
  try {
    return use_some();
  } catch (const OutOfMemory&) {
    throw;
  } catch (const Error&) {
    require_finite_points(all);
    throw;
  }
}

}  // namespace

OwnOctree::OwnOctree(const HostPoints& points, const VertexDirectory& directory, const IdInterval& owned, int rank)
    : points_(points) {
  if (!have_device || !directory.given() || owned.is_empty()) return;
  first_ = owned.begin - directory.given()->of(rank).begin;
  count_ = owned.end - owned.begin;
}

void OwnOctree::require_finite() const {
  const Offset behind = first_ + count_;
  naming_points_among(points_, [&] {
    require_finite_points(points_.part(0, first_));
    require_finite_points(points_.part(behind, points_.count() - behind));
  });
}

/// Runs on a thread of its own with a quarter of the threads. Until get() this one uses the others, as a loop waits for
/// the slowest thread, which would be one that shares its core.
void OwnOctree::begin(int capacity) {
  if (count_ == 0) return;
  const int all = host_threads(), few = std::max(all / 4, 1);
  begun_ =
      std::async(std::launch::async | std::launch::deferred, [points = points_.part(first_, count_), capacity, few] {
        use_device();
        const ThreadLimit limit(few);
        return octree_of(points, capacity);
      });
  others_.emplace(std::max(all - few, 1));
}

Segmentation OwnOctree::get(const HostPoints& owned, int capacity) {
  others_.reset();
  if (!begun_.valid()) return octree_of(owned, capacity);
  return naming_points_among(points_, [&] { return begun_.get(); });
}

}  // namespace gale::detail
