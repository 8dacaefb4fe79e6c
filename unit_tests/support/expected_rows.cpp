#include <algorithm>
#include <map>
#include <sstream>

#include "support/brute_force.hpp"

namespace gale::test {

namespace {

std::ostream& operator<<(std::ostream& out, const std::array<Id, 3>& three) {
  return out << '(' << three[0] << ' ' << three[1] << ' ' << three[2] << ')';
}

template <class Entries>
std::string listed(const Entries& entries) {
  std::ostringstream text;
  text << entries.size() << " entries:";
  for (const auto& entry : entries) text << ' ' << entry;
  return text.str();
}

template <class Entries, class Expected>
testing::AssertionResult same(RelationSet relation, Id simplex, const Entries& row, const Expected& expected) {
  if (std::equal(row.begin(), row.end(), expected.begin(), expected.end())) return testing::AssertionSuccess();
  return testing::AssertionFailure() << name_of(relation) << " of " << simplex << " has " << listed(row)
                                     << "\n  and should have " << listed(expected);
}

/// The highest dimension below 3 whose numbering the rows of these relations are about.
int highest_of(RelationSet relations) {
  int highest = 0;
  for (const Relation relation : members_of(relations)) {
    for (const int dimension : {row_dimension(relation), entry_dimension(relation)}) {
      if (dimension < 3) highest = std::max(highest, dimension);
    }
  }
  return highest;
}

}  // namespace

ExpectedRows::ExpectedRows(const InputMesh& input, const BruteForce& brute_force, const Mesh& mesh,
                           RelationSet relations)
    : simplices_(brute_force, mesh, highest_of(relations)) {
  const RelationSet tables = relations.has_links() ? relations | star_relations : relations;
  for (const Relation relation : members_of(tables)) {
    const auto& from = brute_force.rows(relation);
    const auto& row_number = simplices_.number[row_dimension(relation)];
    const auto& entry_number = simplices_.number[entry_dimension(relation)];
    Table& to = rows_[static_cast<int>(relation)];
    to.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
      auto& row = to.at(row_number[i]);
      for (const Id entry : from[i]) row.push_back(entry_number[entry]);
      std::sort(row.begin(), row.end());
    }
  }
  if (relations.has_links()) find_links(input, brute_force, mesh);
}

void ExpectedRows::find_links(const InputMesh& input, const BruteForce& brute_force, const Mesh& mesh) {
  const auto& vertex_internal = simplices_.number[0];
  link.resize(input.points.size());
  for (Id input_vertex = 0; input_vertex < input.vertices(); ++input_vertex) {
    const Id v = vertex_internal[input_vertex];
    std::map<Id, Id> place;
    for (const Id neighbour : vv[v]) place.emplace(neighbour, static_cast<Id>(place.size()));
    for (const Id t : vt[v]) {
      std::set<Id> places;
      for (const Id corner : brute_force.simplices(3)[mesh.cell_input()(t)]) {
        if (corner != input_vertex) places.insert(place.at(vertex_internal[corner]));
      }
      link[v].emplace_back();
      std::copy(places.begin(), places.end(), link[v].back().begin());
    }
  }
}

testing::AssertionResult ExpectedRows::match(Relation relation, Id simplex, const Row& row) const {
  return same(relation, simplex, row, (*this)[relation].at(simplex));
}

testing::AssertionResult ExpectedRows::match(Id vertex, const LinkRow& row) const {
  std::vector<std::array<Id, 3>> copy;
  for (Id i = 0; i < row.size(); ++i) copy.push_back({row(i, 0), row(i, 1), row(i, 2)});
  return same(link_form, vertex, copy, link.at(vertex));
}

testing::AssertionResult ExpectedRows::match(const SegmentRows& rows, RelationSet wanted) const {
  auto result = match_intervals(rows, wanted);
  for (const Relation relation : members_of(wanted)) {
    for (const Id simplex : rows.interval(relation)) {
      if (result) result = match(relation, simplex, rows[relation][simplex]);
    }
  }
  if (wanted.has_links()) {
    for (const Id vertex : rows.interval(0)) {
      if (result) result = match(vertex, rows.links()[vertex]);
    }
  }
  return result ? result : result << "\n  in segment " << rows.segment();
}

/// Intervals of a dimension that nobody needed may be empty.
testing::AssertionResult ExpectedRows::match_intervals(const SegmentRows& rows, RelationSet wanted) const {
  for (int dimension = 0; dimension < 4; ++dimension) {
    const auto in_dimension = [dimension](Relation relation) { return row_dimension(relation) == dimension; };
    const auto members = members_of(wanted);
    const bool needed =
        std::any_of(members.begin(), members.end(), in_dimension) || (dimension == 0 && wanted.has_links());
    if (simplices_.vertices[dimension].empty() ||
        (!needed && rows.interval(dimension).first == rows.interval(dimension).last))
      continue;
    const Interval expected = simplices_.internal_to(rows.segment(), dimension);
    if (rows.interval(dimension).first == expected.first && rows.interval(dimension).last == expected.last) continue;
    return testing::AssertionFailure() << "simplices of dimension " << dimension << " from "
                                       << rows.interval(dimension).first << " to before "
                                       << rows.interval(dimension).last << "\n  should go from " << expected.first
                                       << " to before " << expected.last;
  }
  return testing::AssertionSuccess();
}

}  // namespace gale::test
