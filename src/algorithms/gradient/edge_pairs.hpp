#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include <gale/algorithms/gradient/grid_codes.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>
#include <gale/mesh/intervals.hpp>

namespace gale::detail {

/// What stands for the third vertex of an edge that is paired with no triangle.
inline constexpr Id edge_is_critical = -1, edge_has_vertex = -2;

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

  /// Third vertex of the triangle that the i-th edge is paired with, by its place; no_id if it is with none.
  KOKKOS_FUNCTION Id place_of_third(Id i) const {
    return is_narrow(size()) ? narrow()[i] == narrow_none ? no_id : narrow()[i] : wide()[i];
  }

  /// That vertex itself.
  KOKKOS_FUNCTION Id third(Id i) const {
    const Id place = place_of_third(i);
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

/// What a row says, to be read: one of words, or a vertex's code in a grid.
class PairedEdges {
 public:
  PairedEdges(EdgePairRow row) : row_(row) {}
  PairedEdges(const GridCodes& codes, Id vertex) : codes_(&codes), code_(codes[vertex]), vertex_(vertex) {}

  /// What third() knows a lower end by; no_id if it isn't one.
  Id find(Id low) const {
    if (codes_ == nullptr) return row_.find(low);
    const int direction = codes_->direction(low - vertex_);
    return direction < 0 || code_[direction] == PairCode::not_lower ? no_id : direction;
  }

  /// Third vertex of the triangle that the edge to it is paired with; no_id if it is with none.
  Id third(Id place) const {
    if (place == no_id) return no_id;
    if (codes_ == nullptr) return row_.third(place);
    const int direction = code_[place];
    return direction >= PairCode::unpaired ? no_id : vertex_ + codes_->step(direction);
  }

  /// Calls visit(low, third) for each edge that is paired with a triangle, by ascending lower ends.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    const auto visit_paired = [&](Id place, Id low) {
      if (third(place) != no_id) visit(low, third(place));
    };
    if (codes_ == nullptr) {
      for (Id i = 0; i < row_.size(); ++i) visit_paired(i, row_.ids()[i]);
    } else {
      for (int d = 0; d < grid_directions; ++d) visit_paired(d, vertex_ + codes_->step(d));
    }
  }

 private:
  EdgePairRow row_;
  const GridCodes* codes_ = nullptr;
  PairCode code_{};
  Id vertex_ = no_id;
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

  /// Takes the codes of some vertices of a grid, to be read.
  EdgePairs(std::shared_ptr<const GridCodes> codes, Interval coded) : codes_(std::move(codes)), coded_(coded) {}

  /// Rows for so many vertices: of those that are owned the rows of `some`, which must live as long. Those of others
  /// are to be begun, by one consumer, and have no edges before that.
  EdgePairs(const EdgePairs& some, Interval owned, Id vertices);

  /// A row for a vertex, to be filled. A consumer may begin rows while others do; each vertex once.
  EdgePairRow begin(int consumer, Id vertex, Id count);

  PairedEdges operator[](Id vertex) const {
    if (is_coded(vertex)) return {*codes_, vertex};
    return row(vertex);
  }

  /// The row of a vertex that has words.
  EdgePairRow row(Id vertex) const {
    if (rows_.data() != nullptr) return rows_(vertex);
    return EdgePairRow(const_cast<Id*>(made_elsewhere_.data()) + begin_(vertex));  // nobody writes to these
  }

  /// Has the row of a vertex that is soon to be read brought near: first where it is, some time later itself.
  void prefetch_place(Id vertex) const {
    if (is_coded(vertex)) return;
    __builtin_prefetch(rows_.data() != nullptr ? static_cast<const void*>(&rows_(vertex)) : &begin_(vertex));
  }
  void prefetch(Id vertex) const {
    __builtin_prefetch(is_coded(vertex) ? static_cast<const void*>(codes_->place(vertex)) : row(vertex).ids());
  }

  /// The codes of a grid, if there are any: of those vertices that have no words.
  const GridCodes* codes() const { return codes_.get(); }

  std::size_t bytes() const;

 private:
  struct Pool {
    std::deque<Array<Id, HostMemory>> chunks;  ///< a deque, since growing must not copy Views in a sweep's body
    Id* next = nullptr;
    Id* end = nullptr;
  };

  bool is_coded(Id vertex) const { return codes_ != nullptr && coded_.has(vertex); }

  Array<EdgePairRow, HostMemory> rows_;  ///< of each vertex; none where all were made elsewhere
  Array<const Id, HostMemory> made_elsewhere_;
  Array<const Offset, HostMemory> begin_;  ///< of each vertex there
  std::vector<Pool> pools_;
  std::shared_ptr<const GridCodes> codes_;  ///< of a grid, where these stand for words
  Interval coded_;                          ///< the vertices that have codes
};

}  // namespace gale::detail
