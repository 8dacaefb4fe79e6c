#include <string>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/sort.hpp>
#include <gale/distributed/mesh_part.hpp>
#include <gale/distributed/sharing/cell_places.hpp>

namespace gale::detail {

namespace {

/// The least id that occurs more than once.
GlobalId repeated(const GlobalIds& ids) {
  std::vector<GlobalId> sorted(ids.data(), ids.data() + ids.extent(0));
  std::sort(sorted.begin(), sorted.end());
  return *std::adjacent_find(sorted.begin(), sorted.end());
}

[[noreturn]] void refuse_repeated(GlobalId id) { throw Error("cell " + std::to_string(id) + " is handed over twice"); }

}  // namespace

CellPlaces::CellPlaces(const KeptCells& kept, const GlobalIds& received) : kept_(kept), received_(received) {
  const bool ascend = kept.ids.extent(0) == 0;
  const Offset descents = ascend ? 0
                                 : reduce_sum("GALE::count_descents", HostExecutionSpace(), kept.count,
                                              [&](Offset k) { return Offset(k > 0 && kept.id(k) <= kept.id(k - 1)); });
  descents > 0 ? sort() : merge();
}

void CellPlaces::merge() {
  const Offset received = received_.extent(0);
  const auto is_descent = [&](Offset r) { return Offset(r > 0 && received_(r) < received_(r - 1)); };
  if (reduce_sum("GALE::count_descents", HostExecutionSpace(), received, is_descent) > 0) {
    received_by_id_ = iota("GALE::received_by_id", HostExecutionSpace(), received);
    parallel_sort("GALE::sort_received", received_by_id_.data(), received_by_id_.data() + received,
                  [&](Id a, Id b) { return received_(a) < received_(b); });
  }
  received_at_ = allocate<Array<Id, HostMemory>>("GALE::received_at", received);
  const auto id = [&](Offset r) { return received_(received_by_id(r)); };
  for_parts("GALE::merge_received", received, threads_for(received), [&](int, Offset first, Offset last) {
    Offset before = 0;  // how many of those that are kept come before the one at hand
    for (Offset r = first; r < last; ++r) {
      before = gallop(before, kept_.count, [&](Offset k) { return kept_.id(k) < id(r); });
      received_at_(r) = static_cast<Id>(before + r);
    }
  });
  const auto is_repeated = [&](Offset r) {
    const Offset before = received_at_(r) - r;
    return (before < kept_.count && kept_.id(before) == id(r)) || (r > 0 && id(r - 1) == id(r));
  };
  const Offset bad = reduce_min("GALE::repeated_cell", HostExecutionSpace(), received, received,
                                [&](Offset r) { return is_repeated(r) ? r : received; });
  if (bad < received) refuse_repeated(id(bad));
}

void CellPlaces::sort() {
  const GlobalIds ids = tabulated<GlobalId>(
      "GALE::cell_ids", count(), [&](Offset i) { return i < kept_.count ? kept_.id(i) : received_(i - kept_.count); });
  const DistinctIds sorted = distinct_ids(ids);
  if (static_cast<Offset>(sorted.ids.extent(0)) < count()) refuse_repeated(repeated(ids));
  sorted_ = sorted.ids;
  sources_ = sorted.places;
}

std::vector<CellRun> CellPlaces::runs() const {
  return concatenated(of_parts("GALE::cell_runs", count(), [&](Offset first, Offset last) {
    std::vector<CellRun> mine;
    visit(
        first, last,
        [&](Offset i, Offset place, Offset count) {
          mine.push_back({static_cast<Id>(i), static_cast<Id>(place), static_cast<Id>(count)});
        },
        [](Offset, Offset) {});
    return mine;
  }));
}

GlobalId CellPlaces::id(Offset i) const {
  if (sources_.extent(0) != 0) return sorted_(i);
  const Offset before = received_before(i);
  const bool is_received = before < static_cast<Offset>(received_at_.extent(0)) && received_at_(before) == i;
  return is_received ? received_(received_by_id(before)) : kept_.id(i - before);
}

GlobalIds CellPlaces::ids() const {
  if (sources_.extent(0) != 0) return sorted_;
  const auto ids = allocate<GlobalIds>("GALE::cell_ids", count());
  for_parts("GALE::cell_ids", count(), threads_for(count()), [&](int, Offset first, Offset last) {
    visit(
        first, last,
        [&](Offset i, Offset place, Offset count) {
          for (Offset k = 0; k < count; ++k) ids(i + k) = kept_.id_at(place + k);
        },
        [&](Offset i, Offset r) { ids(i) = received_(r); });
  });
  return ids;
}

}  // namespace gale::detail
