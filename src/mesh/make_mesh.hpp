#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/cells/split_cells.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale {

namespace detail {

/// Which of GALE's types holds what a caller's type does.
template <class T>
using CoordinateFor = std::conditional_t<std::is_same_v<T, float>, float, double>;
template <class T>
using IndexFor =
    std::conditional_t<(sizeof(T) < 4 || (sizeof(T) == 4 && std::is_signed_v<T>)), std::int32_t, std::int64_t>;

/// A caller's View as rows of `columns` entries where GALE reads them.
template <int columns, template <class> class TypeFor, class View>
using RowsOf =
    Kokkos::View<const TypeFor<typename View::non_const_value_type>* [columns], Kokkos::LayoutRight,
                 std::conditional_t<is_device_memory<typename View::memory_space>, WorkerMemory, HostMemory>>;

/// Copies a row of `columns` entries.
template <int columns, class To, class From>
struct CopyRow {
  To to;
  From from;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    for (int column = 0; column < columns; ++column)
      to(i, column) = static_cast<typename To::non_const_value_type>(from(i, column));
  }
};

/// The View's memory if it is laid out so, else a copy. Throws gale::Error, calling it `name`, if it has another number
/// of columns.
template <int columns, template <class> class TypeFor, class View>
RowsOf<columns, TypeFor, View> rows_of(const char* name, const View& view) {
  static_assert(View::rank == 2, "a View of rank 2 is wanted");
  using Rows = RowsOf<columns, TypeFor, View>;
  using Type = typename Rows::non_const_value_type;
  if (view.extent(1) != columns) {
    throw Error(std::string(name) + " have " + std::to_string(view.extent(1)) + " columns, not " +
                std::to_string(columns));
  }
  if constexpr (std::is_same_v<Type, typename View::non_const_value_type>) {
    if (view.stride(0) == columns && view.stride(1) == 1) return Rows(view.data(), view.extent(0));
  }
  using Space =
      std::conditional_t<is_device_memory<typename Rows::memory_space>, WorkerSpace, Kokkos::DefaultHostExecutionSpace>;
  const auto copy = allocate<typename Rows::non_const_type>("GALE::caller_rows", view.extent(0));
  parallel_for("GALE::caller_rows", Space(), view.extent(0), CopyRow<columns, decltype(copy), View>{copy, view});
  return copy;
}

/// Copies an entry.
template <class To, class From>
struct CopyEntry {
  To to;
  From from;

  KOKKOS_FUNCTION void operator()(Offset i) const { to(i) = static_cast<typename To::non_const_value_type>(from(i)); }
};

/// The place of an entry that T doesn't hold; of another one the greatest.
template <class T, class View>
struct PlaceOfOther {
  View entries;

  KOKKOS_FUNCTION Offset operator()(Offset i) const {
    using Entry = typename View::non_const_value_type;
    const Entry entry = entries(i);
    return static_cast<Entry>(static_cast<T>(entry)) == entry ? static_cast<Offset>(entries.extent(0)) : i;
  }
};

/// Throws gale::Error for one of the types of cells that is none of VTK's.
template <class View>
void require_types(const View& types) {
  if constexpr (std::is_same_v<typename View::non_const_value_type, std::uint8_t>) return;
  using Space =
      std::conditional_t<is_device_memory<typename View::memory_space>, WorkerSpace, Kokkos::DefaultHostExecutionSpace>;
  const Offset count = types.extent(0);
  const Offset cell = reduce_min("GALE::require_types", Space(), count, count, PlaceOfOther<std::uint8_t, View>{types});
  if (cell == count) return;
  typename View::non_const_value_type type;
  Kokkos::deep_copy(type, Kokkos::subview(types, cell));
  throw Error("cell " + std::to_string(cell) + " has the type " + std::to_string(type) + ", which is none of VTK's");
}

/// A caller's View of rank 1 as entries of T that follow each other in `Memory`: the same memory if they do already,
/// else a copy.
template <class T, class Memory, class View>
Array<const T, Memory> entries_of(const View& view) {
  static_assert(View::rank == 1, "a View of rank 1 is wanted");
  constexpr bool on_device = is_device_memory<typename View::memory_space>;
  if constexpr (on_device != is_device_memory<Memory>) {
    return in_memory<Memory>(entries_of<T, std::conditional_t<on_device, WorkerMemory, HostMemory>>(view));
  } else {
    if constexpr (std::is_same_v<T, typename View::non_const_value_type>) {
      if (view.stride(0) == 1 || view.extent(0) < 2) return Array<const T, Memory>(view.data(), view.extent(0));
    }
    using Space = std::conditional_t<on_device, WorkerSpace, Kokkos::DefaultHostExecutionSpace>;
    const auto copy = allocate<Array<T, Memory>>("GALE::caller_entries", view.extent(0));
    parallel_for("GALE::caller_entries", Space(), view.extent(0), CopyEntry<Array<T, Memory>, View>{copy, view});
    return copy;
  }
}

