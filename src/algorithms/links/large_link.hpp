#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <gale/algorithms/links/small_link.hpp>
#include <gale/base/pair_key.hpp>

namespace gale::detail {

/// What SmallLink does, for a vertex with any number of neighbours: by union-find, and by sorting the link's edges. One
/// serves one thread, and keeps its memory.
class LargeLink {
 public:
  /// `is_lower(i)`: is the i-th neighbour below the vertex?
  template <class IsLower>
  LinkTopology topology(Id neighbours, const LinkRow& link, const IsLower& is_lower) {
    parent_.resize(neighbours);
    std::iota(parent_.begin(), parent_.end(), Id(0));
    edges_.clear();
    for (Id t = 0; t < link.size(); ++t) {
      const Id corner[3] = {link(t, 0), link(t, 1), link(t, 2)};
      for (int k = 0; k < 3; ++k) {
        const Id a = corner[k == 2 ? 0 : k], b = corner[k == 0 ? 1 : 2];
        edges_.push_back(pair_key(a, b));
        if (is_lower(a) == is_lower(b)) parent_[root(a)] = root(b);
      }
    }
    LinkTopology topology;
    for (Id i = 0; i < neighbours; ++i) {
      if (parent_[i] == i) ++(is_lower(i) ? topology.lower : topology.upper);
    }
    topology.on_surface = has_single_edge();
    return topology;
  }

 private:
  Id root(Id i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  bool has_single_edge() {
    std::sort(edges_.begin(), edges_.end());
    for (std::size_t i = 0; i < edges_.size();) {
      std::size_t end = i + 1;
      while (end < edges_.size() && edges_[end] == edges_[i]) ++end;
      if (end - i == 1) return true;
      i = end;
    }
    return false;
  }

  std::vector<Id> parent_;
  std::vector<std::uint64_t> edges_;  ///< of the link: the lower place in the upper half
};

}  // namespace gale::detail
