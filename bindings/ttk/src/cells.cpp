#include <algorithm>
#include <string>
#include <tuple>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/ttk/cells.hpp>

namespace gale::ttk {

namespace {

/// Four of the points, none of them twice?
bool is_valid(const long long* corners, Id points) {
  const auto [a, b, c, d] = std::tie(corners[0], corners[1], corners[2], corners[3]);
  const auto is_point = [points](long long vertex) { return vertex >= 0 && vertex < points; };
  return is_point(a) && is_point(b) && is_point(c) && is_point(d) && a != b && a != c && a != d && b != c && b != d &&
         c != d;
}

[[noreturn]] void refuse(const long long* corners, Offset cell, Id points) {
  const std::string name = "cell " + std::to_string(cell) + " has the vertex ";
  for (int corner = 0; corner < 4; ++corner) {
    const std::string vertex = std::to_string(corners[corner]);
    if (corners[corner] < 0 || corners[corner] >= points) {
      throw Error(name + vertex + ", but there are " + std::to_string(points) + " points");
    }
    if (std::find(corners, corners + corner, corners[corner]) != corners + corner)
      throw Error(name + vertex + " twice");
  }
  throw Error("cell " + std::to_string(cell) + " is not valid");
}

}  // namespace

void Cells::require_valid(Id points) const {
  const Offset wrong =
      reduce_min("GALE::ttk_validate_cells", HostExecutionSpace(), count_, Offset(count_),
                 [&](Offset c) { return is_valid(first_ + stride_ * c, points) ? Offset(count_) : c; });
  if (wrong != count_) refuse(first_ + stride_ * wrong, wrong, points);
}

Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory> Cells::copy(Id points) const {
  const auto corners = allocate<Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory>>("GALE::ttk_cells", count_);
  const Offset wrong = reduce_min("GALE::ttk_copy_cells", HostExecutionSpace(), count_, Offset(count_), [&](Offset c) {
    const long long* const from = first_ + stride_ * c;
    for (int corner = 0; corner < 4; ++corner) corners(c, corner) = static_cast<Id>(from[corner]);
    return is_valid(from, points) ? Offset(count_) : c;
  });
  if (wrong != count_) refuse(first_ + stride_ * wrong, wrong, points);
  return corners;
}

}  // namespace gale::ttk
