#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/base/types.hpp>

namespace gale::detail {

/// The triangles of a lower star, each by the ranks a > b of its lower vertices, numbered in lexicographic order. For
/// any number of them. One serves one thread, and keeps its memory.
class LowerTriangles {
 public:
  /// Begins a lower star with `edges` edges, in a star of `triangles` triangles.
  void begin(Id edges, Id triangles) {
    edges_ = edges;
    first_.resize(edges + 1);
    added_count_ = 0;
    if (added_.size() < std::size_t(triangles) + 1) {
      added_.resize(std::size_t(triangles) + 1);
      low_.resize(added_.size());
    }
  }

  /// Adds each triangle once, in any order, with a and b in any order. If one of them is below 0, the triangle isn't in
  /// the lower star, and nothing is added. Without a branch, which no processor could predict.
  void add(Id a, Id b) {
    added_[added_count_] = {a, b};
    added_count_ += (a | b) >= 0;
  }

  /// Numbers them, after the last was added.
  void number() { has_bits() ? number_by_bits() : number_by_sorting(); }

  Id size() const { return added_count_; }

  /// The triangles of `a` are first(a) to first(a + 1) - 1; low(triangle) is the b of one.
  Id first(Id a) const { return first_[a]; }
  Id low(Id triangle) const { return low_[triangle]; }

  /// The number of one that was added.
  Id operator()(Id a, Id b) const {
    if (has_bits()) return number_[a][b];
    return static_cast<Id>(std::lower_bound(low_.begin() + first_[a], low_.begin() + first_[a + 1], b) - low_.begin());
  }

 private:
  struct Triangle {
    Id a, b;
  };

  static constexpr Id most_bits = 64;

  bool has_bits() const { return edges_ <= most_bits; }

  void number_by_bits() {
    std::fill_n(below_, edges_, std::uint64_t(0));
    for (Id i = 0; i < added_count_; ++i) {
      const auto [a, b] = added_[i];
      below_[a] |= std::uint64_t(1) << b;
      below_[b] |= std::uint64_t(1) << a;  // one of the two isn't read
    }
    Id count = 0;
    for (Id a = 0; a < edges_; ++a) {
      first_[a] = count;
      for (std::uint64_t rest = below_[a] & ((std::uint64_t(1) << a) - 1); rest != 0; rest &= rest - 1) {
        const int b = lowest_bit(rest);
        number_[a][b] = static_cast<std::int16_t>(count);
        low_[count++] = b;
      }
    }
    first_[edges_] = count;
  }

  void number_by_sorting() {
    for (Id i = 0; i < added_count_; ++i) {
      auto& [a, b] = added_[i];
      if (a < b) std::swap(a, b);
    }
    std::sort(added_.begin(), added_.begin() + added_count_, [](const Triangle& one, const Triangle& other) {
      return one.a != other.a ? one.a < other.a : one.b < other.b;
    });
    Id next = 0;
    for (Id i = 0; i < added_count_; ++i) {
      while (next <= added_[i].a) first_[next++] = i;
      low_[i] = added_[i].b;
    }
    while (next <= edges_) first_[next++] = added_count_;
  }

  Id edges_ = 0;
  std::vector<Id> first_, low_;
  std::vector<Triangle> added_;  ///< with room for one more
  Id added_count_ = 0;
  std::uint64_t below_[most_bits];  ///< for each rank a bit for each other that it has a triangle with
  std::int16_t number_[most_bits][most_bits];
};

}  // namespace gale::detail
