#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include <gale/distributed/sharing/id_interval.hpp>
#include <gale/distributed/sharing/local_vertices.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>

namespace gale::detail {

/// The ghosts of a rank that has whole layers of a grid, as all have: the `layer` vertices before those that it owns,
/// and the `layer` after them, as far as there are any. Each rank knows by itself whose they are, and who has its own.
struct LayerGhosts {
  Array<int, HostMemory> owners;  ///< by ghost
  ExchangePlan from_owners;       ///< a rank's own values are a run

  LayerGhosts(int here, const GivenIntervals& owned, const LocalVertices& held, Offset layer)
      : owners(allocate<Array<int, HostMemory>>("GALE::ghost_owners", held.ghost_count())) {
    const IdInterval& own = owned.of(here);
    const auto ghosts_of = [&](int rank) -> std::array<IdInterval, 2> {
      const auto [begin, end] = owned.of(rank);
      if (begin >= end) return {};
      return {{{begin - layer, begin}, {end, end + layer}}};
    };
    std::vector<Interval> given(owned.ranks()), taken(owned.ranks());
    for (int rank = 0; rank < owned.ranks(); ++rank) {
      for (const IdInterval& ghosts : ghosts_of(here)) {
        const IdInterval some = ghosts.common(owned.of(rank));
        if (some.is_empty()) continue;
        const Id first = held.find(some.begin);
        taken[rank] = {first, static_cast<Id>(first + (some.end - some.begin))};
        std::fill_n(&owners(held.ghost_number(first)), taken[rank].size(), rank);
      }
      for (const IdInterval& ghosts : ghosts_of(rank)) {
        const IdInterval some = ghosts.common(own);
        if (!some.is_empty())
          given[rank] = {static_cast<Id>(some.begin - own.begin), static_cast<Id>(some.end - own.begin)};
      }
    }
    ExchangePlan::Run run;
    if (!own.is_empty()) run = {held.owned(0), 0, held.owned_count()};
    from_owners = ExchangePlan::of_intervals(run, given, taken);
  }
};

}  // namespace gale::detail
