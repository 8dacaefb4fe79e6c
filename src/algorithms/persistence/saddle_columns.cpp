#include <algorithm>

#include <gale/algorithms/persistence/saddle_columns.hpp>
#include <gale/base/threads.hpp>

namespace gale::detail {

/// One thread's part.
class SaddleColumns::Reducer {
 public:
  Reducer(const EdgeChain& empty, const CriticalPlaces& places, SaddleColumns& all)
      : places_(places), owners_(all.owners_), chain_(empty) {}

  void reduce(Id rank, const std::array<Id, 3>& triangle) {
    chain_.clear();
    for (int i = 0; i < 3; ++i) chain_.add(triangle[i], triangle[(i + 1) % 3]);
    LowerEdge highest;
    const Column* column = nullptr;  // what is the chain now, if it is written down
    for (;;) {
      const EdgeChain::Fall fallen = chain_.fall(highest);
      if (fallen == EdgeChain::Fall::vanished) return;
      if (fallen == EdgeChain::Fall::elsewhere) {
        stopped.push_back({rank, chain_.edges()});
        return;
      }
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

  std::vector<Column> stopped;

 private:
  const CriticalPlaces& places_;
  std::vector<std::atomic<const Column*>>& owners_;
  EdgeChain chain_;
  std::deque<Column> columns_;  ///< which others read until all are done
};

SaddleColumns::SaddleColumns(const DiscreteGradient& gradient, const CriticalPlaces& places,
                             const Filtration& filtration, const std::vector<Id>& columns, int threads)
    : owners_(gradient.critical().edges.size()), reducers_(threads) {
  if (columns.empty()) return;
  const EdgeChain empty(gradient);  // brings the gradient to the host, on all threads
  const auto& triangles = gradient.critical().triangles;
  constexpr std::int64_t block = 64;
  const auto count = static_cast<std::int64_t>(columns.size());
  in_turns(threads, (count + block - 1) / block, [&](int thread, std::int64_t b) {
    auto& reducer = reducers_[thread];
    if (!reducer) reducer = std::make_unique<Reducer>(empty, places, *this);
    for (std::int64_t i = b * block; i < std::min((b + 1) * block, count); ++i)
      reducer->reduce(filtration.rank[2][columns[i]], triangles[columns[i]]);
  });
  for (const auto& reducer : reducers_) {
    if (reducer) stopped_.insert(stopped_.end(), reducer->stopped.begin(), reducer->stopped.end());
  }
}

SaddleColumns::~SaddleColumns() = default;

}  // namespace gale::detail
