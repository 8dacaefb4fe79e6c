#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <Kokkos_Core.hpp>

#include <gale/export.hpp>
#include <gale/mesh/grid.hpp>

namespace gale::io {
namespace detail {

using AnyVector =
    std::variant<std::vector<std::int8_t>, std::vector<std::uint8_t>, std::vector<std::int16_t>,
                 std::vector<std::uint16_t>, std::vector<std::int32_t>, std::vector<std::uint32_t>,
                 std::vector<std::int64_t>, std::vector<std::uint64_t>, std::vector<float>, std::vector<double>>;

}  // namespace detail

/// One array of values per point, as a file carries it: `components` values for each point, point after point.
struct PointArray {
  /// One of these vectors; to be used as the std::variant that it is. When memory for a copy runs out, libstdc++ 12's
  /// variant of vectors destroys one that was never made: here the copy is made first, and moved.
  struct Values : detail::AnyVector {
    using detail::AnyVector::AnyVector;

    Values() = default;                                                        ///< no values, of the type that is first
    Values(const Values& other) : Values(copy_of(other)) {}                    ///< copies first, then moves
    Values(Values&&) = default;                                                ///< moves
    Values& operator=(const Values& other) { return *this = copy_of(other); }  ///< copies first, then moves
    Values& operator=(Values&&) = default;                                     ///< moves
    ~Values() = default;

   private:
    static Values copy_of(const detail::AnyVector& other) {
      return std::visit(
          [](const auto& values) -> Values {
            auto copy = values;
            return copy;
          },
          other);
    }
  };

  std::string name;    ///< its name in the file
  int components = 1;  ///< values of each point, at least 1
  Values values;       ///< the values of point p begin at p * components
};

/// How a dataset has the cells of an image, or of a synthetic grid.
enum class GridCells {
  written,        ///< a tetrahedron or triangle each
  computed,       ///< as a grid
  computed_alone  ///< as a grid, and no points
};

/// A mesh of tetrahedra or of triangles in input ids, as read from a file or generated: what goes into a `gale::Mesh`,
/// and what outputs are made from.
struct Dataset {
  /// Three coordinates a point.
  template <class Coordinate>
  using Points = Kokkos::View<Coordinate* [3], Kokkos::LayoutRight, Kokkos::HostSpace>;

  /// Points of either precision, as the file has them.
  using Positions = std::variant<Points<float>, Points<double>>;

  Positions points;  ///< where the vertices are; none of GridCells::computed_alone

  /// The four vertices of each tetrahedron.
  Kokkos::View<std::int32_t* [4], Kokkos::LayoutRight, Kokkos::HostSpace> tetrahedra;

  /// The three vertices of each triangle, of a mesh that has no tetrahedra.
  Kokkos::View<std::int32_t* [3], Kokkos::LayoutRight, Kokkos::HostSpace> triangles;

  /// The grid that the cells are those of, where none are written out.
  std::optional<Grid> grid;

  /// How many vertices there are.
  std::size_t vertices() const {
    return grid ? static_cast<std::size_t>(grid->vertices())
                : std::visit([](const auto& all) { return all.extent(0); }, points);
  }

  /// The dimension of the cells: 3 where there are tetrahedra, else 2.
  int dimension() const { return grid ? grid->dimension() : tetrahedra.extent(0) > 0 ? 3 : 2; }

  /// How many cells there are, of either dimension.
  std::size_t cells() const {
    return grid ? static_cast<std::size_t>(grid->cells()) : tetrahedra.extent(0) + triangles.extent(0);
  }

  std::vector<PointArray> arrays;    ///< the file's point arrays, the active scalars first
  std::vector<std::string> notices;  ///< one line each about what of the file was left out, or split

  /// Arrays of the tetrahedra or triangles: `GlobalCellIds`, the cell of the file that each is or is a part of, counted
  /// from 0; none where these are all of the file's cells, in their order.
  std::vector<PointArray> cell_arrays;
};

/// Writes out the cells of a dataset that has a grid instead; of another one does nothing.
GALE_EXPORT void write_out_cells(Dataset& dataset);

/// How many points `array` has values for.
GALE_EXPORT std::size_t point_count(const PointArray& array);

/// The points that `ids` names, in that order: row k of the result is row `ids[k]` of `array`. `ids` is anything with
/// `size()` and `operator[]` (a vector, a rank-one View on the host). Throws `Error` for an id that `array` has no row
/// for.
template <class Ids>
PointArray gather(const PointArray& array, const Ids& ids);

/// Component `component` (counted from 0) of every point as an array of its own, called `array.name`_`component`.
GALE_EXPORT PointArray extract_component(const PointArray& array, int component);

namespace detail {

[[noreturn]] GALE_EXPORT void refuse_row(const PointArray& array, std::size_t row);

}  // namespace detail

template <class Ids>
PointArray gather(const PointArray& array, const Ids& ids) {
  const std::size_t rows = point_count(array), width = array.components, count = ids.size();
  const auto pick = [&](const auto& from) -> PointArray::Values {
    std::decay_t<decltype(from)> to(count * width);
    for (std::size_t k = 0; k < count; ++k) {
      const auto row = static_cast<std::size_t>(ids[k]);  // a negative id becomes a huge one
      if (row >= rows) detail::refuse_row(array, row);
      for (std::size_t c = 0; c < width; ++c) to[k * width + c] = from[row * width + c];
    }
    return to;
  };
  return {array.name, array.components, std::visit(pick, array.values)};
}

}  // namespace gale::io
