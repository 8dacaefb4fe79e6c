#include <utility>

#include <gale/algorithms/excerpt/wider_ground.hpp>
#include <gale/base/sort.hpp>

namespace gale::detail {

WiderGround::WiderGround(const WiderGradient& wider)
    : wider_(wider),
      keys_(*wider.simplices()),
      keys_here_(keys_),
      vertex_successors_(wider.vertex_successors()),
      pairs_(wider.part().store().pairs(), wider.part().mesh().owned_vertices(), wider.simplices()->vertices()) {
  fill_rows();
  vertex_successors_.sort();
}

WallGround WiderGround::ground() const {
  return {pairs_,
          vertex_successors_.beside(wider_.part().store().vertex_steps()),
          keys_here_.keys(),
          keys_here_.names(),
          {0, wider_.simplices()->vertices()}};
}

/// Others' vertices, ghosts among them, get rows of those edges that were told. One that is neither critical nor paired
/// with a triangle is paired with its higher end.
void WiderGround::fill_rows() {
  std::vector<std::uint64_t> in_rows, told;
  for (const auto& [high, low, third] : wider_.told_edges()) {
    told.push_back(pair_key(high, low));
    if (third >= 0) in_rows.push_back(pair_key(high, third));
  }
  in_rows.insert(in_rows.end(), told.begin(), told.end());
  sort_distinct("GALE::sort_reached", in_rows);
  parallel_sort("GALE::sort_reached", told.begin(), told.end());
  auto at = told.begin();
  for (const std::uint64_t edge : in_rows) {
    while (at != told.end() && *at < edge) ++at;
    if (at == told.end() || *at != edge) vertex_successors_.tell(pair_first(edge), pair_second(edge));
  }
  for (std::size_t first = 0; first < in_rows.size();) {
    const Id high = pair_first(in_rows[first]);
    std::size_t end = first;
    while (end < in_rows.size() && pair_first(in_rows[end]) == high) ++end;
    EdgePairRow row = pairs_.begin(0, high, static_cast<Id>(end - first));
    for (std::size_t i = first; i < end; ++i) row.set_id(static_cast<Id>(i - first), pair_second(in_rows[i]));
    first = end;
  }
  for (const auto& [high, low, third] : wider_.told_edges()) {
    if (third < 0) continue;
    EdgePairRow row = pairs_.row(high);
    row.pair(row.find(low), row.find(third));
  }
}

}  // namespace gale::detail
