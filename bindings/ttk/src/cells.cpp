#include <string>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/ttk/cells.hpp>

namespace gale::ttk {

namespace {

[[noreturn]] void refuse(const long long* corners, Offset cell, Id points) {
  while (*corners >= 0 && *corners < points) ++corners;
  throw Error("cell " + std::to_string(cell) + " has the vertex " + std::to_string(*corners) + ", but there are " +
              std::to_string(points) + " points");
}

}  // namespace

Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory> Cells::copy(Id points) const {
  const auto corners = allocate<Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory>>("GALE::ttk_cells", count_);
  const Offset wrong = reduce_min("GALE::ttk_copy_cells", HostSpace(), count_, Offset(count_), [&](Offset c) {
    bool right = true;
    for (int corner = 0; corner < 4; ++corner) {
      const long long vertex = first_[stride_ * c + corner];
      right = right && vertex >= 0 && vertex < points;
      corners(c, corner) = static_cast<Id>(vertex);
    }
    return right ? Offset(count_) : c;
  });
  if (wrong != count_) refuse(first_ + stride_ * wrong, wrong, points);
  return corners;
}

}  // namespace gale::ttk
