#include <algorithm>

#include <gale/algorithms/gradient/edge_pairs.hpp>
#include <gale/base/kokkos.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

EdgePairs::EdgePairs(Id vertices, int consumers)
    : rows_(allocate<Array<EdgePairRow, HostMemory>>("GALE::edge_pair_rows", vertices)), pools_(consumers) {}

EdgePairs::EdgePairs(const Array<const Id, HostMemory>& words, const Array<const Offset, HostMemory>& begin,
                     int consumers)
    : made_elsewhere_(words), begin_(begin), pools_(consumers) {
  if (consumers == 0) return;
  const auto rows = allocate<Array<EdgePairRow, HostMemory>>("GALE::edge_pair_rows", begin.extent(0));
  parallel_for("GALE::edge_pair_rows", HostExecutionSpace(), begin.extent(0),
               [&](Offset v) { rows(v) = row(static_cast<Id>(v)); });
  rows_ = rows;
  begin_ = {};
}

EdgePairs::EdgePairs(const EdgePairs& some, Interval owned, Id vertices) : EdgePairs(vertices, 1) {
  static Id no_edges = 0;
  codes_ = some.codes_;
  coded_ = owned;
  parallel_for("GALE::edge_pair_rows", HostExecutionSpace(), vertices, [&](Offset v) {
    if (is_coded(static_cast<Id>(v))) return;
    rows_(v) = owned.has(static_cast<Id>(v)) ? some.row(static_cast<Id>(v)) : EdgePairRow(&no_edges);
  });
}

EdgePairRow EdgePairs::begin(int consumer, Id vertex, Id count) {
  // In words. Small meshes need little memory, large chunks get large pages.
  constexpr Offset least = Offset(1) << 16, most = Offset(1) << 23;
  Pool& pool = pools_[consumer];
  const Offset words = EdgePairRow::words_for(count);
  if (pool.end - pool.next < words) {
    const TrackedViews tracked;  // chunks outlive the sweep's body that asks for them
    const Offset twice = pool.chunks.empty() ? least : 2 * static_cast<Offset>(pool.chunks.back().extent(0));
    pool.chunks.push_back(allocate<Array<Id, HostMemory>>("GALE::edge_pairs", std::max(words, std::min(twice, most))));
    pool.next = pool.chunks.back().data();
    pool.end = pool.next + pool.chunks.back().extent(0);
  }
  EdgePairRow row(pool.next);
  pool.next += words;
  row.begin(count);
  return rows_(vertex) = row;
}

std::size_t EdgePairs::bytes() const {
  std::size_t words = made_elsewhere_.extent(0);
  for (const Pool& pool : pools_) {
    for (const auto& chunk : pool.chunks) words += chunk.extent(0);
  }
  return words * sizeof(Id) + rows_.extent(0) * sizeof(EdgePairRow) + (codes_ == nullptr ? 0 : codes_->bytes());
}

}  // namespace gale::detail
