#pragma once

#include <algorithm>
#include <vector>

#include <gale/algorithms/separatrices.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

/// Brings the separatrices that several threads found into the order of their `ends`, which are their sources or their
/// destinations: places below `count`. One thread found all those with the same end, one after the other: they stay in
/// their order.
template <class Cell>
Separatrices<Cell> gathered(std::vector<Separatrices<Cell>>& parts, std::vector<Id> Separatrices<Cell>::*ends,
                            Id count) {
  struct Group {
    int part = 0;
    Id first = 0, size = 0;
  };
  std::vector<Group> groups(count);
  for (int part = 0; part < static_cast<int>(parts.size()); ++part) {
    for (Id i = 0; i < parts[part].count(); ++i) {
      Group& group = groups[(parts[part].*ends)[i]];
      if (group.size++ == 0) group = {part, i, 1};
    }
  }
  Separatrices<Cell> all;
  std::vector<Id> place(count + 1, 0);
  std::vector<Offset> cell(count + 1, 0);
  for (Id g = 0; g < count; ++g) {
    const Group& group = groups[g];
    place[g + 1] = place[g] + group.size;
    cell[g + 1] = cell[g] + (group.size == 0 ? 0
                                             : parts[group.part].last(group.first + group.size - 1) -
                                                   parts[group.part].first(group.first));
  }
  const bool are_paths =
      std::any_of(parts.begin(), parts.end(), [](const auto& part) { return !part.destinations.empty(); });
  const bool say_only = std::any_of(parts.begin(), parts.end(), [](const auto& part) { return !part.is_only.empty(); });
  const bool are_joined = std::any_of(parts.begin(), parts.end(), [](const auto& part) { return !part.joins.empty(); });
  all.sources.resize(place[count]);
  if (are_paths) all.destinations.resize(place[count]);
  if (say_only) all.is_only.resize(place[count]);
  if (are_joined) all.joins.resize(place[count]);
  all.begin.resize(place[count] + 1);
  all.cells.resize(cell[count]);
  parallel_for("GALE::gather_separatrices", Kokkos::DefaultHostExecutionSpace(), count, [&](Offset g) {
    const Group& group = groups[g];
    const auto& from = parts[group.part];
    if (group.size == 0) return;
    for (Id i = 0; i < group.size; ++i) {
      const Id at = place[g] + i;
      all.sources[at] = from.sources[group.first + i];
      if (are_paths) all.destinations[at] = from.destinations[group.first + i];
      if (say_only) all.is_only[at] = from.is_only[group.first + i];
      if (are_joined) all.joins[at] = from.joins[group.first + i];
      all.begin[at + 1] = cell[g] + (from.last(group.first + i) - from.first(group.first));
    }
    std::copy(from.first(group.first), from.last(group.first + group.size - 1), all.cells.data() + cell[g]);
  });
  parts.clear();
  return all;
}

}  // namespace gale::detail
