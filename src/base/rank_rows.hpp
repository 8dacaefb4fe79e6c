#pragma once

#include <utility>

#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>

// Short rows put in order by the teams of a device.

namespace gale::detail {

/// A team's work: puts the entries of `rows_of_team` consecutive rows in order, equal ones as they stood. Each entry
/// goes where as many others of its row stand as come before it, which takes time quadratic in the row's length, but
/// all of them at once. A row of more than `capacity` entries is sorted by one thread.
///
/// `Entries` has load(i), the i-th entry of all rows, which are ordered by <, and store(i, entry).
template <class Index, class Entries>
struct RankRows {
  using Entry = decltype(std::declval<const Entries&>().load(Offset()));
  static constexpr int scratch_level = 0;

  Entries entries;
  const Index* begin;  ///< where each row begins, and the end of the last
  Offset rows;
  int rows_of_team;
  int capacity;  ///< entries that a team's scratch memory has room for

  KOKKOS_FUNCTION std::size_t scratch_bytes() const { return static_cast<std::size_t>(capacity) * sizeof(Entry); }

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    auto* const scratch = reinterpret_cast<Entry*>(team::scratch<scratch_level>(team, scratch_bytes()));
    const Offset first = static_cast<Offset>(team.league_rank()) * rows_of_team,
                 last = first + rows_of_team < rows ? first + rows_of_team : rows;
    if (begin[last] - begin[first] <= capacity) return rank(team, scratch, first, last);
    for (Offset row = first; row < last; ++row) {
      const Offset from = begin[row], count = begin[row + 1] - from;
      if (count <= capacity) {
        team::barrier(team);  // for what others still read of the row before
        rank(team, scratch, row, row + 1);
      } else {
        team::once(team, [&] {
          heap_sort(
              static_cast<Id>(count), [&](Id i) { return entries.load(from + i); },
              [&](Id i, const Entry& entry) { entries.store(from + i, entry); });
        });
      }
    }
  }

 private:
  template <class Team>
  KOKKOS_FUNCTION void rank(const Team& team, Entry* scratch, Offset first, Offset last) const {
    const Offset from = begin[first];
    team::for_all(team, static_cast<int>(begin[last] - from), [&](int i) { scratch[i] = entries.load(from + i); });
    team::barrier(team);
    team::for_all(team, static_cast<int>(begin[last] - from), [&](int i) {
      const Offset row = bisect(first + 1, last, [&](Offset r) { return begin[r] - from <= i; }) - 1;
      const auto row_begin = static_cast<int>(begin[row] - from), row_end = static_cast<int>(begin[row + 1] - from);
      const Entry entry = scratch[i];
      int place = row_begin;
      for (int j = row_begin; j < row_end; ++j) place += scratch[j] < entry || (j < i && !(entry < scratch[j])) ? 1 : 0;
      entries.store(from + place, entry);
    });
  }
};

/// Has teams put all rows in order, so many rows a team. Enqueued on the instance of a device, as loops are.
template <class Space, class Index, class Entries>
void rank_rows(const char* label, const Space& space, const RankRows<Index, Entries>& kernel) {
  constexpr int warps = 4;
  for_teams(label, space, (kernel.rows + kernel.rows_of_team - 1) / kernel.rows_of_team, warps, kernel.rows, kernel);
}

}  // namespace gale::detail
