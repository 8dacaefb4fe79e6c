#include <gale/algorithms/persistence/cancel_extrema.hpp>

namespace gale::detail {

std::vector<Id> cancel_extrema(const std::vector<PersistencePair>& pairs, Id PersistencePair::*extremum,
                               Id PersistencePair::*saddle, const PathEnds& ends,
                               const std::vector<std::array<Id, 2>>& sides, std::size_t extrema, TurnedForest& forest) {
  // The outside comes after the extrema.
  const auto place = [&](Id end) { return end == no_id ? extrema : static_cast<std::size_t>(end); };
  std::vector<std::vector<Id>> saddles_at(extrema + 1);
  std::vector<char> stays(extrema + 1, 1);
  for (const PersistencePair& pair : pairs) {
    stays[pair.*extremum] = 0;
    for (const Id end : ends[pair.*saddle]) saddles_at[place(end)].push_back(pair.*saddle);
  }
  std::vector<Id> heirs(extrema + 1, no_id), reached;
  for (std::size_t i = 0; i <= extrema; ++i) {
    if (!stays[i]) continue;
    heirs[i] = i == extrema ? no_id : static_cast<Id>(i);
    reached.push_back(static_cast<Id>(i));
  }
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const auto at = static_cast<std::size_t>(reached[k]);
    for (const Id crossed : saddles_at[at]) {
      const int side = place(ends[crossed][0]) == at ? 1 : 0;
      const std::size_t next = place(ends[crossed][side]);
      if (stays[next]) continue;
      forest.turn(sides[crossed][side], sides[crossed][1 - side], crossed);
      stays[next] = 1;
      heirs[next] = heirs[at];
      reached.push_back(static_cast<Id>(next));
    }
  }
  heirs.pop_back();
  return heirs;
}

std::vector<std::array<Id, 2>> sides_of_edges(const CriticalSimplices& critical) { return critical.edges; }

std::vector<std::array<Id, 2>> sides_of_triangles(const CriticalSimplices& critical) {
  std::vector<std::array<Id, 2>> sides(critical.triangles.size(), {no_id, no_id});
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Id first = critical.star_begin[i], count = critical.star_begin[i + 1] - first;
    for (Id k = 0; k < count && k < 2; ++k) sides[i][k] = critical.star[first + k];
  }
  return sides;
}

}  // namespace gale::detail
