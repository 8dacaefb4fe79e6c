#pragma once

#include <vector>

#include <gale/algorithms/morse_smale/jump.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/bits.hpp>
#include <gale/base/mirrored.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/grid/grid_view.hpp>

// Paths between the simplices where some start and end, each of which is an entry: a table of all simplices, which
// jump() would need otherwise, has six times as many where paths of vertices start at cells.

namespace gale::detail {

/// Marks some simplices; those that follow each other lie mostly in one word.
template <class Memory>
struct MarkSimplices {
  static constexpr int simplices_of_item = 16;

  Array<const Id, Memory> simplices;  ///< no_id: none
  Array<std::uint64_t, Memory> words;

  Offset items() const { return (simplices.extent(0) + simplices_of_item - 1) / simplices_of_item; }

  KOKKOS_FUNCTION void operator()(Offset item) const {
    const Offset first = item * simplices_of_item, all = simplices.extent(0);
    Id word = no_id;
    std::uint64_t bits = 0;
    for (Offset i = first; i < first + simplices_of_item && i < all; ++i) {
      const Id simplex = simplices(i);
      if (simplex == no_id) continue;
      if (simplex >> 6 != word) {
        if (bits != 0) atomic_or(&words(word), bits);
        word = simplex >> 6;
        bits = 0;
      }
      bits |= std::uint64_t(1) << (simplex & 63);
    }
    if (bits != 0) atomic_or(&words(word), bits);
  }
};

/// Follows a path from its start to the next simplex that has an entry, and puts its start's entry in its place. Paths
/// of one start write the same.
template <class Memory>
struct CondensePath {
  RankedBits entries;
  Array<const Id, Memory> successors;
  Array<Id, Memory> starts;  ///< no_id: none
  Array<Id, Memory> next;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    Id at = starts(i);
    if (at == no_id) return;
    const Id entry = entries.rank(at);
    starts(i) = entry;
    do {
      at = successors(at);
    } while (at >= 0 && !entries.has(at));
    if (at != no_id) atomic_write(&next(entry), at < 0 ? path_outside : entries.rank(at));
  }
};

/// Counts the simplices that have entries in a word.
template <class Memory>
struct CountMarked {
  Array<const std::uint64_t, Memory> words;

  KOKKOS_FUNCTION Id operator()(Offset word) const { return count_bits(words(word)); }
};

/// Ends the paths of those that are ends, whose places begin with `first`.
template <class Memory>
struct EndAtEntry {
  RankedBits entries;
  Array<const Id, Memory> ends;
  Id first;
  Array<Id, Memory> next;

  KOKKOS_FUNCTION void operator()(Offset i) const { next(entries.rank(ends(i))) = end_at(first + static_cast<Id>(i)); }
};

/// Entries of paths in a memory. Copies share them.
template <class Memory>
struct CondensedPaths {
  Array<Id, Memory> next;                    ///< of each entry, for jump()
  Array<const std::uint64_t, Memory> words;  ///< a bit a simplex: whether it has an entry; none: all have, in order
  Array<const Id, Memory> before;            ///< how many have before those of each word
};

/// Where some paths begin and end, as with_ends() has it of all simplices: the entries of those of `starts`, which are
/// written over with their entries, of `ends`, and of `exits`, which are ends after all of these. Waits for the space.
template <class Space>
CondensedPaths<MemoryOf<Space>> condensed_paths(const Space& space, const Mirrored<Id>& successors,
                                                const std::vector<Id>& ends, const Array<Id, MemoryOf<Space>>& starts,
                                                const Array<Id, MemoryOf<Space>>& exits = {}) {
  using Memory = MemoryOf<Space>;
  const auto count = static_cast<Offset>(successors.size()) / 64 + 1;
  const auto words = allocate<Array<std::uint64_t, Memory>>("GALE::path_entries", count);
  fill("GALE::path_entries", space, words, std::uint64_t(0));
  const Array<const Id, Memory> last = in_memory<Memory>(ends);
  for (const Array<const Id, Memory>& simplices :
       {Array<const Id, Memory>(starts), last, Array<const Id, Memory>(exits)}) {
    const MarkSimplices<Memory> mark{simplices, words};
    parallel_for("GALE::mark_path_entries", space, mark.items(), mark);
  }
  const auto before = allocate<Array<Id, Memory>>("GALE::path_entries_before", count + 1);
  const Id entries = exclusive_scan("GALE::path_entries_before", space, count, before, CountMarked<Memory>{words});
  const RankedBits ranked{words.data(), before.data(), nullptr};
  const auto next = allocate<Array<Id, Memory>>("GALE::next_on_path", entries);
  parallel_for("GALE::condense_paths", space, starts.extent(0),
               CondensePath<Memory>{ranked, successors_in<Memory>(successors), starts, next});
  parallel_for("GALE::end_paths", space, last.extent(0), EndAtEntry<Memory>{ranked, last, 0, next});
  parallel_for("GALE::end_paths", space, exits.extent(0),
               EndAtEntry<Memory>{ranked, exits, static_cast<Id>(ends.size()), next});
  space.fence();
  return {next, words, before};
}

/// Finds the end of a simplex' path, from the next one on it that has an entry: its place, no_id for outside.
template <class Memory>
struct EndOfPath {
  Array<const Id, Memory> ends;  ///< of entries: CondensedPaths::next after jump()
  Array<const std::uint64_t, Memory> words;
  Array<const Id, Memory> before;
  Array<const Id, Memory> successors;

  KOKKOS_FUNCTION Id operator()(Id at) const {
    if (words.extent(0) == 0) return place_of_end(ends(at));
    const RankedBits entries{words.data(), before.data(), nullptr};
    while (at >= 0 && !entries.has(at)) at = successors(at);
    return at < 0 ? no_id : place_of_end(ends(entries.rank(at)));
  }
};

}  // namespace gale::detail
