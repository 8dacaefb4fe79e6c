#include "algorithms/brute_force_persistence.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include "algorithms/named_complex.hpp"

namespace gale::test {

namespace {

/// A simplex by the ranks of its vertices, descending.
using Cell = std::vector<Id>;

struct Ranks {
  explicit Ranks(const std::vector<double>& field) : vertex(field.size()), of(field.size()) {
    std::iota(vertex.begin(), vertex.end(), 0);
    std::sort(vertex.begin(), vertex.end(),
              [&](Id a, Id b) { return std::make_pair(field[a], a) < std::make_pair(field[b], b); });
    for (std::size_t r = 0; r < vertex.size(); ++r) of[vertex[r]] = static_cast<Id>(r);
  }

  Cell cell(const Simplex& simplex) const {
    Cell cell;
    for (const Id v : simplex) cell.push_back(of[v]);
    std::sort(cell.begin(), cell.end(), std::greater<Id>());
    return cell;
  }

  Simplex simplex(const Cell& cell) const {
    Simplex simplex;
    for (const Id r : cell) simplex.push_back(vertex[r]);
    std::sort(simplex.begin(), simplex.end());
    return simplex;
  }

  std::vector<Id> vertex, of;
};

/// A sum over Z2 of simplices of one dimension.
using Sum = std::set<Cell>;

void add(Sum& to, const Cell& cell) {
  if (!to.insert(cell).second) to.erase(cell);
}

void add(Sum& to, const Sum& more) {
  for (const Cell& cell : more) add(to, cell);
}

/// The standard algorithm: goes through columns in order, and calls pair(lower, upper) for each pair.
template <class Pair>
void reduce(const std::vector<std::pair<Cell, Sum>>& columns, const Pair& pair) {
  std::map<Cell, Sum> reduced;  // by pivot
  for (const auto& [cell, boundary] : columns) {
    Sum left = boundary;
    while (!left.empty()) {
      const auto other = reduced.find(*left.rbegin());
      if (other == reduced.end()) break;
      add(left, Sum(other->second));
    }
    if (left.empty()) continue;
    const Cell pivot = *left.rbegin();
    pair(pivot, cell);
    reduced[pivot] = std::move(left);
  }
}

/// Boundaries in a Morse complex.
class RisingPaths {
 public:
  RisingPaths(const Ranks& ranks, const BruteForceGradient& gradient) {
    for (const auto& [one, other] : gradient.partner) partner_[ranks.cell(one)] = ranks.cell(other);
  }

  Sum boundary(const Cell& cell) {
    Sum sum;
    for (const Cell& facet : facets_of(cell)) add(sum, below(facet));
    return sum;
  }

 private:
  /// The critical simplices that an odd number of paths through a simplex falls to.
  const Sum& below(const Cell& cell) {
    const auto known = below_.find(cell);
    if (known != below_.end()) return known->second;
    Sum sum;
    const auto partner = partner_.find(cell);
    if (partner == partner_.end()) {
      sum = {cell};
    } else if (partner->second.size() > cell.size()) {
      for (const Cell& facet : facets_of(partner->second)) {
        if (facet != cell) add(sum, below(facet));
      }
    }
    return below_[cell] = sum;
  }

  std::map<Cell, Cell> partner_;
  std::map<Cell, Sum> below_;
};

}  // namespace

NamedPairs brute_force_pairs(const std::vector<double>& field, const BruteForceGradient& gradient) {
  const Ranks ranks(field);
  RisingPaths paths(ranks, gradient);
  NamedPairs found;
  found.essential = gradient.critical;
  for (int d = 0; d < 3; ++d) {
    std::set<Cell> cells;
    for (const Simplex& simplex : gradient.critical[d + 1]) cells.insert(ranks.cell(simplex));
    std::vector<std::pair<Cell, Sum>> columns;
    for (const Cell& cell : cells) columns.push_back({cell, paths.boundary(cell)});
    reduce(columns, [&](const Cell& lower, const Cell& upper) {
      found.pairs[d].insert({ranks.simplex(lower), ranks.simplex(upper)});
      found.essential[d].erase(ranks.simplex(lower));
      found.essential[d + 1].erase(ranks.simplex(upper));
    });
  }
  return found;
}

NamedPairs named_pairs(const DiscreteGradient& gradient, const PersistencePairs& pairs) {
  const auto critical = named(MorseSmaleComplex{gradient, {}, gradient.critical()}).critical;
  NamedPairs all;
  for (int d = 0; d < 3; ++d) {
    for (const auto& pair : pairs.pairs[d])
      all.pairs[d].insert({critical[d].at(pair.lower), critical[d + 1].at(pair.upper)});
  }
  for (int d = 0; d < 4; ++d) {
    for (const Id place : pairs.essential[d]) all.essential[d].insert(critical[d].at(place));
  }
  return all;
}

VertexPairs brute_force_vertex_pairs(const CellsOf& mesh, const std::vector<double>& field) {
  const Ranks ranks(field);
  std::array<std::set<Cell>, 4> cells, unpaired;
  for (Id r = 0; r < mesh.vertices; ++r) cells[0].insert({r});
  for (const Simplex& corners : mesh.cells) cells[mesh.dimension].insert(ranks.cell(corners));
  for (int d = 3; d > 1; --d) {
    for (const Cell& cell : cells[d]) {
      for (const Cell& facet : facets_of(cell)) cells[d - 1].insert(facet);
    }
  }
  unpaired = cells;
  VertexPairs found;
  for (int d = 0; d < 3; ++d) {
    std::vector<std::pair<Cell, Sum>> columns;
    for (const Cell& cell : cells[d + 1]) {
      const auto facets = facets_of(cell);
      columns.push_back({cell, Sum(facets.begin(), facets.end())});
    }
    reduce(columns, [&](const Cell& lower, const Cell& upper) {
      if (lower[0] != upper[0]) found.insert({d, ranks.vertex[lower[0]], ranks.vertex[upper[0]]});
      unpaired[d].erase(lower);
      unpaired[d + 1].erase(upper);
    });
  }
  for (int d = 0; d < 4; ++d) {
    for (const Cell& cell : unpaired[d]) found.insert({d, ranks.vertex[cell[0]], -1});
  }
  return found;
}

VertexPairs vertex_pairs(const std::vector<double>& field, const NamedPairs& pairs) {
  const Ranks ranks(field);
  const auto highest = [&](const Simplex& simplex) { return ranks.vertex[ranks.cell(simplex)[0]]; };
  VertexPairs found;
  for (int d = 0; d < 3; ++d) {
    for (const auto& [lower, upper] : pairs.pairs[d]) {
      if (highest(lower) != highest(upper)) found.insert({d, highest(lower), highest(upper)});
    }
  }
  for (int d = 0; d < 4; ++d) {
    for (const Simplex& simplex : pairs.essential[d]) found.insert({d, highest(simplex), -1});
  }
  return found;
}

}  // namespace gale::test
