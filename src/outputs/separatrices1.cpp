#include <algorithm>
#include <array>
#include <tuple>
#include <type_traits>
#include <variant>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/positions.hpp>
#include <gale/outputs/excerpt.hpp>
#include <gale/outputs/separatrices1.hpp>
#include <gale/outputs/separatrix_arrays.hpp>
#include <gale/outputs/separatrix_ends.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

namespace {

using detail::End, detail::NumbersOfAll;
using gale::detail::Point;
using Triangle = TriangleVertices;

enum Type : std::int8_t { descending = 0, connector = 1, ascending = 2, ascending_on_triangles = 1 };

/// The simplices along the paths of one kind. On each path, every cell is preceded by a simplex of another dimension.
template <class Simplex, class CellOf, class IdOf>
struct Along {
  const SharedPaths& shared;
  const Simplex* between;       ///< what precedes cells, by number (GALE's ids)
  const GlobalId* between_ids;  ///< and its CellId
  CellOf cell_of;               ///< cell_of(cell): the cell's vertices (GALE's ids)
  IdOf id_of;                   ///< id_of(k): the CellId of the k-th cell
};

template <class Simplex, class CellOf, class IdOf>
Along(const SharedPaths&, const Simplex*, const GlobalId*, CellOf, IdOf) -> Along<Simplex, CellOf, IdOf>;

/// Where the simplices on paths are drawn, by GALE's ids of their vertices.
template <class Coordinate>
struct Positions {
  const io::Dataset::Points<Coordinate>& points;
  OtherIds input;

  /// Calls put(i, position) for each simplex_of(i) of `count`, in parallel. Prefetches what is read of many at a time,
  /// as paths cross the mesh's arrays.
  template <class SimplexOf, class Put>
  void each(Offset count, const SimplexOf& simplex_of, const Put& put) const {
    constexpr Offset many = 32;
    const auto place = [&](Offset first, Offset size) {
      std::array<std::decay_t<decltype(simplex_of(first))>, many> simplices;
      for (Offset i = 0; i < size; ++i) {
        simplices[i] = simplex_of(first + i);
        if (input.table == nullptr) continue;
        for (const Id vertex : simplices[i]) __builtin_prefetch(input.table + vertex);
      }
      for (Offset i = 0; i < size; ++i) {
        simplices[i] = detail::to_input(input, simplices[i]);
        for (const Id vertex : simplices[i]) __builtin_prefetch(&points(vertex, 0));
      }
      for (Offset i = 0; i < size; ++i) put(first + i, gale::detail::position_of(points, simplices[i]));
    };
    const int parts = gale::detail::threads_for(count);
    gale::detail::for_parts("GALE::separatrices1", count, parts, [&](int, Offset first, Offset end) {
      for (; first < end; first += many) {
        gale::detail::stop_if_asked();
        place(first, std::min(many, end - first));
      }
    });
  }
};

/// The ends of the paths of one kind, and their numbers.
struct NumberedEnds {
  const std::vector<End>&sources, &destinations;
  NumbersOfAll numbers;
};

/// What 1-separatrices are in a file: a point for each simplex that paths of one kind pass, and a line along each path.
/// Collects those of one kind after the other. `Number` is Id, or GlobalId on several ranks.
template <class Coordinate, class Number>
class Lines {
 public:
  /// Lines for that many points, cells on paths, and paths, of all kinds together. Throws gale::Error if ids can't
  /// number the points.
  Lines(const Positions<Coordinate>& positions, Offset points, Offset cells, Offset paths) : positions_(positions) {
    require_ids("points of 1-separatrices", points);
    points_ = allocate<io::Dataset::Points<Coordinate>>("GALE::separatrices", points);
    gale::detail::side_by_side([&] { lines_.points.resize(2 * cells); },
                               [&] { separatrices_ = detail::SeparatrixArrays<Number>(paths); },
                               [&] { ids_.resize(points); }, [&] { lines_.begin.resize(paths + 1); },
                               [&] { mask_.assign(points, 1); }, [&] { dimensions_.resize(points); });
  }

