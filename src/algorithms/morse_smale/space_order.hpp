#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include <gale/base/types.hpp>

namespace gale::detail {

/// The places of `simplices` in the order of their highest vertices. GALE numbers vertices along a curve, so neighbours
/// in this order are close to each other, and what a thread reads for one is still in its caches for the next.
template <class Simplex>
std::vector<Id> space_order(const std::vector<Simplex>& simplices) {
  std::vector<Id> order(simplices.size());
  std::iota(order.begin(), order.end(), Id(0));
  std::sort(order.begin(), order.end(), [&](Id i, Id j) { return simplices[i] < simplices[j]; });
  return order;
}

}  // namespace gale::detail
