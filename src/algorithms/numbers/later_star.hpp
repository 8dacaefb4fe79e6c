#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gale/algorithms/links/large_link.hpp>
#include <gale/algorithms/links/small_link.hpp>
#include <gale/base/bits.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

// The later star of a vertex: the edges and triangles in which no other vertex has a lower input id. Their other
// vertices are its later neighbours, which are named by GALE's ids. Both classes count these edges and triangles, and
// know each one's place among those of its dimension, in lexicographic order of input vertices.

/// The later star of a vertex with at most SmallLink::capacity neighbours.
class SmallLaterStar {
 public:
  /// `input`: GALE's vertex -> input vertex.
  SmallLaterStar(const OtherIds& input, Id vertex, const Row& neighbours, const LinkRow& link)
      : input_(input), neighbours_(neighbours), link_(neighbours.size(), link) {
    for (Id i = 0; i < neighbours.size(); ++i) later_ |= std::uint64_t(input[neighbours[i]] > input[vertex]) << i;
  }

  bool on_surface() const { return link_.is_open(); }
  Id edges() const { return count_bits(later_); }
  Id triangles() const { return ends(later_, later_) / 2; }

  /// Place of the edge to `other`; no_id if there is none.
  Id edge(Id other) const { return (later_ & bit_of(other)) == 0 ? no_id : count_bits(before(other)); }

  /// Place of the triangle with two vertices, of which `middle` has the lower input id; no_id if there is none. Before
  /// it are those with an earlier neighbour than `middle`, and those with `middle` and one between the two.
  Id triangle(Id middle, Id last) const {
    if ((later_ & bit_of(middle)) == 0 || (touching(middle) & later_ & bit_of(last)) == 0) return no_id;
    const std::uint64_t earlier = before(middle);
    return ends(earlier, later_) - ends(earlier, earlier) / 2 + count_bits(touching(middle) & before(last) & ~earlier);
  }

 private:
  /// How many triangles have a vertex in `from` and the other in `to`; twice where both are in both.
  Id ends(std::uint64_t from, std::uint64_t to) const {
    Id count = 0;
    for (; from != 0; from &= from - 1) count += count_bits(link_.touching(lowest_bit(from)) & to);
    return count;
  }

  /// The later neighbours with lower input ids than `other`.
  std::uint64_t before(Id other) const {
    std::uint64_t earlier = 0;
    for (std::uint64_t rest = later_; rest != 0; rest &= rest - 1) {
      if (input_[neighbours_[lowest_bit(rest)]] < input_[other]) earlier |= rest & (~rest + 1);
    }
    return earlier;
  }

  /// The bit of a neighbour; 0 for another vertex.
  std::uint64_t bit_of(Id other) const {
    const Id* const at = std::lower_bound(neighbours_.begin(), neighbours_.end(), other);
    return at != neighbours_.end() && *at == other ? std::uint64_t(1) << (at - neighbours_.begin()) : 0;
  }

  std::uint64_t touching(Id neighbour) const { return link_.touching(lowest_bit(bit_of(neighbour))); }

  OtherIds input_;
  Row neighbours_;
  SmallLink link_;
  std::uint64_t later_ = 0;
};

/// The later star of a vertex with any number of neighbours, by sorting. One serves one thread, and keeps its memory.
class LargeLaterStar {
 public:
  void build(const OtherIds& input, Id vertex, const Row& neighbours, const LinkRow& link) {
    input_ = input;
    edges_.clear();
    for (const Id neighbour : neighbours) {
      if (input[neighbour] > input[vertex]) edges_.push_back(input[neighbour]);
    }
    std::sort(edges_.begin(), edges_.end());
    link_.build(link);
    triangles_.clear();
    for (const std::uint64_t edge : link_.edges()) {
      const std::uint64_t triangle = key(neighbours[pair_first(edge)], neighbours[pair_second(edge)]);
      if (pair_first(triangle) > input[vertex]) triangles_.push_back(triangle);
    }
    std::sort(triangles_.begin(), triangles_.end());
  }

  bool on_surface() const { return link_.is_open(); }
  Id edges() const { return static_cast<Id>(edges_.size()); }
  Id triangles() const { return static_cast<Id>(triangles_.size()); }
  Id edge(Id other) const { return place(edges_, input_[other]); }
  Id triangle(Id middle, Id last) const { return place(triangles_, key(middle, last)); }

 private:
  /// Input ids, the lower one in the upper half.
  std::uint64_t key(Id a, Id b) const {
    const Id one = input_[a], other = input_[b];
    return one < other ? pair_key(one, other) : pair_key(other, one);
  }

  template <class Key>
  static Id place(const std::vector<Key>& keys, Key key) {
    const auto at = std::lower_bound(keys.begin(), keys.end(), key);
    return at != keys.end() && *at == key ? static_cast<Id>(at - keys.begin()) : no_id;
  }

  OtherIds input_;
  LargeLink link_;
  std::vector<Id> edges_;
  std::vector<std::uint64_t> triangles_;
};

}  // namespace gale::detail
