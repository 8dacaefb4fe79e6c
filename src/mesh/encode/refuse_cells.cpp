#include <limits>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/encode/cells.hpp>

namespace gale::detail {

namespace {

/// "tetrahedron", or "triangle".
std::string name_of_cell(int corners) { return corners == 4 ? "tetrahedron" : "triangle"; }

/// Is there something wrong with the cell by itself?
template <int corners, class Index, class Memory>
KOKKOS_FUNCTION bool is_bad(const CellCorners<corners, Index, Memory>& input, Offset t, Offset vertices) {
  for (int corner = 0; corner < corners; ++corner) {
    const Index v = input(t, corner);
    if (v < 0 || v >= vertices) return true;
    for (int other = 0; other < corner; ++other) {
      if (input(t, other) == v) return true;
    }
  }
  return false;
}

/// Says what `is_bad` found.
template <int corners, class Index, class Memory>
[[noreturn]] void refuse(const CellCorners<corners, Index, Memory>& input, Offset t, Offset vertices) {
  const auto row = Kokkos::subview(input, std::make_pair(t, t + 1), Kokkos::ALL());
  const auto quad = Kokkos::create_mirror_view_and_copy(HostMemory(), row);
  const std::string name = name_of_cell(corners) + " " + std::to_string(t);
  for (int corner = 0; corner < corners; ++corner) {
    const Index v = quad(0, corner);
    if (v < 0 || v >= vertices) {
      throw Error(name + " has vertex " + std::to_string(v) + ", but vertices are 0 to " +
                  std::to_string(vertices - 1));
    }
    for (int other = 0; other < corner; ++other) {
      if (quad(0, other) == v) throw Error(name + " has vertex " + std::to_string(v) + " twice");
    }
  }
  throw Error(name + " is not valid");
}

template <int corners, class Index, class Space>
void validate(const Space& space, const CellCorners<corners, Index, MemoryOf<Space>>& input, Offset vertices) {
  const Offset count = input.extent(0);
  const Offset bad = reduce_min(
      "GALE::validate_cells", space, count, count,
      KOKKOS_LAMBDA(Offset t) { return is_bad(input, t, vertices) ? t : count; });
  if (bad < count) refuse(input, bad, vertices);
}

template <class Memory>
KOKKOS_FUNCTION bool same_as_next(const SortedCells<Memory>& sorted, Offset t) {
  return sorted.of_lowest.entries(t) == sorted.of_lowest.entries(t + 1);
}

template <int corners, class Space>
void refuse_duplicates(const Space& space, const SortedCells<MemoryOf<Space>>& sorted) {
  const auto count = static_cast<Id>(sorted.of_lowest.entries.extent(0));
  if (count == 0) return;
  const Id none = std::numeric_limits<Id>::max();
  const Id twin = reduce_min(
      "GALE::find_duplicates", space, count - 1, none,
      KOKKOS_LAMBDA(Offset t) { return same_as_next(sorted, t) ? sorted.input(t + 1) : none; });
  if (twin == none) return;
  const Id first = reduce_min(
      "GALE::find_duplicate", space, count - 1, none, KOKKOS_LAMBDA(Offset t) {
        return same_as_next(sorted, t) && sorted.input(t + 1) == twin ? sorted.input(t) : none;
      });
  throw Error((corners == 4 ? "tetrahedra " : "triangles ") + std::to_string(first) + " and " + std::to_string(twin) +
              " have the same " + (corners == 4 ? "four" : "three") + " vertices");
}

}  // namespace

template <int corners, class Space, class Index>
void refuse_cells(const Space& space, const CellCorners<corners, Index, MemoryOf<Space>>& input,
                  const SortedCells<MemoryOf<Space>>& sorted, Offset vertices) {
  validate<corners, Index>(space, input, vertices);
  refuse_duplicates<corners>(space, sorted);
  throw Error("the mesh's cells are not valid");
}

#define GALE_INSTANTIATE_INDEX(Space, corners, Index)                                                    \
  template void refuse_cells<corners>(const Space&, const CellCorners<corners, Index, MemoryOf<Space>>&, \
                                      const SortedCells<MemoryOf<Space>>&, Offset)
#define GALE_INSTANTIATE(Space)                   \
  GALE_INSTANTIATE_INDEX(Space, 4, std::int32_t); \
  GALE_INSTANTIATE_INDEX(Space, 4, std::int64_t); \
  GALE_INSTANTIATE_INDEX(Space, 3, std::int32_t); \
  GALE_INSTANTIATE_INDEX(Space, 3, std::int64_t)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE
#undef GALE_INSTANTIATE_INDEX

}  // namespace gale::detail