  /// The points of what precedes cells come first, then those of cells.
  template <class Cell, class Simplices>
  void add(Type type, const Separatrices<Cell>& paths, const Simplices& along, const NumberedEnds& ends) {
    const SharedPaths& shared = along.shared;
    const Offset first_between = first_point_;
    const auto before = static_cast<Offset>(shared.first_between.extent(0));
    const auto cells = static_cast<Offset>(shared.first_cell.extent(0));
    add_points(
        before, [&](Offset i) { return along.between[i]; }, [&](Offset i) { return along.between_ids[i]; });
    add_points(
        cells, [&](Offset i) { return along.cell_of(paths.cells[shared.first_cell(i)]); },
        [&](Offset i) { return along.id_of(shared.first_cell(i)); });
    parallel_for("GALE::separatrices1", HostExecutionSpace(), paths.count(), [&](Offset i) {
      const Offset begin = paths.begin[i], end = paths.begin[i + 1];
      Id* const line = lines_.points.data() + 2 * first_cell_;
      for (Offset k = begin; k < end; ++k) {
        line[2 * k] = static_cast<Id>(first_between + shared.between(k));
        line[2 * k + 1] = static_cast<Id>(first_between + before + shared.cell(k));
      }
      lines_.begin[first_path_ + i + 1] = 2 * (first_cell_ + end);
      // Whoever has a point first says whether paths end there: all that pass it do, or none.
      if (shared.first_between(shared.between(begin)) == begin) mask_[line[2 * begin]] = 0;
      if (shared.first_cell(shared.cell(end - 1)) == end - 1 && paths.is_whole(i)) mask_[line[2 * end - 1]] = 0;
      const End &source = ends.sources[paths.sources[i]], &destination = ends.destinations[paths.destinations[i]];
      separatrices_.set(
          first_path_ + i,
          {first_path_ + i + 1, static_cast<Number>(source.cell), static_cast<Number>(destination.cell),
           static_cast<Number>(first_number_ + ends.numbers[i]), type,
           std::max(source.highest, destination.highest).value, std::min(source.lowest, destination.lowest).value,
           source.on_surface + destination.on_surface});
    });
    first_cell_ += paths.cells.size();
    first_path_ += paths.count();
    first_number_ += ends.numbers.count();
  }

  io::Surface take(const io::PointArray& field) {
    io::Surface surface;
    surface.points = points_;
    const auto add = [&](const char* name, auto&& values) {
      surface.point_arrays.push_back({name, 1, std::move(values)});  // a list of them would be copied
    };
    add("ttkMaskScalarField", mask_);
    add("CellDimension", dimensions_);
    add("CellId", ids_);
    surface.lines = std::move(lines_);
    surface.cell_arrays = separatrices_.take(field, true);
    return surface;
  }

 private:
  /// Adds the points of so many simplices of a dimension, and their CellIds.
  template <class SimplexOf, class IdOf>
  void add_points(Offset count, const SimplexOf& simplex_of, const IdOf& id_of) {
    using Simplex = std::decay_t<decltype(simplex_of(Offset()))>;
    positions_.each(count, simplex_of, [&](Offset i, const Point& position) {
      gale::detail::store(position, points_, first_point_ + i);
      dimensions_[first_point_ + i] = static_cast<std::int8_t>(std::tuple_size_v<Simplex> - 1);
      ids_[first_point_ + i] = static_cast<Number>(id_of(i));
    });
    first_point_ += count;
  }

  const Positions<Coordinate>& positions_;
  io::Dataset::Points<Coordinate> points_;
  std::vector<std::int8_t> mask_, dimensions_;
  std::vector<Number> ids_;
  io::Surface::Cells lines_;
  detail::SeparatrixArrays<Number> separatrices_{0};
  Offset first_point_ = 0, first_cell_ = 0, first_path_ = 0;
  GlobalId first_number_ = 0;
};

}  // namespace

