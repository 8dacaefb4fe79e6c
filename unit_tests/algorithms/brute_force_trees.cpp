#include "algorithms/brute_force_trees.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <set>

namespace gale::test {

namespace {

using Table = BruteForce::Table;

/// All vertices by value, then by id; from the highest if it is turned around.
std::vector<Id> sorted_vertices(const std::vector<double>& values, bool from_highest) {
  std::vector<Id> sorted(values.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::stable_sort(sorted.begin(), sorted.end(), [&](Id a, Id b) { return values[a] < values[b]; });
  if (from_highest) std::reverse(sorted.begin(), sorted.end());
  return sorted;
}

/// For each vertex the one that comes next in the growing component that it is in; -1 for the last. Calls
/// `ended(younger, older, vertex)` where a vertex joins two components, each known by its first vertex.
std::vector<Id> next_of_all(
    const Table& neighbours, const std::vector<Id>& sorted,
    const std::function<void(Id, Id, Id)>& ended = [](Id, Id, Id) {}) {
  const std::size_t count = sorted.size();
  std::vector<Id> next(count, -1), set(count), newest(count), place(count);
  for (std::size_t i = 0; i < count; ++i) place[sorted[i]] = static_cast<Id>(i);
  std::iota(set.begin(), set.end(), 0);
  newest = set;
  const auto find = [&](Id v) {
    while (set[v] != v) v = set[v];
    return v;
  };
  for (const Id v : sorted) {
    for (const Id other : neighbours[v]) {
      if (place[other] > place[v]) continue;
      Id one = find(other), all = find(v);
      if (one == all) continue;
      next[newest[one]] = v;
      if (all != v && place[one] < place[all]) std::swap(one, all);  // `all` is older
      if (all != v && one != v) ended(one, all, v);
      set[all == v ? v : one] = all == v ? one : all;
      newest[find(v)] = v;
    }
  }
  return next;
}

using Edges = std::set<std::pair<Id, Id>>;  // places in the order

/// A tree of all vertices, by their places in the order.
Edges join_edges(const Table& neighbours, const std::vector<double>& values, bool from_highest) {
  const auto ascending = sorted_vertices(values, false);
  std::vector<Id> place(values.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[ascending[i]] = static_cast<Id>(i);
  const auto next = next_of_all(neighbours, sorted_vertices(values, from_highest));
  Edges edges;
  for (std::size_t v = 0; v < next.size(); ++v) {
    if (next[v] >= 0) edges.insert(std::minmax(place[v], place[next[v]]));
  }
  return edges;
}

struct Links {
  std::set<Id> lower, upper;
};

std::vector<Links> links_of(const Edges& edges, std::size_t count) {
  std::vector<Links> links(count);
  for (const auto& [low, high] : edges) {
    links[low].upper.insert(high);
    links[high].lower.insert(low);
  }
  return links;
}

/// Takes a vertex out of a tree; one that has one neighbour below and one above joins these.
void take_out(std::vector<Links>& links, Id v) {
  for (const Id low : links[v].lower) links[low].upper.erase(v);
  for (const Id high : links[v].upper) links[high].lower.erase(v);
  if (links[v].lower.size() == 1 && links[v].upper.size() == 1) {
    links[*links[v].lower.begin()].upper.insert(*links[v].upper.begin());
    links[*links[v].upper.begin()].lower.insert(*links[v].lower.begin());
  }
  links[v] = {};
}

Edges contour_edges(const Edges& join, const Edges& split, std::size_t count) {
  auto below = links_of(join, count), above = links_of(split, count);
  Edges edges;
  for (bool found = true; found;) {
    found = false;
    for (Id v = 0; v < static_cast<Id>(count); ++v) {
      if (below[v].lower.size() + above[v].upper.size() != 1) continue;
      found = true;
      const Id to = above[v].upper.empty() ? *above[v].lower.begin() : *below[v].upper.begin();
      edges.insert(std::minmax(v, to));
      take_out(below, v);
      take_out(above, v);
    }
  }
  return edges;
}

CriticalType type_of(const Links& links) {
  const std::size_t down = links.lower.size(), up = links.upper.size();
  if (down == 0 && up == 1) return CriticalType::minimum;
  if (down == 1 && up == 0) return CriticalType::maximum;
  if (down == 2 && up == 1) return CriticalType::saddle1;
  if (down == 1 && up == 2) return CriticalType::saddle2;
  return down == 1 && up == 1 ? CriticalType::regular : CriticalType::degenerate;
}

}  // namespace

MergeTree brute_force_tree(Tree kind, const Table& neighbours, const std::vector<double>& values) {
  const std::size_t count = values.size();
  const auto join = join_edges(neighbours, values, false), split = join_edges(neighbours, values, true);
  const Edges edges = kind == Tree::join ? join : kind == Tree::split ? split : contour_edges(join, split, count);
  const auto links = links_of(edges, count);
  const auto vertices = sorted_vertices(values, false);
  MergeTree tree;
  std::map<Id, Id> node;  // by place
  for (std::size_t i = 0; i < count; ++i) {
    if (type_of(links[i]) == CriticalType::regular) continue;
    node[static_cast<Id>(i)] = static_cast<Id>(tree.vertices.size());
    tree.vertices.push_back(vertices[i]);
    tree.types.push_back(type_of(links[i]));
  }
  tree.arc_of.resize(count, no_id);
  for (const auto& [low, number] : node) {
    std::map<Id, std::vector<Id>> arcs;  // what lies on each, by its upper node
    for (Id at : links[low].upper) {
      std::vector<Id> on;
      for (; node.count(at) == 0; at = *links[at].upper.begin()) on.push_back(at);
      arcs[node[at]] = on;
    }
    for (const auto& [upper, on] : arcs) {
      const auto arc = static_cast<Id>(tree.arcs.size());
      tree.arcs.push_back({number, upper, static_cast<Id>(on.size())});
      for (const Id at : on) tree.arc_of[vertices[at]] = arc;
      tree.arc_of[tree.vertices[number]] = tree.arc_of[tree.vertices[upper]] = arc;
    }
  }
  return tree;
}

std::vector<Id> brute_force_extrema(bool maxima, const Table& neighbours, const std::vector<double>& values) {
  std::vector<Id> extrema;
  for (Id v = 0; v < static_cast<Id>(values.size()); ++v) {
    if (std::all_of(neighbours[v].begin(), neighbours[v].end(),
                    [&](Id other) { return (std::pair(values[other], other) < std::pair(values[v], v)) == maxima; }))
      extrema.push_back(v);
  }
  return extrema;
}

std::vector<Id> brute_force_persistent(bool maxima, const Table& neighbours, const std::vector<double>& order,
                                       const std::vector<double>& values, double threshold) {
  const auto all = brute_force_extrema(maxima, neighbours, order);
  std::set<Id> left(all.begin(), all.end());
  next_of_all(neighbours, sorted_vertices(order, maxima), [&](Id younger, Id, Id end) {
    if (values[younger] == values[end] ? 0 < threshold : std::abs(values[younger] - values[end]) < threshold)
      left.erase(younger);
  });
  return {left.begin(), left.end()};
}

}  // namespace gale::test
