#include <algorithm>

#include <gale/algorithms/gradient/large_lower_fan.hpp>

namespace gale::detail {

void LargeLowerFan::build(const std::vector<Id>& ranks, int edges, const LinkRow& link) {
  cells_.clear();
  sides_.clear();
  for (Id a = 0; a < edges; ++a) cells_.push_back({a, -1, no_id});
  for (Id t = 0; t < link.size(); ++t) {
    const auto [b, a] = std::minmax({ranks[link(t, 0)], ranks[link(t, 1)]});
    if (a >= 0) sides_.push_back({a, t});
    if (b < 0) continue;
    sides_.push_back({b, t});
    cells_.push_back({a, b, t});
  }
  std::sort(cells_.begin(), cells_.end());
  std::sort(sides_.begin(), sides_.end());
  side_begin_.assign(edges + 1, 0);
  for (const auto& side : sides_) ++side_begin_[side.first + 1];
  for (Id a = 0; a < edges; ++a) side_begin_[a + 1] += side_begin_[a];
  std::vector<int> edge_cell(edges);
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    if (cells_[cell].b < 0) edge_cell[cells_[cell].a] = static_cast<int>(cell);
  }
  facets_.assign(cells_.size(), {-1, -1, -1});
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    if (cells_[cell].b >= 0) facets_[cell] = {edge_cell[cells_[cell].a], edge_cell[cells_[cell].b], -1};
  }
  connect();
}

Id LargeLowerFan::across(int edge, Id place) const {
  Id best = no_id;
  for_each_triangle(edge, [&](Id other) {
    if (other != place && (best == no_id || numbers_[other] < numbers_[best])) best = other;
  });
  return best;
}

}  // namespace gale::detail
