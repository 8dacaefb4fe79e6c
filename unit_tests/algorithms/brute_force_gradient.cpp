#include "algorithms/brute_force_gradient.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "algorithms/fields.hpp"

namespace gale::test {

namespace {

/// A simplex by the ranks of its vertices, descending: its own name, and the order in which the paper's queues have it.
using Cell = std::vector<Id>;

/// The lower star of a vertex: all simplices of which it is the highest vertex, itself not among them.
using LowerStar = std::set<Cell>;

struct Pairing {
  std::vector<std::pair<Cell, Cell>> pairs;
  std::vector<Cell> critical;
};

/// Algorithm 2 of the paper, ProcessLowerStars, for one vertex. Cells of one star have the same first rank, so they
/// compare as their keys do.
class Expansion {
 public:
  Expansion(const LowerStar& star, Pairing& result) : result_(result) {
    for (const Cell& cell : star) {
      if (cell.size() > 2) facets_[cell];
      for (std::size_t i = 1; i < cell.size() && cell.size() > 2; ++i) {
        Cell facet = cell;
        facet.erase(facet.begin() + i);
        facets_[cell].insert(facet);
        cofacets_[facet].insert(cell);
      }
    }
    const Cell least = *std::find_if(star.begin(), star.end(), [](const Cell& cell) { return cell.size() == 2; });
    for (const Cell& cell : star) {
      if (cell.size() == 2 && cell != least) zero_.insert(cell);
    }
    match({least[0]}, least);
    queue_cofacets(least);
    while (!one_.empty() || !zero_.empty()) {
      drain_one();
      if (!zero_.empty()) {
        const Cell cell = *zero_.begin();
        zero_.erase(cell);
        done_.insert(cell);
        result_.critical.push_back(cell);
        queue_cofacets(cell);
      }
    }
  }

 private:
  std::set<Cell> open_facets(const Cell& cell) const {
    std::set<Cell> open;
    for (const Cell& facet : facets_.at(cell)) {
      if (done_.count(facet) == 0) open.insert(facet);
    }
    return open;
  }

  void queue_cofacets(const Cell& cell) {
    const auto found = cofacets_.find(cell);
    if (found == cofacets_.end()) return;
    for (const Cell& cofacet : found->second) {
      if (done_.count(cofacet) == 0 && open_facets(cofacet).size() == 1) one_.insert(cofacet);
    }
  }

  void match(const Cell& facet, const Cell& cell) {
    result_.pairs.push_back({facet, cell});
    done_.insert(facet);
    done_.insert(cell);
    zero_.erase(facet);
  }

  void drain_one() {
    while (!one_.empty()) {
      const Cell cell = *one_.begin();
      one_.erase(cell);
      const auto open = open_facets(cell);
      if (open.empty()) {
        if (done_.count(cell) == 0) zero_.insert(cell);
        continue;
      }
      const Cell facet = *open.begin();
      match(facet, cell);
      one_.erase(facet);
      queue_cofacets(cell);
      queue_cofacets(facet);
    }
  }

  Pairing& result_;
  std::map<Cell, std::set<Cell>> facets_, cofacets_;
  std::set<Cell> zero_, one_, done_;
};

/// All that is a face of a cell, but vertices.
std::set<Cell> faces_of(const Cell& cell) {
  std::set<Cell> faces;
  for (unsigned members = 0; members < 1u << cell.size(); ++members) {
    Cell face;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      if (members >> i & 1) face.push_back(cell[i]);
    }
    if (face.size() > 1) faces.insert(face);
  }
  return faces;
}

}  // namespace

std::vector<Simplex> facets_of(const Simplex& simplex) {
  std::vector<Simplex> facets;
  for (std::size_t i = 0; i < simplex.size() && simplex.size() > 1; ++i) {
    facets.push_back(simplex);
    facets.back().erase(facets.back().begin() + static_cast<std::ptrdiff_t>(i));
  }
  return facets;
}

namespace {

template <class Corners>
std::vector<Simplex> ascending(const std::vector<Corners>& cells) {
  std::vector<Simplex> all;
  for (const Corners& corners : cells) {
    all.emplace_back(corners.begin(), corners.end());
    std::sort(all.back().begin(), all.back().end());
  }
  return all;
}

}  // namespace

CellsOf::CellsOf(const InputMesh& mesh) : vertices(mesh.vertices()), dimension(3), cells(ascending(mesh.tetrahedra)) {}

CellsOf::CellsOf(const InputSurface& surface)
    : vertices(surface.vertices()), dimension(2), cells(ascending(surface.triangles)) {}

BruteForceGradient::BruteForceGradient(const CellsOf& mesh, const std::vector<double>& field) {
  std::vector<Id> by_rank(mesh.vertices), rank(mesh.vertices);
  std::iota(by_rank.begin(), by_rank.end(), 0);
  std::sort(by_rank.begin(), by_rank.end(),
            [&](Id a, Id b) { return std::make_pair(field[a], a) < std::make_pair(field[b], b); });
  for (Id r = 0; r < mesh.vertices; ++r) rank[by_rank[r]] = r;
  std::map<Id, LowerStar> stars;
  for (const Simplex& corners : mesh.cells) {
    Cell cell;
    for (const Id v : corners) cell.push_back(rank[v]);
    std::sort(cell.begin(), cell.end(), std::greater<Id>());
    for (const Cell& face : faces_of(cell)) stars[face[0]].insert(face);
  }
  Pairing all;
  for (Id r = 0; r < mesh.vertices; ++r) {
    if (stars[r].empty()) {
      all.critical.push_back({r});
    } else {
      Expansion(stars[r], all);
    }
  }
  const auto simplex_of = [&](const Cell& cell) {
    Simplex simplex;
    for (const Id r : cell) simplex.push_back(by_rank[r]);
    std::sort(simplex.begin(), simplex.end());
    return simplex;
  };
  for (const auto& [facet, cell] : all.pairs) {
    partner[simplex_of(facet)] = simplex_of(cell);
    partner[simplex_of(cell)] = simplex_of(facet);
  }
  for (const Cell& cell : all.critical) critical[cell.size() - 1].insert(simplex_of(cell));
}

const std::vector<BruteForceGradient>& brute_force_gradients(const std::string& mesh_name) {
  static std::map<std::string, std::vector<BruteForceGradient>> known;
  std::vector<BruteForceGradient>& gradients = known[mesh_name];
  if (gradients.empty()) {
    const InputMesh& input = mesh_named(mesh_name);
    for (const Field& field : fields_on(input)) gradients.emplace_back(input, field.values);
  }
  return gradients;
}

}  // namespace gale::test
