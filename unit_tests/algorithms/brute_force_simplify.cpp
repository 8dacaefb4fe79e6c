#include "algorithms/brute_force_simplify.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace gale::test {

namespace {

/// A critical simplex: its dimension, and its place in the unsimplified complex. Compares as the rule wants it.
using Node = std::pair<int, Id>;
using Ends = std::pair<Node, Node>;  // the lower, the higher

struct Arc {
  Ends ends;
  bool is_only;
  std::vector<Simplex> cells;  // as the complex has them: falling from a 1-saddle to a minimum, otherwise rising
};

/// Leaves out what the path passes twice.
void append(std::vector<Simplex>& cells, const std::vector<Simplex>& more, bool backwards) {
  for (std::size_t i = 0; i < more.size(); ++i) {
    const Simplex& cell = more[backwards ? more.size() - 1 - i : i];
    cells.erase(std::find(cells.begin(), cells.end(), cell), cells.end());
    cells.push_back(cell);
  }
}

class Simplification {
 public:
  Simplification(const NamedComplex& complex, const std::vector<double>& field) : original_(complex), field_(field) {
    for (int d = 0; d < 4; ++d) {
      for (std::size_t i = 0; i < complex.critical[d].size(); ++i) {
        left_.insert({d, static_cast<Id>(i)});
        node_[complex.critical[d][i]] = {d, static_cast<Id>(i)};
      }
    }
    for (const auto* paths : {&complex.descending, &complex.connectors, &complex.ascending}) {
      for (const auto& path : *paths) {
        const Node a = node_.at(path.source), b = node_.at(path.destination);
        arcs_.push_back({{std::min(a, b), std::max(a, b)}, path.is_only, path.cells});
      }
    }
    for (const auto& wall : complex.descending_walls) add_wall(wall);
    for (const auto& wall : complex.ascending_walls) add_wall(wall);
    minimum_ = complex.descending_manifold;
    maximum_ = complex.ascending_manifold;
  }

  void cancel_below(double threshold) {
    Ends pair;
    while (find_least(threshold, pair)) {
      if (pair.first.first == 1 && new_paths(pair) > 1024) {
        refused_.insert(pair);
      } else {
        cancel(pair);
        cancelled_.push_back({name(pair.first), name(pair.second)});
      }
    }
  }

  NamedComplex result() const {
    NamedComplex result;
    for (const Node& node : left_) result.critical[node.first].push_back(name(node));
    for (const Arc& arc : arcs_) {
      const int dimension = arc.ends.first.first;
      const bool falls = dimension == 0;
      auto& paths = falls ? result.descending : dimension == 1 ? result.connectors : result.ascending;
      paths.push_back({name(falls ? arc.ends.second : arc.ends.first), name(falls ? arc.ends.first : arc.ends.second),
                       arc.cells, arc.is_only});
    }
    for (const auto& node_and_wall : walls_) {
      const Node& node = node_and_wall.first;
      if (left_.count(node) == 0) continue;
      auto& walls = node.first == 2 ? result.descending_walls : result.ascending_walls;
      walls.push_back({name(node), {}, {}});
      for (const auto& cell : node_and_wall.second) {
        walls.back().cells.push_back(cell.first);
        if (node.first == 1) walls.back().polygons.push_back(cell.second);
      }
    }
    result.descending_manifold = minimum_;
    result.ascending_manifold = maximum_;
    return with_sorted_paths(result);
  }

  const std::vector<std::pair<Simplex, Simplex>>& cancelled() const { return cancelled_; }

 private:
  using Cells = std::map<Simplex, std::vector<Simplex>>;  // and their polygons

  const Simplex& name(const Node& node) const { return original_.critical[node.first][node.second]; }

  void add_wall(const NamedComplex::Wall& wall) {
    Cells& cells = walls_[node_.at(wall.source)];
    for (std::size_t i = 0; i < wall.cells.size(); ++i) {
      auto polygon = wall.polygons.empty() ? std::vector<Simplex>() : wall.polygons[i];
      std::sort(polygon.begin(), polygon.end());
      cells[wall.cells[i]] = polygon;
    }
  }

  double value(const Node& node) const {
    double highest = field_[name(node)[0]];
    for (const Id v : name(node)) highest = std::max(highest, field_[v]);
    return highest;
  }

