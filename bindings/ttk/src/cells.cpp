#include <algorithm>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/ttk/cells.hpp>

namespace gale::ttk {

namespace {

/// Which of some corners is the first that isn't one of the points, or that is there before; their count if none is.
int first_wrong(const long long* corners, int count, Id points) {
  int corner = 0;
  while (corner < count && corners[corner] >= 0 && corners[corner] < points &&
         std::find(corners, corners + corner, corners[corner]) == corners + corner) {
    ++corner;
  }
  return corner;
}

[[noreturn]] void refuse(const long long* corners, int count, Offset cell, Id points) {
  const long long vertex = corners[first_wrong(corners, count, points)];
  const bool is_point = vertex >= 0 && vertex < points;
  throw Error("cell " + std::to_string(cell) + " has the vertex " + std::to_string(vertex) +
              (is_point ? " twice" : ", but there are " + std::to_string(points) + " points"));
}

}  // namespace

void Cells::require_valid(Id points) const {
  const Offset wrong = reduce_min(
      "GALE::ttk_validate_cells", HostExecutionSpace(), count_, Offset(count_),
      [&](Offset c) { return first_wrong(first_ + stride_ * c, corners_, points) == corners_ ? Offset(count_) : c; });
  if (wrong != count_) refuse(first_ + stride_ * wrong, corners_, wrong, points);
}

template <int corners>
Kokkos::View<Id* [corners], Kokkos::LayoutRight, HostMemory> Cells::copy(Id points) const {
  const auto copied = allocate<Kokkos::View<Id* [corners], Kokkos::LayoutRight, HostMemory>>("GALE::ttk_cells", count_);
  const Offset wrong = reduce_min("GALE::ttk_copy_cells", HostExecutionSpace(), count_, Offset(count_), [&](Offset c) {
    const long long* const from = first_ + stride_ * c;
    for (int corner = 0; corner < corners; ++corner) copied(c, corner) = static_cast<Id>(from[corner]);
    return first_wrong(from, corners, points) == corners ? Offset(count_) : c;
  });
  if (wrong != count_) refuse(first_ + stride_ * wrong, corners, wrong, points);
  return copied;
}

template Kokkos::View<Id* [3], Kokkos::LayoutRight, HostMemory> Cells::copy<3>(Id) const;
template Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory> Cells::copy<4>(Id) const;

}  // namespace gale::ttk
