#include "support/brute_force.hpp"

#include <algorithm>
#include <map>

namespace gale::test {

namespace {

/// The subsets of a size, as sorted lists.
std::set<std::vector<Id>> subsets(const std::vector<Id>& set, std::size_t size) {
  std::set<std::vector<Id>> found;
  for (unsigned members = 0; members < 1u << set.size(); ++members) {
    std::vector<Id> subset;
    for (std::size_t i = 0; i < set.size(); ++i) {
      if (members >> i & 1) subset.push_back(set[i]);
    }
    if (subset.size() == size) found.insert(subset);
  }
  return found;
}

BruteForce::Table transposed(const BruteForce::Table& table, std::size_t columns) {
  BruteForce::Table result(columns);
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (const Id j : table[i]) result.at(j).push_back(static_cast<Id>(i));
  }
  return result;
}

}  // namespace

BruteForce::BruteForce(const InputMesh& mesh)
    : vv(mesh.points.size()), vt(mesh.points.size()), on_surface(mesh.points.size()), tetrahedra_(mesh.tetrahedra) {
  std::map<std::set<Id>, int> tetrahedra_of_triangle;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const std::set<Id> corners(mesh.tetrahedra[t].begin(), mesh.tetrahedra[t].end());
    for (const Id v : corners) {
      std::set<Id> others = corners;
      others.erase(v);
      vt[v].insert(static_cast<Id>(t));
      vv[v].insert(others.begin(), others.end());
      ++tetrahedra_of_triangle[others];
    }
  }
  for (const auto& [triangle, tetrahedra] : tetrahedra_of_triangle) {
    if (tetrahedra != 1) continue;
    for (const Id v : triangle) on_surface[v] = 1;
  }
}

const BruteForce::Table& BruteForce::simplices(int dimension) const {
  if (simplices_[dimension].empty()) find_simplices(dimension);
  return simplices_[dimension];
}

void BruteForce::find_simplices(int dimension) const {
  Table& found = simplices_[dimension];
  if (dimension == 0) {
    for (std::size_t v = 0; v < vv.size(); ++v) found.push_back({static_cast<Id>(v)});
  } else if (dimension == 3) {
    for (auto corners : tetrahedra_) {
      std::sort(corners.begin(), corners.end());
      found.emplace_back(corners.begin(), corners.end());
    }
  } else {
    std::set<std::vector<Id>> distinct;
    for (const auto& tetrahedron : simplices(3)) distinct.merge(subsets(tetrahedron, dimension + 1));
    found.assign(distinct.begin(), distinct.end());
  }
}

const BruteForce::Table& BruteForce::rows(Relation relation) const {
  const int x = row_dimension(relation), y = entry_dimension(relation);
  Table& table = rows_[static_cast<int>(relation)];
  if (!table.empty()) return table;
  if (relation == Relation::VV || relation == Relation::VT) {
    for (const auto& row : relation == Relation::VV ? vv : vt) table.emplace_back(row.begin(), row.end());
  } else {
    table = x > y ? parts(x, y) : x < y ? transposed(parts(y, x), simplices(x).size()) : neighbours(x);
  }
  return table;
}

/// The simplices of a lower dimension whose vertices each simplex has.
BruteForce::Table BruteForce::parts(int dimension, int part_dimension) const {
  std::map<std::vector<Id>, Id> number;
  for (const auto& part : simplices(part_dimension)) number.emplace(part, static_cast<Id>(number.size()));
  Table table;
  for (const auto& simplex : simplices(dimension)) {
    table.emplace_back();
    for (const auto& part : subsets(simplex, part_dimension + 1)) table.back().push_back(number.at(part));
    std::sort(table.back().begin(), table.back().end());
  }
  return table;
}

/// The simplices that share one of the next lower dimension with each.
BruteForce::Table BruteForce::neighbours(int dimension) const {
  const Table meetings = transposed(parts(dimension, dimension - 1), simplices(dimension - 1).size());
  Table table(simplices(dimension).size());
  for (const auto& together : meetings) {
    for (const Id a : together) {
      for (const Id b : together) {
        if (a != b) table[a].push_back(b);
      }
    }
  }
  for (auto& row : table) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }
  return table;
}

const BruteForce& brute_force_of(const std::string& mesh_name) {
  static std::map<std::string, BruteForce> known;
  const auto found = known.find(mesh_name);
  if (found != known.end()) return found->second;
  return known.emplace(mesh_name, BruteForce(mesh_named(mesh_name))).first->second;
}

}  // namespace gale::test
