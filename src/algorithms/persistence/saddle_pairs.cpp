#include <atomic>
#include <deque>
#include <memory>

#include <gale/algorithms/persistence/edge_chain.hpp>
#include <gale/algorithms/persistence/saddle_pairs.hpp>
#include <gale/base/threads.hpp>

namespace gale::detail {

namespace {

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
