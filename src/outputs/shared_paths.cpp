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

/// Numbers the places whose `first` is the place itself, and the others as theirs.
void number(const Ids& first, Array<const Id, HostMemory>& numbers, Array<const Id, HostMemory>& firsts) {
  const auto count = static_cast<Offset>(first.extent(0));
  const auto number_of = allocate<Ids>("GALE::shared_numbers", count + 1);
  const Id all = exclusive_scan("GALE::shared_numbers", HostExecutionSpace(), count, number_of,
                                [&](Offset k) { return Id(first(k) == k); });
  const auto first_with = allocate<Ids>("GALE::first_with_number", all);
  parallel_for("GALE::share_numbers", HostExecutionSpace(), count, [&](Offset k) {
    if (first(k) == k) {
      first_with(number_of(k)) = first(k);
    } else {
      number_of(k) = number_of(first(k));  // which is its own
    }
  });
  numbers = number_of;
  firsts = first_with;
}

}  // namespace

template <class Cell>
SharedPaths share(const Separatrices<Cell>& paths) {
  const auto count = static_cast<Offset>(paths.cells.size());
  require_ids("cells of separatrices", count);
  std::vector<Id> first_of_source(
      paths.count() == 0 ? 0 : *std::max_element(paths.sources.begin(), paths.sources.end()) + 1, no_id);
  constexpr Id inside = no_id;
  std::vector<Id> before_start(paths.cells.size() + 1, inside);  // the first place behind the same source
  for (Id i = 0; i < paths.count(); ++i) {
    Id& first = first_of_source[paths.sources[i]];
    if (first == no_id) first = static_cast<Id>(paths.begin[i]);
    before_start[paths.begin[i]] = first;
  }
  before_start[paths.cells.size()] = 0;
  const Ids first = first_places(paths.cells);
  SharedPaths shared;
  number(first, shared.cell, shared.first_cell);
  const auto first_behind_same = allocate<Ids>("GALE::first_behind_same", count);
  parallel_for("GALE::first_behind_same", HostExecutionSpace(), count, [&](Offset k) {
    if (before_start[k] != inside) {
      first_behind_same(k) = before_start[k];
      return;
    }
    const Id behind = first(k - 1) + 1;
    const bool is_same =
        before_start[behind] == inside && is_between_both(paths.cells[k - 1], paths.cells[behind], paths.cells[k]);
    first_behind_same(k) = is_same ? behind : static_cast<Id>(k);
  });
  number(first_behind_same, shared.between, shared.first_between);
  return shared;
}

template SharedPaths share(const Separatrices<Id>&);
template SharedPaths share(const Separatrices<TriangleVertices>&);

}  // namespace gale::outputs::detail
