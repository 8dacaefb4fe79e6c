#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

#include <gale/mesh/encoded_mesh.hpp>
#include <gale/mesh/numbering/enumerate.hpp>

namespace gale::detail {

/// The tables of a mesh's simplices, each made when someone needs it first, in the space that the mesh was made in, or
/// on the host if it doesn't fit the device's memory. By any thread.
class SimplexStore {
 public:
  /// From arrays that are asked for when they are needed first.
  SimplexStore(int dimension, std::function<const MeshArrays&()> mesh)
      : dimension_(dimension), mesh_(std::move(mesh)) {}

  template <class Memory>
  Simplices<Memory> in(const SimplexNeeds& needs);

  /// Where the edges (1) or triangles (2) that are internal to each segment begin, and one past the last; what is
  /// missing for it is enumerated. No lock once it is there.
  template <class Memory>
  const Array<const Id, Memory>& interval_begin(int dimension);

  /// How many edges or triangles there are; no_id as long as nobody needed them. No lock.
  Id known(int dimension) const;

  /// What didn't fit the device's memory; empty if everything did.
  std::string notice() const;

 private:
  void enumerate(const SimplexNeeds& needs);
  template <class From, class Make>
  void make(const char* what, const From& from, const Make& make);
  template <class Space>
  void publish_intervals(const Space& space, int dimension);

  mutable std::mutex mutex_;
  const int dimension_;
  const std::function<const MeshArrays&()> mesh_;
  SimplexTables tables_;
  Mirrored<Id> intervals_[2];
  std::atomic<const Mirrored<Id>*> published_intervals_[2] = {};
  std::string notice_;
};

}  // namespace gale::detail
