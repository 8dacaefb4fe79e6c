#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <gale/algorithms/gradient/follow_each_path.hpp>
#include <gale/base/hash_table.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

/// Some paths of cells, one after the other: each cell on them, and its successor.
struct FollowedCells {
  Array<const Id, HostMemory> cells, next;
};

/// Follows paths to their ends where the successors are, in the memory of `space`.
template <class Space>
FollowedCells follow_cells(const Space& space, const Array<const Id, MemoryOf<Space>>& successors,
                           const std::vector<Id>& starts) {
  using Memory = MemoryOf<Space>;
  const auto cells = follow_whole(space, successors, starts, true).simplices;
  const auto next = allocate<Array<Id, Memory>>("GALE::next_on_path", cells.extent(0));
  parallel_for("GALE::next_on_path", space, cells.extent(0), ReadEntries<Id, Memory>{successors, cells, next});
  space.fence();
  return {on_host(cells), on_host(next)};
}

/// The successors of cells: where they lie on a device, those on paths that were followed alone.
class CellSteps {
 public:
  /// Without `one_way` paths fork: then those of all cells are brought here. Refers to the successors.
  CellSteps(const Mirrored<Id>& successors, bool one_way)
      : successors_(successors),
        here_(one_way && successors.on_device() ? nullptr : successors.in<HostMemory>().data()) {}

  /// Makes known the successors of all cells on the paths from some.
  void follow(std::vector<Id> cells) {
    if (here_ != nullptr || cells.empty()) return;
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    const FollowedCells paths = in_worker_or_host_space(true, [&](const auto& space) {
      return follow_cells(space, successors_.in<MemoryOf<std::decay_t<decltype(space)>>>(), cells);
    });
    for (Offset i = 0; i < static_cast<Offset>(paths.cells.extent(0)); ++i) {
      stop_if_asked_at(i);
      known_.insert(static_cast<std::uint64_t>(paths.cells(i))).first = paths.next(i);
    }
  }

  Id operator[](Id cell) const {
    return here_ != nullptr ? here_[cell] : *known_.find(static_cast<std::uint64_t>(cell));
  }

 private:
  const Mirrored<Id>& successors_;
  const Id* const here_;  ///< of all cells
  HashTable<Id> known_;
};

}  // namespace gale::detail
