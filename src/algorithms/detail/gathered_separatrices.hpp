#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <gale/algorithms/separatrices.hpp>
#include <gale/base/parallel.hpp>

namespace gale::detail {

/// Brings the separatrices that several threads found into one order: that of their sources, or of `by_destination`'s destinations, then of the other end. Each thread
/// has found those with one such end together, in any order; no two have both ends alike.
template <class Cell>
Separatrices<Cell> gathered(std::vector<Separatrices<Cell>>& parts, bool by_destination) {
  struct Place {
    std::pair<Id, Id> ends;
    int part;
    Id at;
  };
  std::vector<Place> order;
  for (int part = 0; part < static_cast<int>(parts.size()); ++part) {
    const auto& found = parts[part];
    for (Id i = 0; i < found.count(); ++i) {
      const Id destination = found.destinations.empty() ? no_id : found.destinations[i];
      order.push_back({by_destination ? std::make_pair(destination, found.sources[i]) : std::make_pair(found.sources[i], destination), part, i});
    }
  }
  std::sort(order.begin(), order.end(), [](const Place& a, const Place& b) { return a.ends < b.ends; });
  Separatrices<Cell> all;
  for (const Place& place : order) {
    const auto& found = parts[place.part];
    all.sources.push_back(found.sources[place.at]);
    if (!found.destinations.empty()) all.destinations.push_back(found.destinations[place.at]);
    if (!found.is_only.empty()) all.is_only.push_back(found.is_only[place.at]);
    all.begin.push_back(all.begin.back() + (found.last(place.at) - found.first(place.at)));
  }
  all.cells.resize(all.begin.back());
  parallel_for("GALE::gather_separatrices", Kokkos::DefaultHostExecutionSpace(), static_cast<Offset>(order.size()), [&](Offset i) {
    const auto& found = parts[order[i].part];
    std::copy(found.first(order[i].at), found.last(order[i].at), all.cells.data() + all.begin[i]);
  });
  parts.clear();
  return all;
}

}  // namespace gale::detail
