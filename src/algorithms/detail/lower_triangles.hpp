#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/mesh/simplices.hpp>

namespace gale::detail {

/// The triangles of a lower star, each by the ranks a > b of its lower vertices, numbered in lexicographic order. For any number of them. One serves one thread,
/// and keeps its memory.
class LowerTriangles {
 public:
  /// Of a star with so many edges; no triangles yet.
  void begin(Id edges) {
    edges_ = edges;
    first_.resize(edges + 1);
    pending_.clear();
    if (has_bits()) std::fill_n(below_, edges, std::uint64_t(0));
  }

  /// Each once, in any order. If b is below 0, it is no triangle of the lower star: nothing happens, without a branch that nobody can predict.
  void add(Id a, Id b) {
    if (has_bits()) {
      below_[a & (most_bits - 1)] |= std::uint64_t(b >= 0) << (b & (most_bits - 1));
    } else if (b >= 0) {
      pending_.push_back(std::uint64_t(a) << 32 | static_cast<std::uint32_t>(b));
    }
  }

  /// After the last: numbers them.
  void number() {
    low_.clear();
    has_bits() ? number_bits() : number_pending();
  }

  Id size() const { return static_cast<Id>(low_.size()); }

  /// Those of `a` are the triangles first(a) to first(a + 1) - 1; and the b of one.
  Id first(Id a) const { return first_[a]; }
  Id low(Id triangle) const { return low_[triangle]; }

  /// The number of one that was added.
  Id operator()(Id a, Id b) const {
    if (has_bits()) return number_[a][b];
    return find_in([this](Id i) { return low_[i]; }, first_[a], first_[a + 1], b);
  }

 private:
  static constexpr Id most_bits = 64;

  bool has_bits() const { return edges_ <= most_bits; }

  void number_bits() {
    for (Id a = 0; a < edges_; ++a) {
      first_[a] = size();
      for (std::uint64_t rest = below_[a]; rest != 0; rest &= rest - 1) {
        const int b = lowest_bit(rest);
        number_[a][b] = static_cast<std::int16_t>(low_.size());
        low_.push_back(b);
      }
    }
    first_[edges_] = size();
  }

  void number_pending() {
    std::sort(pending_.begin(), pending_.end());
    Id next = 0;
    for (const std::uint64_t both : pending_) {
      for (const Id a = static_cast<Id>(both >> 32); next <= a; ++next) first_[next] = size();
      low_.push_back(static_cast<Id>(both & 0xffffffff));
    }
    for (; next <= edges_; ++next) first_[next] = size();
  }

  Id edges_ = 0;
  std::vector<Id> first_, low_;
  std::uint64_t below_[most_bits] = {};  ///< for each a, its bs
  std::int16_t number_[most_bits][most_bits];
  std::vector<std::uint64_t> pending_;  ///< a in the upper half
};

}  // namespace gale::detail
