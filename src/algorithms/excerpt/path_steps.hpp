#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include <gale/algorithms/gradient/follow_each_path.hpp>
#include <gale/base/hash_table.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

/// Some paths, one after the other: each simplex on them, and its successor.
struct SteppedPaths {
  Array<const Id, HostMemory> simplices, next;
};

/// Follows paths to their ends where the successors are, in the memory of `space`.
template <class Space>
SteppedPaths step_along_paths(const Space& space, const Array<const Id, MemoryOf<Space>>& successors,
                              const std::vector<Id>& starts) {
  using Memory = MemoryOf<Space>;
  const auto simplices = follow_whole(space, successors, starts, true).simplices;
  const auto next = allocate<Array<Id, Memory>>("GALE::next_on_path", simplices.extent(0));
  parallel_for("GALE::next_on_path", space, simplices.extent(0),
               WriteValues<Id, Memory, EntryAt<Id, Memory>>{{successors}, simplices, next});
  space.fence();
  return {on_host(simplices), on_host(next)};
}

/// The successors of simplices: where they lie on a device, those on paths that were followed alone.
class PathSteps {
 public:
  /// Unless paths are `few` and don't fork, those of all are brought here. Refers to the successors.
  PathSteps(const Mirrored<Id>& successors, bool few)
      : successors_(successors), here_(few && successors.on_device() ? nullptr : successors.in<HostMemory>().data()) {}

  /// Makes known the successors of all simplices on the paths from some.
  void follow(std::vector<Id> starts) {
    if (here_ != nullptr || starts.empty()) return;
    sort_distinct("GALE::sort_starts", starts);
    const SteppedPaths paths = in_worker_or_host_space(true, [&](const auto& space) {
      return step_along_paths(space, successors_.in<MemoryOf<std::decay_t<decltype(space)>>>(), starts);
    });
    for (Offset i = 0; i < static_cast<Offset>(paths.simplices.extent(0)); ++i) {
      stop_if_asked_at(i);
      known_.insert(static_cast<std::uint64_t>(paths.simplices(i))).first = paths.next(i);
    }
  }

  Id operator[](Id simplex) const {
    return here_ != nullptr ? here_[simplex] : *known_.find(static_cast<std::uint64_t>(simplex));
  }

 private:
  const Mirrored<Id>& successors_;
  const Id* const here_;  ///< of all
  HashTable<Id> known_;
};

}  // namespace gale::detail
