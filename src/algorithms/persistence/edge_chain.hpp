#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/base/stop.hpp>

namespace gale::detail {

/// An edge by its vertices.
struct LowerEdge {
  Id high, low;

  friend bool operator==(const LowerEdge& a, const LowerEdge& b) { return a.high == b.high && a.low == b.low; }
};

/// A sum of edges over Z2 that falls along the gradient, star by star from the highest one: an edge that is paired with
/// a triangle is replaced by the triangle's other edges, one that is paired with a vertex vanishes. So critical edges
/// alone would be left; it stops at the highest of them. In one rank's part of a mesh it stops at edges whose higher
/// end another rank owns, too. One serves one thread, for one chain after the other, and keeps its memory.
class EdgeChain {
 public:
  explicit EdgeChain(const DiscreteGradient& gradient)
      : pairs_(gradient.store().pairs()),
        vertex_successor_(gradient.store().vertex_steps()),
        keys_(gradient.order().keys()),
        owned_(gradient.mesh().owned_vertices()) {}

  void clear() { heap_.clear(); }

  /// Adds an edge, whose ends may be in any order.
  void add(Id a, Id b) {
    const std::uint64_t key_a = keys_[a], key_b = keys_[b];
    put(key_a > key_b ? Entry{key_a, {a, b}} : Entry{key_b, {b, a}});
  }

  /// Adds another sum, of edges with their higher ends first.
  void add(const std::vector<LowerEdge>& edges) {
    for (const LowerEdge& edge : edges) put(edge.high, edge.low);
  }

  /// How a sum has fallen: nothing is left of it, its highest edge is critical, or another rank's to follow.
  enum class Fall { vanished, critical, elsewhere };

  /// Lets it fall until the highest of its edges is a critical one, which is set, or another rank's.
  Fall fall(LowerEdge& highest) {
    while (!heap_.empty()) {
      stop_if_asked_at(++steps_);
      const Id high = take_star();
      if (lows_.empty()) continue;
      if (!owned_.has(high)) {
        for (const Id low : lows_) put(high, low);
        return Fall::elsewhere;
      }
      cross_star(high);
      if (critical_.empty()) continue;
      for (const Id low : critical_) put(high, low);
      highest = {high, *std::max_element(critical_.begin(), critical_.end(),
                                         [this](Id a, Id b) { return keys_[a] < keys_[b]; })};
      return Fall::critical;
    }
    return Fall::vanished;
  }

  /// Lets it fall from so many stars, to critical edges and such as are another rank's to follow. Calls
  /// on_critical(high, low) and elsewhere(high, low) with each. Returns whether something is left to fall.
  template <class OnCritical, class Elsewhere>
  bool fall_from(int stars, const OnCritical& on_critical, const Elsewhere& elsewhere) {
    for (; stars > 0 && !heap_.empty(); --stars) {
      stop_if_asked_at(++steps_);
      const Id high = take_star();
      if (!owned_.has(high)) {
        for (const Id low : lows_) elsewhere(high, low);
        continue;
      }
      cross_star(high);
      for (const Id low : critical_) on_critical(high, low);
    }
    return !heap_.empty();
  }

  /// How many edges it has, each as often as it is there.
  std::size_t size() const { return heap_.size(); }

  /// Takes about half of it out, to fall as a sum of its own: edges whose higher ends lie together, all of each star;
  /// or all of it, where half is one star's.
  std::vector<LowerEdge> split() {
    std::vector<Id> highs;
    highs.reserve(heap_.size());
    for (const Entry& entry : heap_) highs.push_back(entry.edge.high);
    const auto middle = highs.begin() + static_cast<std::ptrdiff_t>(highs.size() / 2);
    std::nth_element(highs.begin(), middle, highs.end());
    const auto taken =
        std::partition(heap_.begin(), heap_.end(), [&](const Entry& entry) { return entry.edge.high < *middle; });
    std::vector<LowerEdge> part;
    part.reserve(static_cast<std::size_t>(heap_.end() - taken));
    for (auto entry = taken; entry != heap_.end(); ++entry) part.push_back(entry->edge);
    heap_.erase(taken, heap_.end());
    std::make_heap(heap_.begin(), heap_.end());
    return part;
  }

  /// Its edges, some of them perhaps an odd number of times: what `add` takes.
  std::vector<LowerEdge> edges() const {
    std::vector<LowerEdge> all;
    all.reserve(heap_.size());
    for (const Entry& entry : heap_) all.push_back(entry.edge);
    return all;
  }

 private:
  struct Entry {
    std::uint64_t key;  ///< of the edge's higher end
    LowerEdge edge;

    bool operator<(const Entry& other) const {
      return key < other.key || (key == other.key && edge.low < other.edge.low);
    }
  };

  void put(Id high, Id low) { put({keys_[high], {high, low}}); }

  void put(const Entry& entry) {
    pairs_.prefetch_place(entry.edge.high);
    heap_.push_back(entry);
    std::push_heap(heap_.begin(), heap_.end());
  }

  /// Takes out the edges with the highest of all vertices, and sets `lows_` to their other ends. Returns that vertex.
  Id take_star() {
    const Id high = heap_.front().edge.high;
    lows_.clear();
    while (!heap_.empty() && heap_.front().edge.high == high) {
      const Id low = heap_.front().edge.low;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
      toggle(lows_, low);
    }
    if (!heap_.empty()) prefetch(heap_.front().edge.high);
    return high;
  }

  /// Has what a star's crossing will read brought near.
  void prefetch(Id high) const {
    if (!owned_.has(high)) return;
    pairs_.prefetch(high);
    vertex_successor_.prefetch(high);
  }

  /// Replaces the edges from `high` to `lows_` by critical ones, `critical_`, and by edges of lower stars.
  void cross_star(Id high) {
    critical_.clear();
    const PairedEdges row = pairs_[high];
    for (Id low : lows_) {
      Id third;
      while ((third = row.third(row.find(low))) != no_id) {
        add(low, third);
        low = third;
      }
      if (low != vertex_successor_[high]) toggle(critical_, low);
    }
  }

  static void toggle(std::vector<Id>& ids, Id id) {
    const auto at = std::find(ids.begin(), ids.end(), id);
    if (at == ids.end()) {
      ids.push_back(id);
    } else {
      *at = ids.back();
      ids.pop_back();
    }
  }

  const EdgePairs& pairs_;
  const VertexSteps vertex_successor_;
  const std::uint64_t* keys_;
  const Interval owned_;
  std::vector<Entry> heap_;
  std::vector<Id> lows_, critical_;
  std::int64_t steps_ = 0;
};

}  // namespace gale::detail
