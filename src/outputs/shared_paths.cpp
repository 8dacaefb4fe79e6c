#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <gale/base/atomic.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/outputs/shared_paths.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs::detail {

namespace {

using Ids = Array<Id, HostMemory>;

constexpr Offset ahead = 16;  ///< how many cells ahead loops prefetch

/// Neighbours in space have ids that are near, and so are their slots.
std::uint64_t hash_of(Id cell) { return static_cast<std::uint64_t>(cell); }
std::uint64_t hash_of(const TriangleVertices& triangle) {
  return 4 * std::uint64_t(triangle[0]) + 5 * std::uint64_t(triangle[1]) + 7 * std::uint64_t(triangle[2]);
}

bool are_same(Id one, Id other) { return one == other; }
bool are_same(const TriangleVertices& one, const TriangleVertices& other) {  // faster than to call memcmp
  return ((one[0] ^ other[0]) | (one[1] ^ other[1]) | (one[2] ^ other[2])) == 0;
}

/// Whether the simplex between a cell and one that follows it is also between the cell and another that does: on the
/// way up from an edge, many triangles follow one over the same edge.
bool is_between_both(Id, Id one, Id other) { return one == other; }
bool is_between_both(const TriangleVertices& cell, const TriangleVertices& one, const TriangleVertices& other) {
  bool are_alike = true;
  for (const Id vertex : cell) are_alike &= detail::has(one, vertex) == detail::has(other, vertex);
  return are_alike;
}

/// For each cell the first place of one that equals it.
template <class Cell>
Ids first_places(const std::vector<Cell>& cells) {
  constexpr Id none = std::numeric_limits<Id>::max();
  const auto count = static_cast<Offset>(cells.size());
  std::uint64_t size = 1024;
  while (size < cells.size() + cells.size() / 4) size *= 2;
  const auto slots = allocate<Ids>("GALE::slots_of_cells", static_cast<Offset>(size));
  parallel_for("GALE::clear_slots", HostExecutionSpace(), slots.extent(0), [&](Offset slot) { slots(slot) = none; });
  const auto first = allocate<Ids>("GALE::first_places", count);  // its slot until all have one
  parallel_for("GALE::slots_of_cells", HostExecutionSpace(), count, [&](Offset k) {
    if (count - k > ahead) __builtin_prefetch(&slots(hash_of(cells[k + ahead]) & (size - 1)), 1);
    const auto here = static_cast<Id>(k);
    for (std::uint64_t slot = hash_of(cells[k]) & (size - 1);; slot = (slot + 1) & (size - 1)) {
      Id* const at = &slots(static_cast<Offset>(slot));
      Id there = atomic_read(at);
      while (there == none && !gale::detail::replaced(at, there, here)) {
      }
      if (there != none && !are_same(cells[there], cells[k])) continue;
      atomic_min(at, here);
      first(k) = static_cast<Id>(static_cast<std::uint32_t>(slot));
      return;
    }
  });
  parallel_for("GALE::first_places", HostExecutionSpace(), count,
               [&](Offset k) { first(k) = slots(static_cast<std::uint32_t>(first(k))); });
  return first;
}

/// Numbers the places whose `first` is the place itself, in their order, and the others as theirs: `first` becomes the
/// numbers. Returns the place by number.
Ids number(const Ids& first) {
  const auto count = static_cast<Offset>(first.extent(0));
  const int parts = gale::detail::threads_for(count);
  std::vector<Id> begin(parts + 1, 0);
  gale::detail::for_parts("GALE::count_first", count, parts, [&](int part, Offset k, Offset end) {
    Id here = 0;
    for (; k < end; ++k) {
      gale::detail::stop_if_asked_at(k);
      here += first(k) == k;
    }
    begin[part + 1] = here;
  });
  for (int part = 0; part < parts; ++part) begin[part + 1] += begin[part];
  const auto places = allocate<Ids>("GALE::first_with_number", begin[parts]);
  gale::detail::for_parts("GALE::number_first", count, parts, [&](int part, Offset k, Offset end) {
    for (Id next = begin[part]; k < end; ++k) {
      gale::detail::stop_if_asked_at(k);
      if (first(k) != k) continue;
      places(next) = static_cast<Id>(k);
      first(k) = ~next++;  // which is below 0, until the others have read it
    }
  });
  parallel_for("GALE::share_numbers", HostExecutionSpace(), count, [&](Offset k) {
    if (first(k) >= 0) first(k) = ~first(first(k));
  });
  parallel_for("GALE::number_first", HostExecutionSpace(), places.extent(0),
               [&](Offset i) { first(places(i)) = static_cast<Id>(i); });
  return places;
}

}  // namespace

template <class Cell>
SharedPaths share(const Separatrices<Cell>& paths) {
  const auto count = static_cast<Offset>(paths.cells.size());
  require_ids("cells of separatrices", count);
  std::vector<Id> first_of_source(
      paths.count() == 0 ? 0 : *std::max_element(paths.sources.begin(), paths.sources.end()) + 1, no_id);
  std::vector<std::uint8_t> begins(count, 0);  // whether a path does
  const auto first_behind_same = allocate<Ids>("GALE::first_behind_same", count);
  for (Id i = 0; i < paths.count(); ++i) {
    if (paths.begin[i] == paths.begin[i + 1]) continue;
    Id& first = first_of_source[paths.sources[i]];
    if (first == no_id) first = static_cast<Id>(paths.begin[i]);
    begins[paths.begin[i]] = 1;
    first_behind_same(paths.begin[i]) = first;
  }
  const Ids first = first_places(paths.cells);
  parallel_for("GALE::first_behind_same", HostExecutionSpace(), count, [&](Offset k) {
    if (begins[k] != 0) return;
    if (count - k > ahead) __builtin_prefetch(&paths.cells[first(k + ahead - 1) + 1]);
    const Id behind = first(k - 1) + 1;
    const bool is_same =
        begins[behind] == 0 && is_between_both(paths.cells[k - 1], paths.cells[behind], paths.cells[k]);
    first_behind_same(k) = is_same ? behind : static_cast<Id>(k);
  });
  SharedPaths shared;
  shared.first_cell = number(first);
  shared.cell = first;
  shared.first_between = number(first_behind_same);
  shared.between = first_behind_same;
  return shared;
}

template SharedPaths share(const Separatrices<Id>&);
template SharedPaths share(const Separatrices<TriangleVertices>&);

}  // namespace gale::outputs::detail
