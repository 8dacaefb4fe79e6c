#include "support/brute_force.hpp"

#include <algorithm>
#include <map>
#include <sstream>

namespace gale::test {

namespace {

std::ostream& operator<<(std::ostream& out, const std::array<Id, 3>& three) {
  return out << '(' << three[0] << ' ' << three[1] << ' ' << three[2] << ')';
}

template <class T>
std::string listed(const std::vector<T>& entries) {
  std::ostringstream text;
  text << entries.size() << " entries:";
  for (const T& entry : entries) text << ' ' << entry;
  return text.str();
}

template <class T>
testing::AssertionResult same(const char* relation, Id vertex, const std::vector<T>& row,
                              const std::vector<T>& expected) {
  if (row == expected) return testing::AssertionSuccess();
  return testing::AssertionFailure() << relation << " of vertex " << vertex << " has " << listed(row)
                                     << "\n  and should have " << listed(expected);
}

std::vector<Id> copy_of(const Row& row) { return {row.begin(), row.end()}; }

std::vector<std::array<Id, 3>> copy_of(const LinkRow& row) {
  std::vector<std::array<Id, 3>> copy;
  for (Id i = 0; i < row.size(); ++i) copy.push_back({row(i, 0), row(i, 1), row(i, 2)});
  return copy;
}

/// Ascending, after a permutation.
std::vector<Id> renumbered(const std::set<Id>& ids, const std::vector<Id>& permutation) {
  std::vector<Id> row;
  for (const Id id : ids) row.push_back(permutation[id]);
  std::sort(row.begin(), row.end());
  return row;
}

std::vector<Id> inverse_of(const Array<const Id, HostMemory>& permutation) {
  std::vector<Id> inverse(permutation.extent(0), no_id);
  for (std::size_t i = 0; i < inverse.size(); ++i) inverse.at(permutation(i)) = static_cast<Id>(i);
  return inverse;
}

}  // namespace

BruteForce::BruteForce(const InputMesh& mesh)
    : vv(mesh.points.size()), vt(mesh.points.size()), on_boundary(mesh.points.size()) {
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
    for (const Id v : triangle) on_boundary[v] = 1;
  }
}

const BruteForce& brute_force_of(const std::string& mesh_name) {
  static std::map<std::string, BruteForce> known;
  const auto found = known.find(mesh_name);
  if (found != known.end()) return found->second;
  return known.emplace(mesh_name, BruteForce(mesh_named(mesh_name))).first->second;
}

ExpectedRows::ExpectedRows(const InputMesh& input, const BruteForce& brute_force, const Mesh& mesh)
    : vv(input.points.size()), vt(input.points.size()), link(input.points.size()) {
  const auto vertex_internal = inverse_of(mesh.vertex_input());
  const auto tetrahedron_internal = inverse_of(mesh.tetrahedron_input());
  for (Id input_vertex = 0; input_vertex < input.vertices(); ++input_vertex) {
    const Id v = vertex_internal[input_vertex];
    vv[v] = renumbered(brute_force.vv[input_vertex], vertex_internal);
    vt[v] = renumbered(brute_force.vt[input_vertex], tetrahedron_internal);
    std::map<Id, Id> place;
    for (const Id neighbour : vv[v]) place.emplace(neighbour, static_cast<Id>(place.size()));
    for (const Id t : vt[v]) {
      std::set<Id> places;
      for (const Id corner : input.tetrahedra[mesh.tetrahedron_input()(t)]) {
        if (corner != input_vertex) places.insert(place.at(vertex_internal[corner]));
      }
      link[v].emplace_back();
      std::copy(places.begin(), places.end(), link[v].back().begin());
    }
  }
}

testing::AssertionResult ExpectedRows::match(const SegmentRows& rows, RelationSet wanted) const {
  for (Id v = rows.first(); v < rows.last(); ++v) {
    testing::AssertionResult result = testing::AssertionSuccess();
    if (wanted.has(Relation::VV)) result = same("VV", v, copy_of(rows[Relation::VV][v]), vv[v]);
    if (result && wanted.has(Relation::VT)) result = same("VT", v, copy_of(rows[Relation::VT][v]), vt[v]);
    if (result && wanted.has(Relation::link)) result = same("link", v, copy_of(rows.links()[v]), link[v]);
    if (!result) return result << "\n  in segment " << rows.segment();
  }
  return testing::AssertionSuccess();
}

}  // namespace gale::test
