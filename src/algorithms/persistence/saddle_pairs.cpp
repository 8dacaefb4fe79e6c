#include <algorithm>
#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/persistence/pairs.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/threads.hpp>

namespace gale::detail {

namespace {

/// An edge by its vertices.
struct LowerEdge {
  Id high, low;

  friend bool operator==(const LowerEdge& a, const LowerEdge& b) { return a.high == b.high && a.low == b.low; }
};

/// A sum of edges over Z2 that falls along the gradient, star by star from the highest one: an edge that is paired with
/// a triangle is replaced by the triangle's other edges, one that is paired with a vertex vanishes. So critical edges
/// alone would be left; it stops at the highest of them. One serves one thread, for one chain after the other, and
/// keeps its memory.
class EdgeChain {
 public:
  explicit EdgeChain(const DiscreteGradient& gradient)
      : pairs_(gradient.store().pairs()),
        vertex_successor_(gradient.vertex_successors().data()),
        keys_(gradient.order().keys()) {}

  void clear() { heap_.clear(); }

  /// Adds an edge, whose ends may be in any order.
  void add(Id a, Id b) {
    const std::uint64_t key_a = keys_[a], key_b = keys_[b];
    heap_.push_back(key_a > key_b ? Entry{key_a, {a, b}} : Entry{key_b, {b, a}});
    std::push_heap(heap_.begin(), heap_.end());
  }

  /// Adds another sum, which has fallen.
  void add(const std::vector<LowerEdge>& edges) {
    for (const LowerEdge& edge : edges) {
      heap_.push_back({keys_[edge.high], edge});
      std::push_heap(heap_.begin(), heap_.end());
    }
  }

  /// Lets it fall until the highest of its edges is a critical one, which is set. False if nothing is left of it.
  bool fall(LowerEdge& highest) {
    while (!heap_.empty()) {
      stop_if_asked_at(++steps_);
      const Id high = take_star();
      cross_star(high);
      if (critical_.empty()) continue;
      for (const Id low : critical_) {
        heap_.push_back({keys_[high], {high, low}});
        std::push_heap(heap_.begin(), heap_.end());
      }
      highest = {high, *std::max_element(critical_.begin(), critical_.end(),
                                         [this](Id a, Id b) { return keys_[a] < keys_[b]; })};
      return true;
    }
    return false;
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
    return high;
  }

  /// Replaces the edges from `high` to `lows_` by critical ones, `critical_`, and by edges of lower stars.
  void cross_star(Id high) {
    critical_.clear();
    const EdgePairRow row = pairs_[high];
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
  const Id* vertex_successor_;
  const std::uint64_t* keys_;
  std::vector<Entry> heap_;
  std::vector<Id> lows_, critical_;
  std::int64_t steps_ = 0;
};

/// The rim of a 2-saddle, as far as it has fallen. Stays as it is once others may see it.
struct Column {
  Id rank;  ///< of the 2-saddle
  std::vector<LowerEdge> rim;
};

/// The column that has met each 1-saddle.
using Owners = std::vector<std::atomic<const Column*>>;

/// One thread's part.
class Reducer {
 public:
  Reducer(const DiscreteGradient& gradient, const CriticalPlaces& places, Owners& owners)
      : places_(places), owners_(owners), chain_(gradient) {}

  void reduce(Id rank, const std::array<Id, 3>& triangle) {
    chain_.clear();
    for (int i = 0; i < 3; ++i) chain_.add(triangle[i], triangle[(i + 1) % 3]);
    LowerEdge highest;
    const Column* column = nullptr;  // what is the chain now, if it is written down
    while (chain_.fall(highest)) {
      auto& owner = owners_[places_.of_edge(highest.high, highest.low)];
      const Column* other = owner.load(std::memory_order_acquire);
      if (other == nullptr || other->rank > rank) {
        if (column == nullptr) column = &(columns_.push_back({rank, chain_.edges()}), columns_.back());
        if (!owner.compare_exchange_strong(other, column, std::memory_order_acq_rel)) continue;
        if (other == nullptr) return;
        rank = other->rank;
      }
      chain_.add(other->rim);
      column = nullptr;
    }
  }

 private:
  const CriticalPlaces& places_;
  Owners& owners_;
  EdgeChain chain_;
  std::deque<Column> columns_;  ///< which others read until all are done
};

}  // namespace

std::vector<Id> pair_saddles(const DiscreteGradient& gradient, const CriticalPlaces& places,
                             const Filtration& filtration, const std::vector<Id>& columns, int threads) {
  const CriticalSimplices& critical = gradient.critical();
  Owners owners(critical.edges.size());
  std::vector<std::unique_ptr<Reducer>> reducers(threads);
  constexpr std::int64_t block = 64;
  const auto count = static_cast<std::int64_t>(columns.size());
  in_turns(threads, (count + block - 1) / block, [&](int thread, std::int64_t b) {
    auto& reducer = reducers[thread];
    if (!reducer) reducer = std::make_unique<Reducer>(gradient, places, owners);
    for (std::int64_t i = b * block; i < std::min((b + 1) * block, count); ++i)
      reducer->reduce(filtration.rank[2][columns[i]], critical.triangles[columns[i]]);
  });
  std::vector<Id> saddle_of(critical.edges.size(), no_id);
  for (std::size_t i = 0; i < saddle_of.size(); ++i) {
    const Column* const column = owners[i].load(std::memory_order_relaxed);
    if (column != nullptr) saddle_of[i] = filtration.by_rank[2][column->rank];
  }
  return saddle_of;
}

}  // namespace gale::detail
