#include "algorithms/gradient_reader.hpp"

#include <algorithm>
#include <string>

#include "support/arrays.hpp"

namespace gale::test {

namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

std::string text(const std::vector<Id>& ids) {
  std::string all = "(";
  for (const Id id : ids) all += (all.size() > 1 ? ", " : "") + std::to_string(id);
  return all + ")";
}

/// The vertex that one of two simplices has and the other hasn't.
Id difference(const Simplex& a, const Simplex& b) {
  Simplex in_one;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(in_one));
  return in_one.size() == 1 ? in_one[0] : -99;
}

/// GALE's corner of a tetrahedron that is in none of the other simplex's vertices.
int corner_beside(const Mesh& mesh, Id tetrahedron, const std::vector<Id>& triangle) {
  for (int corner = 0; corner < 4; ++corner) {
    const Id vertex = mesh.encoded().cells(tetrahedron, corner);
    if (std::find(triangle.begin(), triangle.end(), vertex) == triangle.end()) return corner;
  }
  return -1;
}

}  // namespace

PairTable pairs_of(const BruteForceGradient& gradient, const BruteForce& simplices) {
  PairTable table;
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (const Simplex& simplex : simplices.simplices(dimension)) {
      const auto found = gradient.partner.find(simplex);
      if (found == gradient.partner.end()) {
        table[dimension].push_back({-1, no_id});
      } else {
        table[dimension].push_back({static_cast<int>(found->second.size()) - 1, difference(simplex, found->second)});
      }
    }
  }
  return table;
}

GradientReader::GradientReader(const BruteForce& simplices, const Mesh& mesh)
    : simplices_(simplices),
      mesh_(mesh),
      tetrahedron_(mesh.cells()),
      sides_(simplices.simplices(2).size()),
      across_(mesh.cells()) {
  for (Id t = 0; t < mesh.cells(); ++t) tetrahedron_[mesh.cell_input()(t)] = t;
  for (int dimension = 0; dimension < 3; ++dimension) {
    gale_[dimension] = simplices.simplices(dimension);
    for (auto& simplex : gale_[dimension]) {
      for (Id& vertex : simplex) vertex = mesh.vertex_internal()(vertex);
    }
  }
  const auto& rows = simplices.rows(Relation::FT);
  for (std::size_t f = 0; f < rows.size(); ++f) {
    for (const Id t : rows[f]) {
      Side side = {tetrahedron_[t], corner_beside(mesh, tetrahedron_[t], gale_[2][f]), {}};
      for (const Id other : rows[f]) {
        if (other != t) side.others.push_back(tetrahedron_[other]);
      }
      std::sort(side.others.begin(), side.others.end());
      sides_[f].push_back(std::move(side));
      const auto other = std::find_if(rows[f].begin(), rows[f].end(), [&](Id one) { return one != t; });
      across_[t][difference(simplices.simplices(3)[t], simplices.simplices(2)[f])] =
          other == rows[f].end() ? no_id : *other;
    }
  }
}

PairTable GradientReader::pairs(const DiscreteGradient& gradient) const {
  PairTable table;
  for (const auto& v : gale_[0]) table[0].push_back(in_input_ids(gradient.pair_of_vertex(v[0])));
  for (const auto& e : gale_[1]) table[1].push_back(in_input_ids(gradient.pair_of_edge(e[0], e[1])));
  for (const auto& sides : sides_) table[2].push_back(pair_of_triangle(gradient, sides[0]));
  for (const Id t : tetrahedron_) table[3].push_back(in_input_ids(gradient.pair_of_cell(t)));
  return table;
}

AssertionResult GradientReader::match(const DiscreteGradient& gradient, const PairTable& expected) const {
  using Part = AssertionResult (GradientReader::*)(const DiscreteGradient&, const PairTable&) const;
  for (const Part part :
       {&GradientReader::match_pairs, &GradientReader::match_sides, &GradientReader::match_triangles_of_edges,
        &GradientReader::match_successors, &GradientReader::match_critical}) {
    const AssertionResult result = (this->*part)(gradient, expected);
    if (!result) return result;
  }
  return AssertionSuccess();
}

AssertionResult GradientReader::equal(const DiscreteGradient& a, const DiscreteGradient& b) const {
  const CriticalSimplices &one = a.critical(), &other = b.critical();
  if (one.vertices != other.vertices || one.edges != other.edges || one.triangles != other.triangles ||
      one.cells != other.cells || one.star_begin != other.star_begin || one.star != other.star) {
    return AssertionFailure() << "other critical simplices";
  }
  if (to_vector(a.vertex_successors()) != to_vector(b.vertex_successors())) return AssertionFailure() << "vertices";
  if (to_vector(a.cell_successors()) != to_vector(b.cell_successors())) {
    return AssertionFailure() << "tetrahedra";
  }
  for (const auto& e : gale_[1]) {
    if (a.triangle_of_edge(e[0], e[1]) != b.triangle_of_edge(e[0], e[1]))
      return AssertionFailure() << "edge " << text(e);
  }
  return AssertionSuccess();
}

Pair GradientReader::in_input_ids(const Partner& partner) const {
  if (partner.is_critical() != (partner.vertex == no_id)) return {partner.dimension, -98};
  return {partner.dimension, partner.is_critical() ? no_id : mesh_.vertex_input()(partner.vertex)};
}

Pair GradientReader::pair_of_triangle(const DiscreteGradient& gradient, const Side& side) const {
  const Row others = {side.others.data(), static_cast<Id>(side.others.size())};
  return in_input_ids(gradient.pair_of_triangle(side.tetrahedron, side.corner, others));
}

