#include <algorithm>

#include <gale/baselines/brute_force.hpp>

namespace gale::baselines {

namespace {

using Table = BruteForce::Table;

/// Calls visit(subset) for each subset of a size.
template <class Visit>
void for_each_subset(const std::vector<Id>& set, int size, const Visit& visit) {
  for (unsigned members = 0; members < 1u << set.size(); ++members) {
    std::vector<Id> subset;
    for (std::size_t i = 0; i < set.size(); ++i) {
      if (members >> i & 1) subset.push_back(set[i]);
    }
    if (subset.size() == static_cast<std::size_t>(size)) visit(subset);
  }
}

void make_distinct(std::vector<Id>& row) {
  std::sort(row.begin(), row.end());
  row.erase(std::unique(row.begin(), row.end()), row.end());
}

/// The rows that have each of `columns` ids.
Table transposed(const Table& table, std::size_t columns) {
  Table result(columns);
  for (std::size_t row = 0; row < table.size(); ++row) {
    for (const Id id : table[row]) result.at(id).push_back(static_cast<Id>(row));
  }
  return result;
}

/// The simplices that have something in common with each: `there` leads from a simplex to that, and `back` from it.
Table neighbours(const Table& there, const Table& back) {
  Table table(there.size());
  for (std::size_t simplex = 0; simplex < there.size(); ++simplex) {
    std::vector<Id>& row = table[simplex];
    for (const Id between : there[simplex]) {
      for (const Id other : back[between]) {
        if (other != static_cast<Id>(simplex)) row.push_back(other);
      }
    }
    make_distinct(row);
  }
  return table;
}

}  // namespace

const Table& BruteForce::simplices(int dimension) const {
  Table& found = simplices_[dimension];
  if (found.empty()) found = find_simplices(dimension);
  return found;
}

Table BruteForce::find_simplices(int dimension) const {
  Table found;
  if (dimension == 0) {
    for (Id v = 0; v < vertices_; ++v) found.push_back({v});
  } else if (dimension < dimension_) {
    for (const auto& cell : simplices_[dimension_])
      for_each_subset(cell, dimension + 1, [&](const std::vector<Id>& face) { found.push_back(face); });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }
  return found;
}

const Table& BruteForce::rows(Relation relation) const {
  Table& table = rows_[static_cast<int>(relation)];
  if (!table.empty()) return table;
  const int x = row_dimension(relation), y = entry_dimension(relation);
  const int shared = x != y ? y : x == 0 ? 1 : x - 1;  // vertices that are adjacent share an edge, others a face
  Table down = faces(std::max(x, shared), std::min(x, shared));
  Table up = transposed(down, simplices(std::min(x, shared)).size());
  if (x < shared) down.swap(up);
  table = x == y ? neighbours(down, up) : std::move(down);
  return table;
}

/// The faces that each simplex has.
Table BruteForce::faces(int dimension, int face_dimension) const {
  const Table& all = simplices(face_dimension);
  Table table;
  for (const auto& simplex : simplices(dimension)) {
    std::vector<Id>& row = table.emplace_back();
    for_each_subset(simplex, face_dimension + 1, [&](const std::vector<Id>& face) {
      row.push_back(static_cast<Id>(std::lower_bound(all.begin(), all.end(), face) - all.begin()));
    });
    std::sort(row.begin(), row.end());
  }
  return table;
}

}  // namespace gale::baselines
