#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/base/types.hpp>

// Orders among the neighbours of one vertex.

namespace gale::detail {

/// The order of some neighbours, by input ids.
class InputIdRanks {
 public:
  void begin(Id count) {
    count_ = count;
    if (ids_.size() < static_cast<std::size_t>(count)) ids_.resize(count);
  }
  Id* ids() { return ids_.data(); }

  /// When all ids are written.
  void sort() {
    if (count_ > few) std::sort(ids_.begin(), ids_.begin() + count_);
  }

  /// How many are before one.
  Id rank_of(Id id) const {
    if (count_ > few) return static_cast<Id>(std::lower_bound(ids_.begin(), ids_.begin() + count_, id) - ids_.begin());
    Id rank = 0;
    for (Id i = 0; i < count_; ++i) rank += ids_[i] < id ? 1 : 0;
    return rank;
  }

  /// Replaces ids by their ranks. Few neighbours are compared with `at_once` ids each, in no order: the vector's
  /// entries up to the next multiple of that are read and written too.
  void replace_by_ranks(std::vector<Id>& ids, Id count) const {
    if (count_ > few) {
      for (Id i = 0; i < count; ++i) ids[i] = rank_of(ids[i]);
      return;
    }
    for (Id first = 0; first < count; first += at_once) {
      Id* const here = ids.data() + first;
      IdVector low, high, low_ranks = {}, high_ranks = {};
      std::memcpy(&low, here, sizeof low);
      std::memcpy(&high, here + at_once / 2, sizeof high);
      for (const Id *id = ids_.data(), *const end = id + count_; id < end; ++id) {
        low_ranks -= low > *id;
        high_ranks -= high > *id;
      }
      std::memcpy(here, &low_ranks, sizeof low_ranks);
      std::memcpy(here + at_once / 2, &high_ranks, sizeof high_ranks);
    }
  }

  /// Makes room for at least so many ids to be replaced.
  static void make_room(std::vector<Id>& ids, Id count) {
    const std::size_t room = (static_cast<std::size_t>(count) + at_once - 1) / at_once * at_once;
    if (ids.size() < room) ids.resize(room);
  }

 private:
  static constexpr Id few = 16, at_once = 8;

  /// Ids side by side; comparing them gives -1 where it holds. Left to itself the compiler puts neighbours side by
  /// side, and adds up across them: three times as slow.
  using IdVector = Id __attribute__((vector_size(at_once / 2 * sizeof(Id))));

  Id count_ = 0;
  std::vector<Id> ids_;
};

/// Puts triangles of one vertex in order by the ranks of their other corners among its neighbours.
class TriangleOrder {
 public:
  static constexpr Id most_neighbours = 64;

  /// `for_each(add)` calls add(second, third, triangle) for triangles of a vertex of so many neighbours, at most
  /// `most_neighbours`. Then visit(triangle) is called for each.
  template <class ForEach, class Visit>
  void visit(Id neighbours, const ForEach& for_each, const Visit& visit) {
    if (neighbours <= 8) {
      visit_by<3>(for_each, visit);
    } else if (neighbours <= 16) {
      visit_by<4>(for_each, visit);
    } else if (neighbours <= 32) {
      visit_by<5>(for_each, visit);
    } else {
      visit_by<6>(for_each, visit);
    }
  }

 private:
  /// Ranks have so many bits.
  template <int bits, class ForEach, class Visit>
  void visit_by(const ForEach& for_each, const Visit& visit) {
    constexpr std::uint32_t words = (1 << 2 * bits) / 64;
    std::uint64_t there[words] = {};
    for_each([&](Id second, Id third, Id triangle) {
      const std::uint32_t at = second << bits | third;
      // Always below `words`; where that is one, the compiler knows so too, and keeps it in a register.
      there[at / 64 % words] |= std::uint64_t(1) << at % 64;
      triangles_[at] = triangle;
    });
    for (std::uint32_t word = 0; word < words; ++word) {
      for (std::uint64_t rest = there[word]; rest != 0; rest &= rest - 1)
        visit(triangles_[64 * word + lowest_bit(rest)]);
    }
  }

  Id triangles_[most_neighbours * most_neighbours];
};

}  // namespace gale::detail
