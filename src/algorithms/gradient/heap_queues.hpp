#pragma once

#include <array>
#include <functional>
#include <queue>
#include <vector>

namespace gale::detail {

/// The queues of `pair_cells` for stars of any size, whose cells are numbered in the order of their keys. One serves
/// one thread, and keeps its memory.
class HeapQueues {
 public:
  void add_edges() {
    for (int cell = 1; cell < static_cast<int>(facets_.size()); ++cell) {
      if (facets_[cell][0] < 0) deferred_.push(cell);
    }
  }
  void settle(int cell) { settled_[cell] = true; }
  void push(int cell);
  bool next(int& cell) { return take(ready_, cell); }
  bool next_deferred(int& cell) { return take(deferred_, cell); }
  void defer(int cell) { deferred_.push(cell); }
  int facet(int cell) const;

 protected:
  /// The facets of each cell that contain the vertex, -1 where there are fewer than three: those of edges contain
  /// nothing else, and aren't there.
  std::vector<std::array<int, 3>> facets_;

  /// When the facets are set: finds the cofacets, and empties the queues.
  void connect();

 private:
  using Queue = std::priority_queue<int, std::vector<int>, std::greater<int>>;

  bool take(Queue& from, int& cell);

  std::vector<int> cofacet_begin_;
  std::vector<int> cofacets_;
  std::vector<char> settled_;
  Queue ready_, deferred_;
};

}  // namespace gale::detail