io::Surface separatrices1(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex,
                          const NamedPaths& named, const SimplexNumbers& numbers, const KnownSimplices& critical) {
  const auto &falling = complex.descending, &rising = complex.ascending;
  const auto& connectors = complex.connectors;
  const Mesh& mesh = mesh_of_excerpt(complex);
  const detail::NamedGroups groups(complex, named);
  Offset points = 0;
  for (const SharedPaths* const shared : {&named.descending, &named.ascending, &named.connectors})
    points += shared->first_between.extent(0) + shared->first_cell.extent(0);
  const Offset cells = falling.cells.size() + rising.cells.size() + connectors.cells.size();
  const Offset paths = Offset(falling.count()) + rising.count() + connectors.count();
  const CellReader cell_at = mesh.cell_reader();
  const OtherIds vertex_input = mesh.vertices_in_input(), cell_input = mesh.cells_in_input();
  const GlobalId *edge_ids = numbers.edges.data(), *triangle_ids = numbers.triangles.data();
  const Along descending_along{named.descending, named.edges.data() + groups.descending_edges,
                               edge_ids + groups.descending_edges, [](Id v) { return std::array<Id, 1>{v}; },
                               [&](Offset k) { return mesh.vertex_id(vertex_input[falling.cells[k]]); }};
  const Along ascending_along{named.ascending, named.triangles.data() + groups.ascending_triangles,
                              triangle_ids + groups.ascending_triangles,
                              [&](Id t) { return detail::corners_of(cell_at, t); },
                              [&](Offset k) { return mesh.cell_id(cell_input[rising.cells[k]]); }};
  const Along ascending_on_triangles_along{named.ascending, named.edges.data() + groups.ascending_edges,
                                           edge_ids + groups.ascending_edges,
                                           [&](Id t) { return detail::corners_of<3>(cell_at, t); },
                                           [&](Offset k) { return mesh.cell_id(cell_input[rising.cells[k]]); }};
  const Along connecting{named.connectors, named.edges.data() + groups.connector_edges,
                         edge_ids + groups.connector_edges, [](const Triangle& triangle) { return triangle; },
                         [&](Offset k) { return triangle_ids[groups.connector_triangles + named.connectors.cell(k)]; }};
  const Ranks& ranks = complex.gradient.mesh().exchange().ranks();
  std::vector<End> ends[4];
  gale::detail::together(ranks, [&] {
    for (int dimension = 0; dimension < 4; ++dimension)
      ends[dimension] = detail::ends_of(critical[dimension], field, complex.excerpt.order());
  });
  const int top = complex.critical.dimension;
  const NumberedEnds falling_ends{ends[1], ends[0], NumbersOfAll(ranks, falling.sources, ends[1])};
  const NumberedEnds rising_ends{ends[top - 1], ends[top], NumbersOfAll(ranks, rising.sources, ends[top - 1])};
  const NumberedEnds connector_ends{ends[1], ends[2], NumbersOfAll(ranks, connectors.destinations, ends[2])};
  return std::visit(
      [&](const auto& at) {
        using Coordinate = typename std::decay_t<decltype(at)>::non_const_value_type;
        const Positions<Coordinate> positions{at, mesh.vertices_in_input()};
        io::Surface surface;
        const auto fill = [&](auto lines) {
          lines.add(descending, falling, descending_along, falling_ends);
          if (top == 2) {
            lines.add(ascending_on_triangles, rising, ascending_on_triangles_along, rising_ends);
          } else {
            lines.add(ascending, rising, ascending_along, rising_ends);
          }
          lines.add(connector, connectors, connecting, connector_ends);
          surface = lines.take(field);
        };
        gale::detail::together(ranks, [&] {
          mesh.is_part() ? fill(Lines<Coordinate, GlobalId>(positions, points, cells, paths))
                         : fill(Lines<Coordinate, Id>(positions, points, cells, paths));
        });
        return surface;
      },
      dataset.points);
}

}  // namespace gale::outputs
