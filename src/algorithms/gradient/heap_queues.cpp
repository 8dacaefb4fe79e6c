#include <gale/algorithms/gradient/heap_queues.hpp>

namespace gale::detail {

void HeapQueues::connect() {
  cofacet_begin_.assign(facets_.size() + 1, 0);
  for (const auto& facets : facets_) {
    for (const int facet : facets) {
      if (facet >= 0) ++cofacet_begin_[facet + 1];
    }
  }
  for (std::size_t cell = 0; cell < facets_.size(); ++cell) cofacet_begin_[cell + 1] += cofacet_begin_[cell];
  cofacets_.resize(cofacet_begin_.back());
  std::vector<int> next(cofacet_begin_.begin(), cofacet_begin_.end() - 1);
  for (std::size_t cell = 0; cell < facets_.size(); ++cell) {
    for (const int facet : facets_[cell]) {
      if (facet >= 0) cofacets_[next[facet]++] = static_cast<int>(cell);
    }
  }
  settled_.assign(facets_.size(), 0);
  ready_ = deferred_ = Queue();
}

void HeapQueues::push(int cell) {
  for (int i = cofacet_begin_[cell]; i < cofacet_begin_[cell + 1]; ++i) {
    const int cofacet = cofacets_[i];
    int open = 0;
    for (const int facet : facets_[cofacet]) open += facet >= 0 && !settled_[facet];
    if (open == 1 && !settled_[cofacet]) ready_.push(cofacet);
  }
}

int HeapQueues::facet(int cell) const {
  for (const int facet : facets_[cell]) {
    if (facet >= 0 && !settled_[facet]) return facet;
  }
  return -1;
}

bool HeapQueues::take(Queue& from, int& cell) {
  while (!from.empty()) {
    cell = from.top();
    from.pop();
    if (!settled_[cell]) return true;
  }
  return false;
}

}  // namespace gale::detail
