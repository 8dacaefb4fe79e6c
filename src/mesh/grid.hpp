#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include <gale/base/mirrored.hpp>
#include <gale/base/parallel.hpp>
#include <gale/export.hpp>
#include <gale/mesh/grid/grid_stars.hpp>
#include <gale/mesh/grid/grid_view.hpp>
#include <gale/mesh/intervals.hpp>

namespace gale {

/// A regular grid of points, or of those that some of its cubes use: the input of a `Mesh` that has no arrays. Each
/// cube is six tetrahedra along its main diagonal (`freudenthal`), each square of a single layer two triangles, (a, a +
/// x, a + x + y) and (a, a + y, a + x + y), so that neighbours fit.
///
/// Vertices are the points that a cube uses, numbered x fastest, then y; cells follow their cubes likewise. Immutable;
/// copies share what it has: where all cubes are there next to nothing, else three bits a point.
class GALE_EXPORT Grid {
 public:
  /// A grid with all cubes of so many points along x, y and z: at least two, but one along z makes triangles. Throws
  /// gale::Error for other numbers, and for more vertices or cells than ids can number.
  explicit Grid(const std::array<Id, 3>& points);

  /// A grid with the cubes all of whose corners are inside; none may be. `inside` has a bit for each point: rows along
  /// x, y fastest, each of words_of_row(points[0]) words, the lowest bit first. Throws gale::Error for one behind a
  /// row's last point, too. Takes time O(n), and three bits a point.
  Grid(const std::array<Id, 3>& points, const Array<std::uint64_t, HostMemory>& inside);

  /// How many words of 64 bits so many points take.
  static std::size_t words_of_row(Id points) { return (static_cast<std::size_t>(points) + 63) / 64; }

  int dimension() const { return points_[2] == 1 ? 2 : 3; }         ///< 2 where cells are triangles
  const std::array<Id, 3>& points() const { return points_; }       ///< along x, y and z, used or not
  Id vertices() const { return vertices_; }                         ///< points that a cube uses
  Id cubes() const { return cubes_; }                               ///< or squares
  Id cells() const { return cubes_ * (dimension() == 3 ? 6 : 2); }  ///< tetrahedra, or triangles
  bool is_whole() const { return places_ == nullptr; }              ///< whether all cubes are there

  /// Whether they have the same points along each axis and the same cubes.
  bool operator==(const Grid& other) const;

  /// Calls visit(row, x, vertex) for each vertex of the rows along x from `first` to before `last`, in their order; the
  /// row of y and z has the number z * points()[1] + y.
  template <class Visit>
  void for_each_vertex(Id first, Id last, const Visit& visit) const {
    const GridView view = in<HostMemory>();
    for (Id row = first; row < last; ++row) {
      Id vertex = view.vertex_at(0, row % view.ny, row / view.ny);
      for (Id x = 0; x < view.nx; ++x) {
        if (view.is_whole() || view.vertices.has(row * view.row + x)) visit(row, x, vertex++);
      }
    }
  }

  /// An interval of cells all of whose vertices are among some: all such cells where these fill layers of points, or
  /// rows of a grid of triangles.
  Interval cells_within(const Interval& some) const;

  /// For code that runs on `Memory`. Valid as long as the grid or a copy of it.
  template <class Memory>
  GridView in() const;

  /// Writes the vertices of each cell, ascending, to the rows of a View on the host.
  template <class Cells>
  void write_cells(const Cells& to) const {
    const GridView view = in<HostMemory>();
    const Id of_cube = view.cells_per_cube();
    parallel_for("GALE::write_cells", HostExecutionSpace(), cubes(), [&](Offset cube) {
      const Quad corners = view.corners_of_cube(static_cast<Id>(cube));
      for (Id i = 0; i < of_cube; ++i) {
        const Quad cell = view.cell_of_cube(corners, i);
        for (int k = 0; k <= view.dimension; ++k) to(cube * of_cube + i, k) = cell[k];
      }
    });
  }

  /// What the kinds of stars have in common, by kind, where code that runs on `Memory` reads it.
  template <class Memory>
  const detail::StarKind* kinds_in() const {
    return kinds_.in<Memory>().data();
  }

 private:
  struct Places;

  std::array<Id, 3> points_;
  Id vertices_ = 0, cubes_ = 0;
  std::shared_ptr<const Places> places_;  ///< null where all cubes are there
  Mirrored<detail::StarKind> kinds_;
};

}  // namespace gale
