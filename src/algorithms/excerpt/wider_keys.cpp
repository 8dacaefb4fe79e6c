#include <algorithm>
#include <numeric>

#include <gale/algorithms/excerpt/wider_keys.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

WiderKeys::WiderKeys(const WiderSimplices& simplices) : simplices_(simplices) {
  if (!simplices.has_short_values()) {
    rank_vertices();
    return;
  }
  const Id own = simplices.own_vertices();
  others_.resize(simplices.vertices() - own);
  parallel_for("GALE::wider_keys", HostExecutionSpace(), others_.size(), [&](Offset i) {
    const Id vertex = own + static_cast<Id>(i);
    others_[i] = simplices_.value(vertex) << 32 | static_cast<std::uint32_t>(simplices_.names()[vertex]);
  });
}

/// Makes keys of all vertices' ranks: those of others come between.
void WiderKeys::rank_vertices() {
  const Id own = simplices_.own_vertices();
  const std::uint64_t* const keys = simplices_.order().keys();
  std::vector<Id> by_rank(own), others(simplices_.vertices() - own);
  for (Id v = 0; v < own; ++v) by_rank[keys[v]] = v;
  std::iota(others.begin(), others.end(), own);
  const auto is_less = [&](Id a, Id b) {
    const std::uint64_t value_a = simplices_.value(a), value_b = simplices_.value(b);
    return value_a != value_b ? value_a < value_b : simplices_.names()[a] < simplices_.names()[b];
  };
  std::sort(others.begin(), others.end(), is_less);
  std::vector<Id> all(simplices_.vertices());
  std::merge(by_rank.begin(), by_rank.end(), others.begin(), others.end(), all.begin(), is_less);
  ranks_.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) ranks_[all[i]] = i;
}

}  // namespace gale::detail
