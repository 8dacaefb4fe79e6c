#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <vector>

#include <gale/algorithms/persistence/edge_chain.hpp>
#include <gale/algorithms/persistence/pairs.hpp>

namespace gale::detail {

/// The rim of a 2-saddle, as far as it has fallen. Stays as it is once others may see it.
struct Column {
  Id rank;  ///< of the 2-saddle, in the filtration
  std::vector<LowerEdge> rim;
};

/// Elimination by columns. Each 2-saddle's rim falls until its highest edge is a 1-saddle (EdgeChain). If an earlier
/// 2-saddle has met that one, its rim is added, and both fall on; if a later one has, that one goes on instead, with
/// both rims (Morozov, Nigmetov, "Towards lockfree persistent homology", 2020). So threads needn't wait for each other,
/// and the pairs are the same whatever their number.
class SaddleColumns {
 public:
  /// Eliminates those of the 2-saddles `columns`. In one rank's part of a mesh some end where another rank has to
  /// follow them.
  SaddleColumns(const DiscreteGradient& gradient, const CriticalPlaces& places, const Filtration& filtration,
                const std::vector<Id>& columns, int threads);

  ~SaddleColumns();

  /// How many 1-saddles there are.
  std::size_t saddles() const { return owners_.size(); }

  /// The column that has met a 1-saddle, by its place; nullptr if none has.
  const Column* owner(Id saddle) const { return owners_[saddle].load(std::memory_order_relaxed); }

  /// Calls visit(saddle, column) for each 1-saddle that a column has met.
  template <class Visit>
  void for_each_met(const Visit& visit) const {
    constexpr std::size_t ahead = 16;
    for (std::size_t i = 0; i < owners_.size(); ++i) {
      if (i + ahead < owners_.size()) __builtin_prefetch(owner(static_cast<Id>(i + ahead)));
      const Column* const column = owner(static_cast<Id>(i));
      if (column != nullptr) visit(static_cast<Id>(i), *column);
    }
  }

  /// The columns that ended at an edge of another rank.
  const std::vector<Column>& stopped() const { return stopped_; }

 private:
  class Reducer;

  std::vector<std::atomic<const Column*>> owners_;
  std::vector<std::unique_ptr<Reducer>> reducers_;  ///< one for each thread; they have the columns
  std::vector<Column> stopped_;
};

}  // namespace gale::detail
