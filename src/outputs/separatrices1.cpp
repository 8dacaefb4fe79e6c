#include <gale/base/parallel.hpp>
#include <gale/mesh/positions.hpp>
#include <gale/outputs/corners.hpp>
#include <gale/outputs/line_arrays.hpp>
#include <gale/outputs/separatrices1.hpp>

namespace gale::outputs {

namespace {

using Triangle = TriangleVertices;

enum Type : std::int8_t { descending = 0, connector = 1, ascending = 2 };

/// The simplices along the paths of one kind. On each path, every cell is preceded by a simplex of another dimension.
template <class Simplex, class CellOf, class IdOf>
struct Along {
  const Simplex* between;  ///< what precedes each cell (GALE's ids)
  const Id* between_ids;   ///< and its CellId
  CellOf cell_of;          ///< cell_of(cell): the cell's vertices (GALE's ids)
  IdOf id_of;              ///< id_of(k): the CellId of the k-th cell
};

template <class Simplex, class CellOf, class IdOf>
Along(const Simplex*, const Id*, CellOf, IdOf) -> Along<Simplex, CellOf, IdOf>;

/// The critical simplices where paths of one kind begin and where they end.
struct Ends {
  const std::vector<CriticalSimplex>& sources;
  const std::vector<CriticalSimplex>& destinations;
};

/// Collects the separatrices of one kind after the other.
template <class Coordinate>
class Lines {
 public:
  /// Lines for that many cells on so many paths, of all kinds together.
  Lines(const io::Dataset::Points<Coordinate>& points, const Mesh& mesh, const detail::Heights& heights, Offset cells,
        Offset paths)
      : input_(mesh.vertex_input().data()), points_(points), heights_(heights), arrays_(cells, paths) {}

  /// Two points for each cell of the paths: the simplex that precedes it, and itself.
  template <class Cell, class Simplices>
  void add(Type type, const Separatrices<Cell>& paths, const Simplices& along, const Ends& ends) {
    parallel_for("GALE::separatrices1", HostExecutionSpace(), paths.count(), [&](Offset i) {
      const Offset begin = paths.begin[i], end = paths.begin[i + 1];
      for (Offset k = begin; k < end; ++k) {
        set_point(2 * k, along.between[k], along.between_ids[k], k == begin);
        set_point(2 * k + 1, along.cell_of(paths.cells[k]), along.id_of(k), k + 1 == end && paths.is_whole(i));
      }
      set_lines(type, i, 2 * begin, 2 * end, ends.sources[paths.sources[i]], ends.destinations[paths.destinations[i]]);
    });
    first_point_ += 2 * paths.cells.size();
    first_path_ += paths.count();
  }

  io::Surface take(const io::PointArray& field) { return arrays_.take(field); }

 private:
  template <std::size_t N>
  void set_point(Offset place, const std::array<Id, N>& simplex, Id id, bool is_end) {
    arrays_.set_point(first_point_ + place, gale::detail::position_of(points_, detail::to_input(input_, simplex)), id,
                      N - 1, is_end);
  }

  /// Lines between consecutive points of [begin, end), those of the i-th path of the kind being added.
  void set_lines(Type type, Offset i, Offset begin, Offset end, const CriticalSimplex& source,
                 const CriticalSimplex& destination) {
    const Offset id = first_path_ + i, point = first_point_ + begin;
    const double maximum = heights_.value(heights_.higher(source.highest(), destination.highest()));
    const double minimum = heights_.value(heights_.lower(source.lowest(), destination.lowest()));
    arrays_.set_lines(
        point - id, end - begin - 1, point, destination.cell,  // a path has a point more than lines
        {source.cell, static_cast<Id>(id), type, maximum, minimum, source.on_surface + destination.on_surface});
  }

  const Id* input_;
  const io::Dataset::Points<Coordinate>& points_;
  const detail::Heights& heights_;
  detail::LineArrays<Coordinate> arrays_;
  Offset first_point_ = 0, first_path_ = 0;
};

}  // namespace

io::Surface separatrices1(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex,
                          const NamedSimplices& named, const SimplexNumbers& numbers, const KnownSimplices& critical) {
  const Mesh& mesh = complex.gradient.mesh();
  const auto &falling = complex.descending, &rising = complex.ascending;
  const auto& connectors = complex.connectors;
  const detail::Heights heights(complex.gradient, field);
  const detail::NamedGroups groups(complex);
  const Offset cells = falling.cells.size() + rising.cells.size() + connectors.cells.size();
  const Offset paths = Offset(falling.count()) + rising.count() + connectors.count();
  const Id *edge_ids = numbers.edges.data(), *triangle_ids = numbers.triangles.data();
  const Along descending_along{named.edges.data() + groups.descending_edges, edge_ids + groups.descending_edges,
                               [](Id v) { return std::array<Id, 1>{v}; },
                               [&](Offset k) { return mesh.vertex_input()(falling.cells[k]); }};
  const Along ascending_along{named.triangles.data() + groups.ascending_triangles,
                              triangle_ids + groups.ascending_triangles,
                              [&](Id t) { return detail::corners_of(mesh, t); },
                              [&](Offset k) { return mesh.tetrahedron_input()(rising.cells[k]); }};
  const Along connecting{named.edges.data() + groups.connector_edges, edge_ids + groups.connector_edges,
                         [](const Triangle& triangle) { return triangle; },
                         [&](Offset k) { return triangle_ids[groups.connector_triangles + k]; }};
  return std::visit(
      [&](const auto& points) {
        using Coordinate = typename std::decay_t<decltype(points)>::non_const_value_type;
        Lines<Coordinate> lines(points, mesh, heights, cells, paths);
        lines.add(descending, falling, descending_along, {critical[1], critical[0]});
        lines.add(ascending, rising, ascending_along, {critical[2], critical[3]});
        lines.add(connector, connectors, connecting, {critical[1], critical[2]});
        return lines.take(field);
      },
      dataset.points);
}

}  // namespace gale::outputs
