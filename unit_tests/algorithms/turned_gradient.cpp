#include "algorithms/turned_gradient.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include <gtest/gtest.h>

namespace gale::test {

TurnedGradient::TurnedGradient(const CellsOf& mesh, const std::vector<double>& field,
                               const BruteForceGradient& gradient)
    : gradient_(gradient), rank_(field.size()) {
  std::vector<Id> by_rank(field.size());
  std::iota(by_rank.begin(), by_rank.end(), 0);
  std::sort(by_rank.begin(), by_rank.end(),
            [&](Id a, Id b) { return std::make_pair(field[a], a) < std::make_pair(field[b], b); });
  for (std::size_t r = 0; r < by_rank.size(); ++r) rank_[by_rank[r]] = static_cast<Id>(r);
  for (const Simplex& cell : mesh.cells) {
    for (const Simplex& facet : facets_of(cell)) cells_of_[facet].push_back(cell);
  }
}

std::vector<Id> TurnedGradient::key(const Simplex& simplex) const {
  std::vector<Id> ranks;
  for (const Id v : simplex) ranks.push_back(rank_[v]);
  std::sort(ranks.begin(), ranks.end(), std::greater<Id>());
  return ranks;
}

Simplex TurnedGradient::partner(const Simplex& simplex, std::size_t size) const {
  const auto found = gradient_.partner.find(simplex);
  return found != gradient_.partner.end() && found->second.size() == size ? found->second : Simplex{};
}

void TurnedGradient::cancel(const Simplex& lower, const Simplex& upper) {
  const std::size_t dimension = lower.size() - 1;
  ASSERT_EQ(gradient_.critical[dimension].erase(lower), 1u);
  ASSERT_EQ(gradient_.critical[dimension + 1].erase(upper), 1u);
  // All that a path may pass on its way down, and from where it gets there.
  std::map<Simplex, std::vector<Simplex>> from;
  std::vector<Simplex> rest = {upper};
  for (std::set<Simplex> seen = {upper}; !rest.empty();) {
    const Simplex at = rest.back();
    rest.pop_back();
    for (const Simplex& facet : facets_of(at)) {
      if (partner(facet, facet.size() + 1) == at) continue;
      from[facet].push_back(at);
      const Simplex next = partner(facet, facet.size() + 1);
      if (!next.empty() && seen.insert(next).second) rest.push_back(next);
    }
  }
  Simplex facet = lower;
  while (true) {
    ASSERT_EQ(from[facet].size(), 1u) << "paths between two that are cancelled";
    const Simplex above = from[facet][0];
    const Simplex next = partner(above, above.size() - 1);
    gradient_.partner[facet] = above;
    gradient_.partner[above] = facet;
    if (above == upper) return;
    facet = next;
  }
}

Simplex TurnedGradient::minimum_from(Id vertex) const {
  for (Simplex edge; !(edge = partner({vertex}, 2)).empty();) vertex = edge[0] == vertex ? edge[1] : edge[0];
  return {vertex};
}

/// Empty if the path leaves through the surface.
Simplex TurnedGradient::maximum_from(Simplex cell) const {
  for (Simplex facet; !(facet = partner(cell, cell.size() - 1)).empty();) {
    const auto& sides = cells_of_.at(facet);
    const auto next = std::find_if(sides.begin(), sides.end(), [&](const Simplex& side) { return side != cell; });
    if (next == sides.end()) return {};
    cell = *next;
  }
  return cell;
}

void TurnedGradient::cancel_with_minima(std::vector<Simplex> saddles) {
  std::sort(saddles.begin(), saddles.end(), [this](const auto& a, const auto& b) { return is_below(a, b); });
  for (const Simplex& saddle : saddles) {
    const Simplex one = minimum_from(saddle[0]), other = minimum_from(saddle[1]);
    ASSERT_NE(one, other);
    cancel(is_below(one, other) ? other : one, saddle);
  }
}

void TurnedGradient::cancel_with_maxima(std::vector<Simplex> saddles) {
  std::sort(saddles.begin(), saddles.end(), [this](const auto& a, const auto& b) { return is_below(b, a); });
  for (const Simplex& saddle : saddles) {
    const auto& sides = cells_of_.at(saddle);
    const Simplex one = maximum_from(sides[0]), other = sides.size() > 1 ? maximum_from(sides[1]) : Simplex{};
    ASSERT_NE(one, other);
    cancel(saddle, one.empty() || (!other.empty() && is_below(other, one)) ? other : one);
  }
}

}  // namespace gale::test
