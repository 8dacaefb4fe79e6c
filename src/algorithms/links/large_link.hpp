#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <gale/algorithms/links/small_link.hpp>
#include <gale/base/bits.hpp>
#include <gale/base/ordered.hpp>

namespace gale::detail {

/// The link of a vertex with any number of neighbours: its edges, sorted. One serves one thread, for one vertex after
/// the other, and keeps its memory. Time O(n log n) in the length of the link.
class LargeLink {
 public:
  void build(const LinkRow& link) {
    std::vector<Id>& ends = parent_;  // of the edges of a triangle mesh's link
    edges_.clear();
    ends.clear();
    for (Id t = 0; t < link.size(); ++t) {
      const Id a = link(t, 0), b = link(t, 1);
      edges_.push_back(pair_key(a, b));
      if (link.others == 2) {
        ends.insert(ends.end(), {a, b});
      } else {
        edges_.insert(edges_.end(), {pair_key(a, link(t, 2)), pair_key(b, link(t, 2))});
      }
    }
    std::sort(edges_.begin(), edges_.end());
    std::sort(ends.begin(), ends.end());
    is_open_ = link.others == 2 ? has_single(ends) : has_single(edges_);
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  }

  /// Has the link an edge with one triangle only, or, of triangles, a vertex with one edge only?
  bool is_open() const { return is_open_; }

  /// The link's edges, each once, as pairs of places in the VV row, the lower place first; ascending.
  const std::vector<std::uint64_t>& edges() const { return edges_; }

  /// Classifies the vertex. `is_lower(i)`: is the i-th neighbour below it?
  template <class IsLower>
  LinkTopology topology(Id neighbours, const IsLower& is_lower) {
    parent_.resize(neighbours);
    std::iota(parent_.begin(), parent_.end(), Id(0));
    for (const std::uint64_t edge : edges_) {
      const Id a = pair_first(edge), b = pair_second(edge);
      if (is_lower(a) == is_lower(b)) parent_[root_of(parent_, a)] = root_of(parent_, b);
    }
    LinkTopology topology;
    for (Id i = 0; i < neighbours; ++i) {
      if (parent_[i] == i) ++(is_lower(i) ? topology.lower : topology.upper);
    }
    topology.on_surface = is_open_;
    return topology;
  }

  /// Calls visit(i) for one neighbour of each component that topology() counted.
  template <class Visit>
  void for_each_component(Id neighbours, const Visit& visit) const {
    for (Id i = 0; i < neighbours; ++i) {
      if (parent_[i] == i) visit(i);
    }
  }

 private:
  /// Is there a value that comes once only? They ascend.
  template <class T>
  static bool has_single(const std::vector<T>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const bool came_before = i > 0 && values[i] == values[i - 1];
      if (!came_before && (i + 1 == values.size() || values[i] != values[i + 1])) return true;
    }
    return false;
  }

  std::vector<std::uint64_t> edges_;
  std::vector<Id> parent_;
  bool is_open_ = false;
};

/// Classifies a vertex with any number of neighbours.
inline LinkTopology topology_of(LargeLink& large, const std::uint64_t* keys, Id vertex, const Row& neighbours,
                                const LinkRow& link) {
  if (neighbours.size() <= SmallLink::capacity) {
    const auto lower = lower_neighbours<std::uint64_t>(keys, vertex, neighbours);
    return SmallLink(neighbours.size(), link).topology(neighbours.size(), lower);
  }
  large.build(link);
  return large.topology(neighbours.size(), [&](Id i) { return keys[neighbours[i]] < keys[vertex]; });
}

}  // namespace gale::detail