AssertionResult GradientReader::match_pairs(const DiscreteGradient& gradient, const PairTable& expected) const {
  const PairTable found = pairs(gradient);
  for (int dimension = 0; dimension < 4; ++dimension) {
    if (found[dimension].size() != expected[dimension].size())
      return AssertionFailure() << "simplices of dimension " << dimension;
    for (std::size_t i = 0; i < found[dimension].size(); ++i) {
      const Pair &is = found[dimension][i], &should = expected[dimension][i];
      if (is == should) continue;
      return AssertionFailure() << text(simplices_.simplices(dimension)[i]) << " has a pair of dimension "
                                << is.dimension << " that differs in " << is.vertex << ", not of dimension "
                                << should.dimension << " that differs in " << should.vertex;
    }
  }
  return AssertionSuccess();
}

/// Do all tetrahedra of a triangle agree on its pair?
AssertionResult GradientReader::match_sides(const DiscreteGradient& gradient, const PairTable& expected) const {
  for (std::size_t f = 0; f < sides_.size(); ++f) {
    for (const Side& side : sides_[f]) {
      if (pair_of_triangle(gradient, side) == expected[2][f]) continue;
      return AssertionFailure() << "triangle " << text(simplices_.simplices(2)[f])
                                << " as a face of GALE's tetrahedron " << side.tetrahedron;
    }
  }
  return AssertionSuccess();
}

AssertionResult GradientReader::match_triangles_of_edges(const DiscreteGradient& gradient,
                                                         const PairTable& expected) const {
  for (std::size_t e = 0; e < gale_[1].size(); ++e) {
    const Id a = gale_[1][e][0], b = gale_[1][e][1];
    const Id third = expected[1][e].dimension == 2 ? mesh_.vertex_internal()(expected[1][e].vertex) : no_id;
    const std::uint64_t* const keys = gradient.order().keys();
    const Id high = keys[a] > keys[b] ? a : b, low = keys[a] > keys[b] ? b : a;
    const bool same = gradient.triangle_of_edge(a, b) == third && gradient.triangle_of_edge(b, a) == third &&
                      gradient.triangle_of_lower_edge(high, low) == third;
    if (same) continue;
    return AssertionFailure() << "triangle_of_edge of " << text(simplices_.simplices(1)[e]);
  }
  return AssertionSuccess();
}

AssertionResult GradientReader::match_successors(const DiscreteGradient& gradient, const PairTable& expected) const {
  const auto vertex_successors = gradient.vertex_successors(), cell_successors = gradient.cell_successors();
  for (Id v = 0; v < mesh_.vertices(); ++v) {
    const Id inside = mesh_.vertex_internal()(v), other = expected[0][v].vertex;
    const Id successor = gradient.vertex_successor(inside);
    if (successor == (other == no_id ? no_id : mesh_.vertex_internal()(other)) &&
        vertex_successors(inside) == successor)
      continue;
    return AssertionFailure() << "successor of vertex " << v;
  }
  for (std::size_t t = 0; t < tetrahedron_.size(); ++t) {
    const Id successor = gradient.cell_successor(tetrahedron_[t]);
    if (cell_successors(tetrahedron_[t]) != successor) return AssertionFailure() << "cell_successors";
    const bool is_paired = expected[3][t].dimension == 2;
    const Id lowest = is_paired ? across_[t].at(expected[3][t].vertex) : no_id;
    const bool leaves = is_paired && lowest == no_id;
    const bool matches =
        leaves ? DiscreteGradient::leaves(successor) : successor == (lowest == no_id ? no_id : tetrahedron_[lowest]);
    if (!matches || DiscreteGradient::leaves(successor) != leaves) {
      return AssertionFailure() << "tetrahedron " << t << " has GALE's " << successor << " as its successor, not "
                                << (leaves ? "the outside" : "that of input " + std::to_string(lowest));
    }
  }
  return AssertionSuccess();
}

/// Are they those that have no pair, in the order of their input numbers, each from its highest to its lowest vertex?
AssertionResult GradientReader::match_critical(const DiscreteGradient& gradient, const PairTable& expected) const {
  const CriticalSimplices& critical = gradient.critical();
  std::array<std::vector<std::vector<Id>>, 4> found, should;
  const auto add = [&](int dimension, const auto& vertices) {
    found[dimension].emplace_back(vertices.begin(), vertices.end());
  };
  for (const Id vertex : critical.vertices) add(0, std::array<Id, 1>{vertex});
  for (const auto& edge : critical.edges) add(1, edge);
  for (const auto& triangle : critical.triangles) add(2, triangle);
  for (const Id tetrahedron : critical.cells) add(3, std::array<Id, 1>{tetrahedron});
  const std::uint64_t* const keys = gradient.order().keys();
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < expected[dimension].size(); ++i) {
      if (expected[dimension][i].dimension >= 0) continue;
      auto vertices = dimension == 3 ? std::vector<Id>{tetrahedron_[i]} : gale_[dimension][i];
      if (dimension < 3) std::sort(vertices.begin(), vertices.end(), [&](Id a, Id b) { return keys[a] > keys[b]; });
      should[dimension].push_back(vertices);
    }
    if (found[dimension] != should[dimension])
      return AssertionFailure() << "critical simplices of dimension " << dimension;
    if (critical.counts()[dimension] != static_cast<Id>(should[dimension].size()))
      return AssertionFailure() << "counts";
  }
  std::vector<Id> begin = {0}, star;
  for (std::size_t f = 0; f < sides_.size(); ++f) {
    if (expected[2][f].dimension >= 0) continue;
    for (const Side& side : sides_[f]) star.push_back(side.tetrahedron);
    begin.push_back(static_cast<Id>(star.size()));
  }
  if (critical.star_begin != begin || critical.star != star) return AssertionFailure() << "stars of critical triangles";
  return AssertionSuccess();
}

}  // namespace gale::test
