#pragma once

#include <any>
#include <string>
#include <utility>
#include <variant>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/make_mesh.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale {

namespace detail {

/// Rows of T, `width` in each, whose k-th of row i is value(i, k).
template <class T, int width, class Value>
auto tabulated_rows(const char* label, Offset count, const Value& value) {
  const auto all = allocate<Kokkos::View<T* [width], Kokkos::LayoutRight, HostMemory>>(label, count);
  parallel_for(label, HostExecutionSpace(), count, [&](Offset i) {
    for (int k = 0; k < width; ++k) all(i, k) = static_cast<T>(value(i, k));
  });
  return all;
}

}  // namespace detail

/// Where points are, on the host, in the precision that a caller has them in. Copies share them, and keep alive what
/// they were made from.
class HostPoints {
 public:
  HostPoints() = default;
  /// Points in the memory of a View.
  HostPoints(const Points<float, HostMemory>& points) : points_(points) {}

  /// Points in the memory of a View.
  HostPoints(const Points<double, HostMemory>& points) : points_(points) {}

  /// Points in the memory of `owner`, a View of any kind.
  template <class Coordinate, class Owner>
  HostPoints(const Points<Coordinate, HostMemory>& points, const Owner& owner) : points_(points), owner_(owner) {}

  /// Returns f(points), which have float or double coordinates.
  template <class F>
  auto visit(const F& f) const {
    return std::visit(f, points_);
  }

  /// How many points there are.
  Offset count() const {
    return visit([](const auto& points) { return static_cast<Offset>(points.extent(0)); });
  }

  /// Points begin to begin + count - 1, which share this memory.
  HostPoints part(Offset begin, Offset count) const {
    return visit([&](const auto& points) {
      using Some = std::decay_t<decltype(points)>;
      return HostPoints(Some(Kokkos::subview(points, std::make_pair(begin, begin + count), Kokkos::ALL())), owner_);
    });
  }

  /// The points as doubles: this memory if they are so already, else a copy.
  Points<double, HostMemory> in_double() const {
    if (const auto* points = std::get_if<Points<double, HostMemory>>(&points_)) return *points;
    return visit([&](const auto& points) -> Points<double, HostMemory> {
      return detail::tabulated_rows<double, 3>("GALE::points", count(),
                                               [&](Offset i, int axis) { return points(i, axis); });
    });
  }

 private:
  std::variant<Points<float, HostMemory>, Points<double, HostMemory>> points_;
  std::any owner_;
};

/// The vertices of each cell, a row each: three of triangles, four of tetrahedra.
template <class Index>
using CellRows = Kokkos::View<const Index**, Kokkos::LayoutRight, HostMemory>;

/// What one rank hands over of a mesh, on the host: any part of it, which may be empty. A cell is handed over by one
/// rank, a vertex by any number of them: what the lowest of them says of it counts.
///
/// `Index` is std::int32_t or std::int64_t.
template <class Index>
struct MeshPart {
  Array<const GlobalId, HostMemory> vertex_ids;  ///< global ids, 0 to 2^62 - 1, in any order, also with gaps
  HostPoints points;                             ///< where each of these is; the mesh keeps them

  /// The global ids of each one's vertices, which any ranks hand over: triangles or tetrahedra, on all ranks alike.
  CellRows<Index> cells;

  /// 0 to 2^62 - 1, all different, which the mesh keeps; none on all ranks: they are counted from rank to rank.
  Array<const GlobalId, HostMemory> cell_ids;
};

namespace detail {

/// A caller's points, which `rows` are or were copied from.
template <class Rows, class View>
HostPoints kept_points(const Rows& rows, const View& view) {
  const bool is_copy = static_cast<const void*>(rows.data()) != static_cast<const void*>(view.data());
  return is_copy ? HostPoints(rows) : HostPoints(rows, view);
}

/// A caller's ids as GALE reads them: the same memory if they are that already, else a copy.
template <class View>
Array<const GlobalId, HostMemory> global_ids(const View& view) {
  static_assert(View::rank == 1, "a global id for each");
  const auto here = on_host(view);
  if constexpr (Kokkos::is_always_assignable<Array<const GlobalId, HostMemory>, decltype(here)>::value) return here;
  return tabulated<GlobalId>("GALE::global_ids", here.extent(0),
                             [&](Offset i) { return static_cast<GlobalId>(here(i)); });
}

}  // namespace detail

/// The part that a caller has in Views: a global id and 3 coordinates for each vertex, 4 global ids for each
/// tetrahedron or 3 for each triangle. Of any integer and floating-point types, in host memory or a device's, in any
/// layout. Host Views that are laid out as GALE reads them (64-bit ids, rows of float or double, of 32-bit or 64-bit
/// integers) aren't copied: those of ids and cells must live as long as the part, those of points, and of cells' ids,
/// as long as the mesh. Views that Kokkos manages do so by themselves. Throws gale::Error if extents don't fit.
template <class IdView, class PointView, class CellView>
auto make_part(const IdView& vertex_ids, const PointView& points, const CellView& cells) {
  MeshPart<detail::IndexFor<typename CellView::non_const_value_type>> part;
  part.vertex_ids = detail::global_ids(vertex_ids);
  const auto rows_of_points = on_host(detail::rows_of<3, detail::CoordinateFor>("points", points));
  part.points = detail::kept_points(rows_of_points, points);
  if (cells.extent(1) == 3) {
    part.cells = on_host(detail::rows_of<3, detail::IndexFor>("triangles", cells));
  } else if (cells.extent(0) > 0) {
    part.cells = on_host(detail::rows_of<4, detail::IndexFor>("tetrahedra", cells));
  }
  if (static_cast<Offset>(part.vertex_ids.extent(0)) != part.points.count()) {
    throw Error("there are " + std::to_string(part.vertex_ids.extent(0)) + " vertex ids, but " +
                std::to_string(part.points.count()) + " points");
  }
  return part;
}

/// The part that a caller has in Views, with a global id for each cell: throws gale::Error if there aren't as many.
template <class IdView, class PointView, class CellView, class CellIdView>
auto make_part(const IdView& vertex_ids, const PointView& points, const CellView& cells, const CellIdView& cell_ids) {
  auto part = make_part(vertex_ids, points, cells);
  part.cell_ids = detail::global_ids(cell_ids);
  if (part.cell_ids.extent(0) != part.cells.extent(0)) {
    throw Error("there are " + std::to_string(part.cell_ids.extent(0)) + " cell ids, but " +
                std::to_string(part.cells.extent(0)) + " cells");
  }
  return part;
}

}  // namespace gale
