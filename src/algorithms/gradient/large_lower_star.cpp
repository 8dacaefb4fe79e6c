#include <algorithm>
#include <functional>

#include <gale/algorithms/gradient/large_lower_star.hpp>

namespace gale::detail {

void LargeLowerStar::build(const std::vector<Id>& ranks, int edges, const LinkRow& link) {
  cells_.clear();
  for (Id a = 0; a < edges; ++a) cells_.push_back({a, -1, -1, no_id});
  find_sides(ranks, link);
  std::sort(cells_.begin(), cells_.end());
  const auto count = static_cast<int>(cells_.size());
  const auto side_count = static_cast<Id>(sides_.size());
  side_begin_.assign(count + 1, side_count);
  facets_.assign(count, {-1, -1, -1});
  edge_cell_.resize(edges);
  Id side = 0;
  for (int cell = 0; cell < count; ++cell) {
    const auto& [a, b, c, place] = cells_[cell];
    side_begin_[cell] = side;
    while (side < side_count && sides_[side][0] == a && sides_[side][1] == b) ++side;
    if (b < 0) {
      edge_cell_[a] = cell;
    } else if (c < 0) {
      facets_[cell] = {edge_cell_[a], edge_cell_[b], -1};
    } else {
      facets_[cell] = {triangle(a, b), triangle(a, c), triangle(b, c)};
    }
  }
  connect();
}

/// Finds the sides of the mesh's cells, and adds these cells; and their triangles, if they are tetrahedra.
void LargeLowerStar::find_sides(const std::vector<Id>& ranks, const LinkRow& link) {
  sides_.clear();
  for (Id t = 0; t < link.size(); ++t) {
    Ranked cell = {-1, -1, -1, t};
    for (int i = 0; i < link.others; ++i) cell[i] = ranks[link(t, i)];
    std::sort(cell.begin(), cell.begin() + 3, std::greater<Id>());
    const auto [a, b, c, place] = cell;
    if (link.others == 2) {
      if (a >= 0) sides_.push_back({a, -1, -1, t});
      if (b < 0) continue;
      sides_.push_back({b, -1, -1, t});
    } else {
      if (b >= 0) sides_.push_back({a, b, -1, t});
      if (c < 0) continue;
      sides_.push_back({a, c, -1, t});
      sides_.push_back({b, c, -1, t});
    }
    cells_.push_back(cell);
  }
  std::sort(sides_.begin(), sides_.end());
  if (link.others == 2) return;
  for (const auto& [a, b, none, place] : sides_) {
    const Ranked& last = cells_.back();
    if (last[0] != a || last[1] != b || last[2] >= 0) cells_.push_back({a, b, -1, no_id});
  }
}

int LargeLowerStar::triangle(Id a, Id b) const {
  return static_cast<int>(std::lower_bound(cells_.begin(), cells_.end(), Ranked{a, b, -1, no_id}) - cells_.begin());
}

Id LargeLowerStar::across(int facet, Id place) const {
  Id best = no_id;
  for_each_place(facet, [&](Id other) {
    if (other != place && (best == no_id || numbers_[other] < numbers_[best])) best = other;
  });
  return best;
}

void LargeLowerStar::connect() {
  cofacet_begin_.assign(facets_.size() + 1, 0);
  for (const auto& facets : facets_) {
    for (const int facet : facets) {
      if (facet >= 0) ++cofacet_begin_[facet + 1];
    }
  }
  for (std::size_t cell = 0; cell < facets_.size(); ++cell) cofacet_begin_[cell + 1] += cofacet_begin_[cell];
  cofacets_.resize(cofacet_begin_.back());
  std::vector<int> next(cofacet_begin_.begin(), cofacet_begin_.end() - 1);
  for (std::size_t cell = 0; cell < facets_.size(); ++cell) {
    for (const int facet : facets_[cell]) {
      if (facet >= 0) cofacets_[next[facet]++] = static_cast<int>(cell);
    }
  }
  settled_.assign(facets_.size(), 0);
  ready_ = deferred_ = Queue();
}

void LargeLowerStar::push(int cell) {
  for (int i = cofacet_begin_[cell]; i < cofacet_begin_[cell + 1]; ++i) {
    const int cofacet = cofacets_[i];
    int open = 0;
    for (const int facet : facets_[cofacet]) open += facet >= 0 && !settled_[facet];
    if (open == 1 && !settled_[cofacet]) ready_.push(cofacet);
  }
}

int LargeLowerStar::facet(int cell) const {
  for (const int facet : facets_[cell]) {
    if (facet >= 0 && !settled_[facet]) return facet;
  }
  return -1;
}

bool LargeLowerStar::take(Queue& from, int& cell) {
  while (!from.empty()) {
    cell = from.top();
    from.pop();
    if (!settled_[cell]) return true;
  }
  return false;
}

}  // namespace gale::detail
