#include <string>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/ttk/cells.hpp>

namespace gale::ttk {

namespace {

/// Which of a cell's corners is the first that isn't one of the points, or that is there before; `corners` if none is.
template <int corners>
int first_wrong(const long long* vertices, Id points) {
  for (int i = 0; i < corners; ++i) {
    bool good = vertices[i] >= 0 && vertices[i] < points;
    for (int before = 0; before < i; ++before) good = good && vertices[before] != vertices[i];
    if (!good) return i;
  }
  return corners;
}

/// take(cell, vertices) for each cell; throws for the first that isn't valid.
template <int corners, class Take>
void take_valid(const char* name, const long long* first, Offset stride, Id count, Id points, const Take& take) {
  const Offset wrong = reduce_min(name, HostExecutionSpace(), count, Offset(count), [&](Offset c) {
    const long long* const vertices = first + stride * c;
    take(c, vertices);
    return first_wrong<corners>(vertices, points) == corners ? Offset(count) : c;
  });
  if (wrong == count) return;
  const long long vertex = first[stride * wrong + first_wrong<corners>(first + stride * wrong, points)];
  const bool is_point = vertex >= 0 && vertex < points;
  throw Error("cell " + std::to_string(wrong) + " has the vertex " + std::to_string(vertex) +
              (is_point ? " twice" : ", but there are " + std::to_string(points) + " points"));
}

}  // namespace

void Cells::require_valid(Id points) const {
  const char* const name = "GALE::ttk_validate_cells";
  const auto take = [](Offset, const long long*) {};
  corners_ == 3 ? take_valid<3>(name, first_, stride_, count_, points, take)
                : take_valid<4>(name, first_, stride_, count_, points, take);
}

template <int corners>
Kokkos::View<Id* [corners], Kokkos::LayoutRight, HostMemory> Cells::copy(Id points) const {
  const auto copied = allocate<Kokkos::View<Id* [corners], Kokkos::LayoutRight, HostMemory>>("GALE::ttk_cells", count_);
  take_valid<corners>("GALE::ttk_copy_cells", first_, stride_, count_, points,
                      [&](Offset c, const long long* vertices) {
                        for (int corner = 0; corner < corners; ++corner)
                          copied(c, corner) = static_cast<Id>(vertices[corner]);
                      });
  return copied;
}

template Kokkos::View<Id* [3], Kokkos::LayoutRight, HostMemory> Cells::copy<3>(Id) const;
template Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory> Cells::copy<4>(Id) const;

}  // namespace gale::ttk
