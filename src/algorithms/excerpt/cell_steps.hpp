#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <gale/base/hash_table.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

/// Counts the cells of paths, to their ends.
template <class Memory>
struct CountCells {
  Array<const Id, Memory> successors, starts;
  Array<Offset, Memory> begin;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    Offset length = 0;
    for (Id cell = starts(i); cell >= 0; cell = successors(cell)) ++length;
    begin(i) = length;
  }
};

/// Reads what is there.
template <class Memory>
struct ReadCount {
  Array<Offset, Memory> begin;

  KOKKOS_FUNCTION Offset operator()(Offset i) const { return begin(i); }
};

/// Writes the cells of paths, one path after the other, and their successors.
template <class Memory>
struct WriteCells {
  Array<const Id, Memory> successors, starts;
  Array<Offset, Memory> begin;
  Array<Id, Memory> cells, next;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    Offset at = begin(i);
    for (Id cell = starts(i); cell >= 0; cell = next(at++)) {
      cells(at) = cell;
      next(at) = successors(cell);
    }
  }
};

/// Some paths of cells, one after the other: each cell on them, and its successor.
struct FollowedCells {
  Array<const Id, HostMemory> cells, next;
};

/// Follows paths where the successors are, in the memory of `space`: a thread for each.
template <class Space>
FollowedCells follow_cells(const Space& space, const Array<const Id, MemoryOf<Space>>& successors,
                           const std::vector<Id>& starts) {
  using Memory = MemoryOf<Space>;
  const Offset count = static_cast<Offset>(starts.size());
  const auto from = in_memory<Memory>(starts);
  const auto begin = allocate<Array<Offset, Memory>>("GALE::path_begin", count + 1);
  parallel_for("GALE::path_lengths", space, count, CountCells<Memory>{successors, from, begin});
  const Offset total = exclusive_scan("GALE::path_begins", space, count, begin, ReadCount<Memory>{begin});
  const WriteCells<Memory> write{successors, from, begin, allocate<Array<Id, Memory>>("GALE::path_cells", total),
                                 allocate<Array<Id, Memory>>("GALE::next_on_path", total)};
  parallel_for("GALE::follow_paths", space, count, write);
  space.fence();
  return {on_host(write.cells), on_host(write.next)};
}

/// The successors of cells: where they lie on a device, those on paths that were followed alone.
class CellSteps {
 public:
  /// Without `one_way` paths fork: then those of all cells are brought here. Refers to the successors.
  CellSteps(const Mirrored<Id>& successors, bool one_way)
      : successors_(successors),
        here_(one_way && successors.on_device() ? nullptr : successors.in<HostMemory>().data()) {}

  /// Makes known those on the paths from some cells.
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
