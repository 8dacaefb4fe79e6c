#pragma once

#include <string>

#include <gale/base/parallel.hpp>
#include <gale/base/require_ids.hpp>
#include <gale/base/sort_rows.hpp>
#include <gale/mesh/few_distinct.hpp>
#include <gale/mesh/found_rows.hpp>

namespace gale::detail {

/// Rows of distinct ids, all of them one after the other: row r is values[begin[r]] to values[begin[r + 1] - 1],
/// ascending.
template <class Memory>
struct DistinctRows {
  Array<Id, Memory> begin;
  Array<Id, Memory> values;
  Array<Id, Memory> row_of;  ///< of each value
};

/// The rows with more distinct candidates than a thread keeps by itself: theirs are written down, and sorted.
template <class Space, class Candidates>
class LargeRows {
 public:
  using Memory = MemoryOf<Space>;
  using Ids = Array<Id, Memory>;
  using Offsets = Array<Offset, Memory>;

  /// Takes the rows whose count is FewDistinct::too_many, and replaces it by the number of distinct candidates.
  LargeRows(const Space& space, const Ids& count, Id large, const Candidates& candidates)
      : space_(space),
        rows_(allocate<Ids>("GALE::large_rows", large)),
        begin_(allocate<Offsets>("GALE::large_begin", large + Offset(1))) {
    if (large == 0) return;
    find(count);
    values_ = allocate<Ids>("GALE::candidates", count_candidates(candidates));
    gather(candidates);
    sort_rows(space_, "GALE::sort_candidates", begin_, values_);
    write_counts(count);
  }

  /// Writes the distinct values of each where its row begins.
  void write(const DistinctRows<Memory>& to) const {
    const auto rows = rows_;
    const auto begin = begin_;
    const auto values = values_;
    parallel_for(
        "GALE::write_large_rows", space_, rows_.extent(0), KOKKOS_LAMBDA(Offset i) {
          Id at = to.begin(rows(i));
          for (Offset j = begin(i); j < begin(i + 1); ++j) {
            if (j > begin(i) && values(j) == values(j - 1)) continue;
            to.values(at) = values(j);
            to.row_of(at++) = rows(i);
          }
        });
  }

  // The steps of construction; nvcc wants them public, as their lambdas are kernels.

  void find(const Ids& count) {
    const auto place = allocate<Ids>("GALE::large_place", count.extent(0) + 1);
    const auto rows = rows_;
    exclusive_scan(
        "GALE::find_large_rows", space_, count.extent(0), place,
        KOKKOS_LAMBDA(Offset row) { return count(row) == FewDistinct::too_many ? 1 : 0; });
    parallel_for(
        "GALE::list_large_rows", space_, count.extent(0), KOKKOS_LAMBDA(Offset row) {
          if (place(row + 1) > place(row)) rows(place(row)) = static_cast<Id>(row);
        });
  }

  Offset count_candidates(const Candidates& candidates) {
    const auto rows = rows_;
    return exclusive_scan(
        "GALE::count_candidates", space_, rows.extent(0), begin_, KOKKOS_LAMBDA(Offset i) {
          Offset entries = 0;
          candidates(rows(i), [&](Id) { ++entries; });
          return entries;
        });
  }

  void gather(const Candidates& candidates) {
    const auto rows = rows_;
    const auto begin = begin_;
    const auto values = values_;
    parallel_for(
        "GALE::gather_candidates", space_, rows.extent(0), KOKKOS_LAMBDA(Offset i) {
          Offset at = begin(i);
          candidates(rows(i), [&](Id value) { values(at++) = value; });
        });
  }

  void write_counts(const Ids& count) {
    const auto rows = rows_;
    const auto begin = begin_;
    const auto values = values_;
    parallel_for(
        "GALE::count_large_rows", space_, rows.extent(0), KOKKOS_LAMBDA(Offset i) {
          Id distinct = 0;
          for (Offset j = begin(i); j < begin(i + 1); ++j)
            distinct += j == begin(i) || values(j) != values(j - 1) ? 1 : 0;
          count(rows(i)) = distinct;
        });
  }

 private:
  Space space_;
  Ids rows_;
  Offsets begin_;
  Ids values_;
};

/// Counts each row's distinct candidates; FewDistinct::too_many where they are more than a thread keeps by itself.
template <class Space, class Candidates>
void count_distinct(const Space& space, const Candidates& candidates, const Array<Id, MemoryOf<Space>>& count) {
  parallel_for(
      "GALE::count_distinct", space, count.extent(0), KOKKOS_LAMBDA(Offset row) {
        FewDistinct few;
        candidates(static_cast<Id>(row), [&](Id id) { few.insert(id); });
        count(row) = few.size();
      });
}

/// Writes those of the rows that count_distinct has counted.
template <class Space, class Candidates>
void write_distinct(const Space& space, const Candidates& candidates, const DistinctRows<MemoryOf<Space>>& to) {
  parallel_for(
      "GALE::write_distinct", space, to.begin.extent(0) - 1, KOKKOS_LAMBDA(Offset row) {
        FewDistinct few;
        candidates(static_cast<Id>(row), [&](Id id) { few.insert(id); });
        const Id begin = to.begin(row);
        for (Id i = 0; i < few.size(); ++i) {
          to.values(begin + i) = few[i];
          to.row_of(begin + i) = static_cast<Id>(row);
        }
      });
}

/// For each of `rows` rows the distinct ones of its candidates, ascending. `candidates(row, visit)` calls visit(id) for
/// each, in any order and any number of times. Throws gale::Error if there are more than 2^31 - 1 of them, which it
/// calls `what`. On a device the last steps are enqueued on the instance.
template <class Space, class Candidates>
DistinctRows<MemoryOf<Space>> distinct_rows(const Space& space, const std::string& what, Offset rows,
                                            const Candidates& candidates) {
  using Ids = Array<Id, MemoryOf<Space>>;
  const Ids count = allocate<Ids>("GALE::distinct_count", rows);
  [[maybe_unused]] FoundRows found;
  if constexpr (is_device<Space>) {
    count_distinct(space, candidates, count);
  } else {
    found.count(candidates, count);
  }
  const auto large = static_cast<Id>(reduce_sum(
      "GALE::count_large", space, rows,
      KOKKOS_LAMBDA(Offset row) { return count(row) == FewDistinct::too_many ? 1 : 0; }));
  const LargeRows<Space, Candidates> large_rows(space, count, large, candidates);
  const Offset total = reduce_sum(
      "GALE::total_distinct", space, rows, KOKKOS_LAMBDA(Offset row) { return Offset(count(row)); });
  require_ids(what.c_str(), total);
  const DistinctRows<MemoryOf<Space>> result{allocate<Ids>("GALE::distinct_begin", rows + 1),
                                             allocate<Ids>("GALE::distinct", total),
                                             allocate<Ids>("GALE::distinct_row", total)};
  exclusive_scan(
      "GALE::scan_distinct", space, rows, result.begin, KOKKOS_LAMBDA(Offset row) { return count(row); });
  if constexpr (!is_device<Space>) {
    if (large == 0) {
      found.write(result.begin, result.values, result.row_of);
      return result;
    }
  }
  write_distinct(space, candidates, result);
  large_rows.write(result);
  return result;
}

}  // namespace gale::detail