  bool find_least(double threshold, Ends& least) const {
    std::map<Ends, int> paths;
    for (const Arc& arc : arcs_) paths[arc.ends] += arc.is_only ? 1 : 2;
    bool found = false;
    double least_persistence = 0;
    for (const auto& [ends, count] : paths) {  // of equals the first stays
      const double low = value(ends.first), high = value(ends.second);
      const double persistence = low == high ? 0 : std::abs(high - low);
      if (count != 1 || refused_.count(ends) != 0 || !(persistence < threshold) ||
          (found && !(persistence < least_persistence)))
        continue;
      found = true;
      least = ends;
      least_persistence = persistence;
    }
    return found;
  }

  std::ptrdiff_t new_paths(const Ends& pair) const {
    const auto to_p =
        std::count_if(arcs_.begin(), arcs_.end(), [&](const Arc& arc) { return arc.ends.first == pair.first; });
    const auto from_q =
        std::count_if(arcs_.begin(), arcs_.end(), [&](const Arc& arc) { return arc.ends.second == pair.second; });
    return (to_p - 1) * (from_q - 1);
  }

  void cancel(const Ends& pair) {
    const auto [p, q] = pair;
    std::vector<Arc> rest, to_p, from_q;
    Arc between;
    for (Arc& arc : arcs_) {
      if (arc.ends == pair) {
        between = arc;
      } else if (arc.ends.first == p) {
        to_p.push_back(arc);
      } else if (arc.ends.second == q) {
        from_q.push_back(arc);
      } else if (arc.ends.second != p && arc.ends.first != q) {
        rest.push_back(arc);
      }
    }
    for (const Arc& upper : to_p) {
      for (const Arc& lower : from_q) {
        const bool falls = p.first == 0;
        Arc joint{{lower.ends.first, upper.ends.second}, upper.is_only && lower.is_only, {}};
        append(joint.cells, (falls ? upper : lower).cells, false);
        append(joint.cells, between.cells, true);
        append(joint.cells, (falls ? lower : upper).cells, false);
        rest.push_back(joint);
      }
    }
    if (p.first == 0) bequeath(minimum_, p, from_q.empty() ? Simplex() : name(from_q[0].ends.first));
    if (q.first == 3) bequeath(maximum_, q, to_p.empty() ? Simplex() : name(to_p[0].ends.second));
    if (p.first == 1) {
      for (const Arc& upper : to_p) walls_[upper.ends.second].insert(walls_[q].begin(), walls_[q].end());
      for (const Arc& lower : from_q) walls_[lower.ends.first].insert(walls_[p].begin(), walls_[p].end());
    }
    left_.erase(p);
    left_.erase(q);
    arcs_.swap(rest);
  }

  void bequeath(std::vector<Simplex>& manifold, const Node& from, const Simplex& to) const {
    std::replace(manifold.begin(), manifold.end(), name(from), to);
  }

  const NamedComplex& original_;
  const std::vector<double>& field_;
  std::map<Simplex, Node> node_;
  std::set<Node> left_;
  std::set<Ends> refused_;
  std::vector<std::pair<Simplex, Simplex>> cancelled_;
  std::vector<Arc> arcs_;
  std::map<Node, Cells> walls_;
  std::vector<Simplex> minimum_, maximum_;
};

}  // namespace

NamedComplex with_sorted_paths(NamedComplex complex) {
  std::map<Simplex, std::size_t> place;
  for (const auto& simplices : complex.critical) {
    for (std::size_t i = 0; i < simplices.size(); ++i) place[simplices[i]] = i;
  }
  for (auto* paths : {&complex.descending, &complex.connectors, &complex.ascending}) {
    const bool by_destination = paths == &complex.connectors;
    std::sort(paths->begin(), paths->end(), [&](const auto& a, const auto& b) {
      const auto key = [&](const auto& path) {
        const auto from = place.at(path.source), to = place.at(path.destination);
        return std::make_tuple(by_destination ? to : from, by_destination ? from : to, std::cref(path.cells),
                               path.is_only);
      };
      return key(a) < key(b);
    });
  }
  return complex;
}

NamedComplex brute_force_simplified(const NamedComplex& complex, const std::vector<double>& field, double threshold) {
  Simplification simplification(complex, field);
  simplification.cancel_below(threshold);
  return simplification.result();
}

std::vector<std::pair<Simplex, Simplex>> brute_force_cancellations(const NamedComplex& complex,
                                                                   const std::vector<double>& field, double threshold) {
  Simplification simplification(complex, field);
  simplification.cancel_below(threshold);
  return simplification.cancelled();
}

}  // namespace gale::test