/// A vector as an unmanaged View. Throws gale::Error if its length is no multiple of `columns`.
template <int columns, class T>
auto view_of(const char* name, const std::vector<T>& values) {
  if (values.size() % columns != 0) {
    throw Error(std::string(name) + " have " + std::to_string(values.size()) + " entries, no multiple of " +
                std::to_string(columns));
  }
  return Kokkos::View<const T* [columns], Kokkos::LayoutRight, HostMemory, Kokkos::MemoryUnmanaged>(
      values.data(), values.size() / columns);
}

}  // namespace detail

/// Makes the mesh of what a caller has in Views of its own: `points` are n x 3 coordinates, `cells` m x 4 vertex ids of
/// tetrahedra or m x 3 of triangles. Any layout, in host memory or the workers', managed or not; float or double, any
/// integer type. They are read where they are if their rows are contiguous and their types are those of GALE
/// (std::int32_t or std::int64_t), else copied first. Nothing keeps them.
///
/// Segmented by an octree of `capacity` vertices a segment. Throws as octree_segmentation and Mesh do, and if the
/// second extents aren't 3, and 3 or 4.
template <class PointView, class CellView>
Mesh make_mesh(const PointView& points, const CellView& cells, int capacity = default_capacity) {
  const auto segmentation = octree_segmentation(detail::rows_of<3, detail::CoordinateFor>("points", points), capacity);
  return cells.extent(1) == 3 ? Mesh(detail::rows_of<3, detail::IndexFor>("triangles", cells), segmentation)
                              : Mesh(detail::rows_of<4, detail::IndexFor>("tetrahedra", cells), segmentation);
}

/// Takes what a caller has in Views of rank 1, as VTK numbers and orders cells: their points, where each cell begins
/// among these (one more than cells), and the type of each. Of any integer types; all are read where `connectivity` is,
/// in place if they are std::int32_t or std::int64_t, std::int64_t, and std::uint8_t, else copied first. To be kept no
/// longer than these Views.
template <class ConnectivityView, class OffsetView, class TypeView>
auto cells_of(const ConnectivityView& connectivity, const OffsetView& offsets, const TypeView& types) {
  using Memory =
      std::conditional_t<is_device_memory<typename ConnectivityView::memory_space>, WorkerMemory, HostMemory>;
  using Index = detail::IndexFor<typename ConnectivityView::non_const_value_type>;
  detail::require_types(types);
  return Cells<Index, Memory>{detail::entries_of<std::uint8_t, Memory>(types),
                              detail::entries_of<Offset, Memory>(offsets),
                              detail::entries_of<Index, Memory>(connectivity)};
}

/// Makes the mesh of cells of any kind, which are read as cells_of() does: of tetrahedra (`split_cells`), or, where no
/// cell is of dimension 3, of triangles (`split_polygons`). Tetrahedra aren't copied where all cells are. Which cell a
/// tetrahedron or triangle is of says the function that split them. Throws as that does, too.
template <class PointView, class ConnectivityView, class OffsetView, class TypeView>
Mesh make_mesh(const PointView& points, const ConnectivityView& connectivity, const OffsetView& offsets,
               const TypeView& types, int capacity = default_capacity) {
  const auto cells = cells_of(connectivity, offsets, types);
  using Index = typename decltype(cells.connectivity)::non_const_value_type;
  using Memory = typename decltype(cells.connectivity)::memory_space;
  const auto segmentation = octree_segmentation(detail::rows_of<3, detail::CoordinateFor>("points", points), capacity);
  if (are_tetrahedra(cells))
    return Mesh(Tetrahedra<Index, Memory>(cells.connectivity.data(), cells.types.extent(0)), segmentation);
  const auto count = static_cast<Offset>(points.extent(0));
  if (highest_dimension(on_host(cells.types)) == 2)
    return Mesh(Triangles<Id, Memory>(split_polygons(cells, count).simplices), segmentation);
  return Mesh(Tetrahedra<Id, Memory>(split_cells(cells, count).simplices), segmentation);
}

/// Makes the mesh of vectors of 3 coordinates a point and 4 vertex ids a tetrahedron. Throws gale::Error, too, if the
/// lengths are no multiples of 3 and 4.
template <class Coordinate, class Index>
Mesh make_mesh(const std::vector<Coordinate>& points, const std::vector<Index>& tetrahedra,
               int capacity = default_capacity) {
  return make_mesh(detail::view_of<3>("points", points), detail::view_of<4>("tetrahedra", tetrahedra), capacity);
}

}  // namespace gale
