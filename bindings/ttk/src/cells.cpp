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

Cells::Cells(const long long* first, int stride, Id count, Id points)
    : corners_(allocate<Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory>>("GALE::ttk_cells", count)),
      data_(corners_.data()) {
  const Offset wrong = reduce_min("GALE::ttk_copy_cells", HostSpace(), count, Offset(count), [&](Offset c) {
    bool right = true;
    for (int corner = 0; corner < 4; ++corner) {
      const long long vertex = first[stride * c + corner];
      right = right && vertex >= 0 && vertex < points;
      corners_(c, corner) = static_cast<Id>(vertex);
    }
    return right ? Offset(count) : c;
  });
  if (wrong != count) refuse(first + stride * wrong, wrong, points);
}

}  // namespace gale::ttk
