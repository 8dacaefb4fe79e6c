#include <numeric>
#include <string>

#include <gale/base/error.hpp>
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
  received_by_id_.resize(received);
  received_at_.resize(received);
  std::iota(received_by_id_.begin(), received_by_id_.end(), Id(0));
  const auto is_less = [&](Id a, Id b) { return received_(a) < received_(b); };
  if (!std::is_sorted(received_by_id_.begin(), received_by_id_.end(), is_less))
    parallel_sort("GALE::sort_received", received_by_id_.begin(), received_by_id_.end(), is_less);
  Offset before = 0;
  for (Offset r = 0; r < received; ++r) {
    const GlobalId id = received_(received_by_id_[r]);
    Offset end = before;  // the first kept one that isn't below it is mostly near
    for (Offset step = 1; end < kept_.count && kept_.id(end) < id; step *= 2) {
      before = end + 1;
      end = std::min(before + step, kept_.count);
    }
    while (before < end) {
      const Offset middle = before + (end - before) / 2;
      const bool is_below = kept_.id(middle) < id;
      before = is_below ? middle + 1 : before;
      end = is_below ? end : middle;
    }
    const bool is_kept = before < kept_.count && kept_.id(before) == id;
    if (is_kept || (r > 0 && received_(received_by_id_[r - 1]) == id)) refuse_repeated(id);
    received_at_[r] = before + r;
  }
}

void CellPlaces::sort() {
  const GlobalIds ids = tabulated<GlobalId>(
      "GALE::cell_ids", count(), [&](Offset i) { return i < kept_.count ? kept_.id(i) : received_(i - kept_.count); });
  const DistinctIds sorted = distinct_ids(ids);
  if (static_cast<Offset>(sorted.ids.extent(0)) < count()) refuse_repeated(repeated(ids));
  sorted_ = sorted.ids;
  sources_ = sorted.places;
}

GlobalId CellPlaces::id(Offset i) const {
  if (sources_.extent(0) != 0) return sorted_(i);
  const auto next = std::lower_bound(received_at_.begin(), received_at_.end(), i);
  const Offset before = next - received_at_.begin();
  return next != received_at_.end() && *next == i ? received_(received_by_id_[before]) : kept_.id(i - before);
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
