#include <algorithm>
#include <cmath>
#include <tuple>

#include <gale/algorithms/persistence/morse_graph.hpp>

namespace gale::detail {

namespace {

/// The difference of two values, which may be infinite.
double persistence_of(double low, double high) { return low == high ? 0 : std::abs(high - low); }

}  // namespace

bool MorseGraph::Pair::operator>(const Pair& other) const {
  return std::tie(persistence, low, high, arc) > std::tie(other.persistence, other.low, other.high, other.arc);
}

MorseGraph::MorseGraph(const MorseSmaleComplex& complex, const std::vector<double>& values, double threshold)
    : values_(values), threshold_(threshold) {
  const auto counts = complex.critical.counts();
  first_[0] = 0;
  for (int d = 0; d < 4; ++d) {
    first_[d + 1] = first_[d] + counts[d];
    dimension_.insert(dimension_.end(), counts[d], static_cast<signed char>(d));
  }
  is_alive_.assign(nodes(), 1);
  for (int node = 0; node < nodes(); ++node) heir_.push_back(node);
  up_.resize(nodes());
  down_.resize(nodes());
  joined_.resize(nodes());
  add(complex.descending, 1, 0);
  add(complex.connectors, 1, 2);
  add(complex.ascending, 2, 3);
}

template <class Cell>
void MorseGraph::add(const Separatrices<Cell>& separatrices, int from_dimension, int to_dimension) {
  for (Id i = 0; i < separatrices.count(); ++i) {
    Arc arc{node(from_dimension, separatrices.sources[i]), node(to_dimension, separatrices.destinations[i]), true};
    if (from_dimension > to_dimension) std::swap(arc.low, arc.high);
    if (!separatrices.is_only.empty()) arc.is_only = separatrices.is_only[i];
    arc.separatrix = i;
    add(arc);
  }
}

int MorseGraph::add(const Arc& arc) {
  const int number = static_cast<int>(arcs_.size());
  arcs_.push_back(arc);
  up_[arc.low].push_back(number);
  down_[arc.high].push_back(number);
  const double persistence = persistence_of(values_[arc.low], values_[arc.high]);
  if (persistence < threshold_) pairs_.push({persistence, arc.low, arc.high, number});
  return number;
}

void MorseGraph::cancel() {
  while (!pairs_.empty()) {
    const int arc = pairs_.top().arc;
    pairs_.pop();
    if (may_cancel(arc)) cancel(arc);
  }
}

/// The arcs that are alive and don't join the two nodes that `but` joins.
std::vector<int> MorseGraph::others(const std::vector<int>& arcs, int but) const {
  std::vector<int> others;
  for (const int arc : arcs) {
    if (arcs_[arc].is_alive && (arcs_[arc].low != arcs_[but].low || arcs_[arc].high != arcs_[but].high))
      others.push_back(arc);
  }
  return others;
}

bool MorseGraph::may_cancel(int arc) const {
  const Arc& pair = arcs_[arc];
  if (!pair.is_alive || !pair.is_only) return false;
  // Arcs between the two are in both lists: look through the shorter.
  const auto& shorter = up_[pair.low].size() < down_[pair.high].size() ? up_[pair.low] : down_[pair.high];
  const auto joins_both = [&](int other) {
    return arcs_[other].is_alive && arcs_[other].low == pair.low && arcs_[other].high == pair.high;
  };
  if (std::count_if(shorter.begin(), shorter.end(), joins_both) != 1) return false;
  return dimension(pair.low) != 1 ||
         others(up_[pair.low], arc).size() * others(down_[pair.high], arc).size() <= most_new_paths;
}

void MorseGraph::cancel(int arc) {
  const int low = arcs_[arc].low, high = arcs_[arc].high;
  const auto to_low = others(up_[low], arc), from_high = others(down_[high], arc);
  for (const int node : {low, high}) {
    is_alive_[node] = 0;
    for (const auto* list : {&up_[node], &down_[node]}) {
      for (const int dead : *list) arcs_[dead].is_alive = false;
    }
  }
  if (dimension(low) == 0) heir_[low] = from_high.empty() ? nowhere : arcs_[from_high.front()].low;
  if (dimension(high) == 3) heir_[high] = to_low.empty() ? nowhere : arcs_[to_low.front()].high;
  for (const int upper : to_low) {
    if (dimension(low) == 1) joined_[arcs_[upper].high].push_back(high);
    for (const int lower : from_high) {
      Arc joint{arcs_[lower].low, arcs_[upper].high, arcs_[lower].is_only && arcs_[upper].is_only};
      joint.start = dimension(low) == 0 ? upper : lower;
      joint.middle = arc;
      joint.end = dimension(low) == 0 ? lower : upper;
      add(joint);
    }
  }
  if (dimension(low) == 1) {
    for (const int lower : from_high) joined_[arcs_[lower].low].push_back(low);
  }
  for (auto* list : {&up_[low], &down_[low], &up_[high], &down_[high]}) std::vector<int>().swap(*list);
}

int MorseGraph::heir(int node) {
  while (node != nowhere && !is_alive_[node]) {
    const int next = heir_[node];
    if (next != nowhere && !is_alive_[next]) heir_[node] = heir_[next];
    node = next;
  }
  return node;
}

}  // namespace gale::detail
