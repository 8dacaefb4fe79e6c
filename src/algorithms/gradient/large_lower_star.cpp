#include <algorithm>

#include <gale/algorithms/gradient/large_lower_star.hpp>

namespace gale::detail {

void LargeLowerStar::build(const std::vector<Id>& ranks, int edges, const LinkRow& link) {
  sides_.clear();
  corners_.clear();
  std::vector<std::pair<Corners, Id>> tetrahedra;
  for (Id a = 0; a < edges; ++a) corners_.push_back({a, -1, -1});
  for (Id t = 0; t < link.size(); ++t) {
    Corners c = {ranks[link(t, 0)], ranks[link(t, 1)], ranks[link(t, 2)]};
    std::sort(c.begin(), c.end(), std::greater<Id>());
    if (c[1] >= 0) sides_.push_back({c[0], c[1], t});
    if (c[2] < 0) continue;
    sides_.push_back({c[0], c[2], t});
    sides_.push_back({c[1], c[2], t});
    tetrahedra.push_back({c, t});
    corners_.push_back(c);
  }
  std::sort(sides_.begin(), sides_.end());
  for (const Corners& side : sides_) corners_.push_back({side[0], side[1], -1});
  std::sort(corners_.begin(), corners_.end());
  corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
  place_.assign(corners_.size(), no_id);
  for (const auto& [corners, t] : tetrahedra) place_[cell_of(corners)] = t;
  find_facets();
  connect();
}

int LargeLowerStar::cell_of(const Corners& corners) const {
  return static_cast<int>(std::lower_bound(corners_.begin(), corners_.end(), corners) - corners_.begin());
}

void LargeLowerStar::find_facets() {
  facets_.assign(corners_.size(), {-1, -1, -1});
  for (std::size_t cell = 0; cell < corners_.size(); ++cell) {
    const auto& [a, b, c] = corners_[cell];
    if (b < 0) continue;
    if (c < 0) {
      facets_[cell] = {cell_of({a, -1, -1}), cell_of({b, -1, -1}), -1};
    } else {
      facets_[cell] = {cell_of({a, b, -1}), cell_of({a, c, -1}), cell_of({b, c, -1})};
    }
  }
}

std::vector<LargeLowerStar::Corners>::const_iterator LargeLowerStar::first_side(int triangle) const {
  return std::lower_bound(sides_.begin(), sides_.end(), Corners{corners_[triangle][0], corners_[triangle][1], 0});
}

Id LargeLowerStar::across(int triangle, Id place) const {
  Id best = no_id;
  for_each_tetrahedron(triangle, [&](Id other) {
    if (other != place && (best == no_id || numbers_[other] < numbers_[best])) best = other;
  });
  return best;
}

}  // namespace gale::detail
