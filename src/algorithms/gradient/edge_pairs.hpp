#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>
#include <gale/mesh/intervals.hpp>

namespace gale::detail {

/// The edges of a vertex to lower vertices: the ids of these, ascending, and for each the place among them of the third
/// vertex of the triangle that the edge is paired with. A view of words in EdgePairs: the count, the ids, then the
/// places, in a byte each where that suffices.
class EdgePairRow {
 public:
  KOKKOS_DEFAULTED_FUNCTION EdgePairRow() = default;
  KOKKOS_FUNCTION explicit EdgePairRow(Id* words) : words_(words) {}

  KOKKOS_FUNCTION static Offset words_for(Id count) { return 1 + count + (is_narrow(count) ? (count + 3) / 4 : count); }

  KOKKOS_FUNCTION Id size() const { return words_[0]; }
  KOKKOS_FUNCTION const Id* ids() const { return words_ + 1; }

  /// Place of a lower end; no_id if it isn't one.
  KOKKOS_FUNCTION Id find(Id other) const {
    constexpr Id few = 16;
    const Id* const all = ids();
    Id first = 0, rest = size();
    while (rest > few) {
      const Id half = rest / 2;
      if (all[first + half] <= other) first += half;
      rest -= half;
    }
    for (Id i = first; i < first + rest; ++i) {
      if (all[i] == other) return i;
    }
    return no_id;
  }

  /// Third vertex of the triangle that the i-th edge is paired with; no_id if it is with none.
  KOKKOS_FUNCTION Id third(Id i) const {
    const Id place = is_narrow(size()) ? narrow()[i] == narrow_none ? no_id : narrow()[i] : wide()[i];
    return place == no_id ? no_id : ids()[place];
  }

  /// Makes it a row of so many edges, each in no pair.
  KOKKOS_FUNCTION void begin(Id count) {
    words_[0] = count;
    for (Offset i = 1 + count; i < words_for(count); ++i) words_[i] = no_id;
  }

  KOKKOS_FUNCTION void set_id(Id i, Id id) { words_[1 + i] = id; }

  /// Pairs the i-th edge with the triangle whose third vertex is at `place`.
  KOKKOS_FUNCTION void pair(Id i, Id place) {
    if (is_narrow(size())) {
      narrow()[i] = static_cast<std::uint8_t>(place);
    } else {
      wide()[i] = place;
    }
  }

 private:
  static constexpr std::uint8_t narrow_none = 255;
  KOKKOS_FUNCTION static bool is_narrow(Id count) { return count <= narrow_none; }

  KOKKOS_FUNCTION std::uint8_t* narrow() const { return reinterpret_cast<std::uint8_t*>(words_ + 1 + size()); }
  KOKKOS_FUNCTION Id* wide() const { return words_ + 1 + size(); }

  Id* words_ = nullptr;
};

/// The rows of all vertices. Each consumer of a sweep takes the memory of its rows from chunks of its own, so that
/// nobody waits.
class GALE_EXPORT EdgePairs {
 public:
  EdgePairs() = default;
  EdgePairs(Id vertices, int consumers);

  /// Takes rows that were made elsewhere: their words, and where among them each vertex's row begins. Consumers may
  /// begin rows anew; without any, rows are only read.
  EdgePairs(const Array<const Id, HostMemory>& words, const Array<const Offset, HostMemory>& begin, int consumers);

  /// Rows for so many vertices: of those that are owned the rows of `some`, which must live as long. Those of others
  /// are to be begun, by one consumer, and have no edges before that.
  EdgePairs(const EdgePairs& some, Interval owned, Id vertices);

  /// A row for a vertex, to be filled. A consumer may begin rows while others do; each vertex once.
  EdgePairRow begin(int consumer, Id vertex, Id count);

  EdgePairRow operator[](Id vertex) const {
    if (rows_.data() != nullptr) return rows_(vertex);
    return EdgePairRow(const_cast<Id*>(made_elsewhere_.data()) + begin_(vertex));  // nobody writes to these
  }

  /// Has the row of a vertex that is soon to be read brought near: first where it is, some time later itself.
  void prefetch_place(Id vertex) const {
    __builtin_prefetch(rows_.data() != nullptr ? static_cast<const void*>(&rows_(vertex)) : &begin_(vertex));
  }
  void prefetch(Id vertex) const { __builtin_prefetch((*this)[vertex].ids()); }

  std::size_t bytes() const;

 private:
  struct Pool {
    std::deque<Array<Id, HostMemory>> chunks;  ///< a deque, since growing must not copy Views in a sweep's body
    Id* next = nullptr;
    Id* end = nullptr;
  };

  Array<EdgePairRow, HostMemory> rows_;  ///< of each vertex; none where all were made elsewhere
  Array<const Id, HostMemory> made_elsewhere_;
  Array<const Offset, HostMemory> begin_;  ///< of each vertex there
  std::vector<Pool> pools_;
};

}  // namespace gale::detail
