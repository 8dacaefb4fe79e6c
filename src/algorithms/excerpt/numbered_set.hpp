#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <gale/base/atomic.hpp>
#include <gale/base/bits.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/types.hpp>

namespace gale::detail {

/// The numbers of a NumberedSet's members, wherever its words lie. Owns nothing.
struct MemberNumbers {
  const CountedWord* words;

  /// The number of a member.
  KOKKOS_FUNCTION Id operator[](Id place) const { return words[static_cast<std::size_t>(place) >> 6].rank(place & 63); }
};

/// A set of places, a bit each. Once all members are there it numbers them in their order.
class NumberedSet {
 public:
  /// Makes an empty set of the places 0 to places - 1.
  explicit NumberedSet(Id places) : words_(zeros<CountedWord>((static_cast<std::size_t>(places) >> 6) + 1)) {}

  /// Adds a place, while other threads may add some; false where it was a member before.
  bool insert(Id place) {
    std::uint64_t& bits = words_[static_cast<std::size_t>(place) >> 6].bits;
    const std::uint64_t bit = std::uint64_t(1) << (place & 63);
    return (atomic_read(&bits) & bit) == 0 && (atomic_or(&bits, bit) & bit) == 0;
  }

  /// Adds places that are bits of words.
  void insert_bits(const std::vector<std::uint64_t>& bits) {
    parallel_for("GALE::insert_bits", HostExecutionSpace(), bits.size(), [&](Offset w) { words_[w].bits |= bits[w]; });
  }

  /// Has a place that is soon asked for or added brought near.
  void prefetch(Id place) const { __builtin_prefetch(&words_[static_cast<std::size_t>(place) >> 6], 1); }

  bool has(Id place) const { return words_[static_cast<std::size_t>(place) >> 6].has(place & 63); }

  /// Numbers the members, on all threads. Once; none is added afterwards.
  void number() {
    const Offset words = static_cast<Offset>(words_.size());
    std::vector<Id> before = of_parts("GALE::count_members", words, [&](Offset first, Offset last) {
      Id count = 0;
      for (Offset w = first; w < last; ++w) count += count_bits(words_[w].bits);
      return count;
    });
    for (Id& part : before) count_ += std::exchange(part, count_);
    for_parts("GALE::number_members", words, static_cast<int>(before.size()), [&](int part, Offset first, Offset last) {
      Id next = before[part];
      for (Offset w = first; w < last; ++w) {
        words_[w].before = next;
        next += count_bits(words_[w].bits);
      }
    });
  }

  /// Calls visit(place, number) for each member, on all threads.
  template <class Visit>
  void for_each(const char* label, const Visit& visit) const {
    parallel_for(label, HostExecutionSpace(), words_.size(), [&](Offset i) {
      const CountedWord& word = words_[i];
      Id number = word.before;
      for (std::uint64_t bits = word.bits; bits != 0; bits &= bits - 1)
        visit(static_cast<Id>(i << 6) + lowest_bit(bits), number++);
    });
  }

  /// How many members were numbered.
  Id count() const { return count_; }

  /// The number of a member.
  Id operator[](Id place) const { return MemberNumbers{words_.data()}[place]; }

  /// 64 places each.
  const std::vector<CountedWord>& words() const { return words_; }

 private:
  std::vector<CountedWord> words_;
  Id count_ = 0;
};

}  // namespace gale::detail
