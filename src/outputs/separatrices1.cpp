#include <gale/base/parallel.hpp>
#include <gale/base/require_ids.hpp>
#include <gale/outputs/positions.hpp>
#include <gale/outputs/separatrices1.hpp>

namespace gale::outputs {

namespace {

using HostSpace = Kokkos::DefaultHostExecutionSpace;
using Edge = std::array<Id, 2>;
using Triangle = TriangleVertices;

enum Type : std::int8_t { descending = 0, connector = 1, ascending = 2 };

/// The N vertices that are in both.
template <std::size_t N, class Simplex>
std::array<Id, N> common(const Simplex& a, const Simplex& b) {
  std::array<Id, N> both{};
  std::size_t found = 0;
  for (const Id vertex : a) {
    if (found < N && std::find(b.begin(), b.end(), vertex) != b.end()) both[found++] = vertex;
  }
  return both;
}

std::array<Id, 4> tetrahedron_of(const Mesh& mesh, Id t) {
  const auto& all = mesh.encoded().tetrahedra;
  return {all(t, 0), all(t, 1), all(t, 2), all(t, 3)};
}

/// Appends what precedes each cell of the paths: a saddle, or what the cell shares with the one before.
template <class Cell, class Simplex, class Between>
void append_between(const Separatrices<Cell>& paths, const std::vector<Simplex>& saddles, const Between& between,
                    std::vector<Simplex>& simplices) {
  const std::size_t first = simplices.size();
  simplices.resize(first + paths.cells.size());
  parallel_for("GALE::between_cells", HostSpace(), paths.count(), [&](Offset i) {
    for (Offset k = paths.begin[i]; k < paths.begin[i + 1]; ++k) {
      simplices[first + k] =
          k == paths.begin[i] ? saddles[paths.sources[i]] : between(paths.cells[k - 1], paths.cells[k]);
    }
  });
}

/// The arrays of all lines.
struct LineArrays {
  std::vector<Id> sources, destinations, ids;
  std::vector<std::int8_t> types, on_surface;
  std::vector<double> maxima, minima, differences;

  void resize(Offset lines) {
    for (auto* const array : {&sources, &destinations, &ids}) array->resize(lines);
    for (auto* const array : {&types, &on_surface}) array->resize(lines);
    for (auto* const array : {&maxima, &minima, &differences}) array->resize(lines);
  }

  std::vector<io::PointArray> take() {
    return {{"SourceId", 1, std::move(sources)},
            {"DestinationId", 1, std::move(destinations)},
            {"SeparatrixId", 1, std::move(ids)},
            {"SeparatrixType", 1, std::move(types)},
            {"SeparatrixFunctionMaximum", 1, std::move(maxima)},
            {"SeparatrixFunctionMinimum", 1, std::move(minima)},
            {"SeparatrixFunctionDifference", 1, std::move(differences)},
            {"NumberOfCriticalPointsOnBoundary", 1, std::move(on_surface)}};
  }
};

/// Takes the separatrices of one kind after the other.
template <class Coordinate>
class Lines {
 public:
  Lines(const io::Dataset::Points<Coordinate>& points, const Mesh& mesh, Offset cells, Offset separatrices)
      : input_(mesh.vertex_input().data()), points_(points) {
    require_ids("points of 1-separatrices", 2 * cells);
    positions_ = allocate<io::Dataset::Points<Coordinate>>("GALE::separatrices", 2 * cells);
    for (auto* const array : {&mask_, &dimensions_}) array->resize(2 * cells);
    ids_.resize(2 * cells);
    lines_.begin.resize(2 * cells - separatrices + 1);
    lines_.points.resize(2 * (2 * cells - separatrices));
    arrays_.resize(2 * cells - separatrices);
  }

  /// Two points for each cell of the paths: the simplex `between` that precedes it, number `between_ids[k]`, and
  /// itself. `cell_of(cell)` is its vertices, `id_of(k)` its number.
  template <class Cell, class Simplex, class CellOf, class IdOf>
  void add(Type type, const Separatrices<Cell>& paths, const Simplex* between, const Id* between_ids,
           const CellOf& cell_of, const IdOf& id_of, const std::vector<CriticalSimplex>& sources,
           const std::vector<CriticalSimplex>& destinations, const Heights& heights) {
    parallel_for("GALE::separatrices1", HostSpace(), paths.count(), [&](Offset i) {
      for (Offset k = paths.begin[i]; k < paths.begin[i + 1]; ++k) {
        set_point(2 * k, between[k], between_ids[k], k == paths.begin[i]);
        set_point(2 * k + 1, cell_of(paths.cells[k]), id_of(k), k + 1 == paths.begin[i + 1]);
      }
      set_lines(type, i, 2 * paths.begin[i], 2 * paths.begin[i + 1], sources[paths.sources[i]],
                destinations[paths.destinations[i]], heights);
    });
    first_point_ += 2 * paths.cells.size();
    first_separatrix_ += paths.count();
  }

  io::Surface take() {
    io::Surface surface;
    surface.points = positions_;
    surface.point_arrays = {{"ttkMaskScalarField", 1, std::move(mask_)},
                            {"CellDimension", 1, std::move(dimensions_)},
                            {"CellId", 1, std::move(ids_)}};
    surface.lines = std::move(lines_);
    surface.cell_arrays = arrays_.take();
    return surface;
  }

 private:
  template <std::size_t N>
  void set_point(Offset place, std::array<Id, N> simplex, Id id, bool is_end) {
    place += first_point_;
    for (Id& vertex : simplex) vertex = input_[vertex];
    store(position_of(points_, simplex), positions_, place);
    mask_[place] = is_end ? 0 : 1;
    dimensions_[place] = N - 1;
    ids_[place] = id;
  }

  /// Lines between consecutive ones of the points [begin, end) of the i-th separatrix.
  void set_lines(Type type, Offset i, Offset begin, Offset end, const CriticalSimplex& source,
                 const CriticalSimplex& destination, const Heights& heights) {
    const double maximum = heights.value(heights.higher(source.highest(), destination.highest()));
    const double minimum = heights.value(heights.lower(source.lowest(), destination.lowest()));
    const Id id = static_cast<Id>(first_separatrix_ + i);
    for (Offset point = first_point_ + begin; point + 1 < first_point_ + end; ++point) {
      const Offset line = point - id;
      lines_.begin[line + 1] = 2 * (line + 1);
      lines_.points[2 * line] = static_cast<Id>(point);
      lines_.points[2 * line + 1] = static_cast<Id>(point + 1);
      arrays_.sources[line] = source.cell;
      arrays_.destinations[line] = destination.cell;
      arrays_.ids[line] = id;
      arrays_.types[line] = type;
      arrays_.maxima[line] = maximum;
      arrays_.minima[line] = minimum;
      arrays_.differences[line] = Heights::difference(maximum, minimum);
      arrays_.on_surface[line] = static_cast<std::int8_t>(source.on_surface + destination.on_surface);
    }
  }

  const Id* input_;
  const io::Dataset::Points<Coordinate>& points_;
  io::Dataset::Points<Coordinate> positions_;
  std::vector<std::int8_t> mask_, dimensions_;
  std::vector<Id> ids_;
  io::Surface::Cells lines_;
  LineArrays arrays_;
  Offset first_point_ = 0, first_separatrix_ = 0;
};

}  // namespace

NamedSimplices named_simplices(const MorseSmaleComplex& complex) {
  const Mesh& mesh = complex.gradient.mesh();
  NamedSimplices named = {complex.critical.edges, complex.critical.triangles};
  append_between(
      complex.descending, complex.critical.edges,
      [](Id a, Id b) {
        return Edge{a, b};
      },
      named.edges);
  append_between(complex.connectors, complex.critical.edges, common<2, Triangle>, named.edges);
  const auto shared = [&](Id a, Id b) { return common<3>(tetrahedron_of(mesh, a), tetrahedron_of(mesh, b)); };
  append_between(complex.ascending, complex.critical.triangles, shared, named.triangles);
  named.triangles.insert(named.triangles.end(), complex.connectors.cells.begin(), complex.connectors.cells.end());
  return named;
}

io::Surface separatrices1(const io::Dataset& dataset, const MorseSmaleComplex& complex, const NamedSimplices& named,
                          const SimplexNumbers& numbers, const KnownSimplices& critical, const Heights& heights) {
  const Mesh& mesh = complex.gradient.mesh();
  const auto& descending_paths = complex.descending;
  const auto& ascending_paths = complex.ascending;
  const auto& connectors = complex.connectors;
  const std::size_t edges = critical[1].size(), triangles = critical[2].size();
  const std::size_t connector_edges = edges + descending_paths.cells.size(),
                    connector_triangles = triangles + ascending_paths.cells.size();
  return std::visit(
      [&](const auto& points) {
        using Coordinate = typename std::decay_t<decltype(points)>::non_const_value_type;
        Lines<Coordinate> lines(points, mesh,
                                descending_paths.cells.size() + ascending_paths.cells.size() + connectors.cells.size(),
                                Offset(descending_paths.count()) + ascending_paths.count() + connectors.count());
        lines.add(
            descending, descending_paths, named.edges.data() + edges, numbers.edges.data() + edges,
            [](Id v) { return std::array<Id, 1>{v}; },
            [&](Offset k) { return mesh.vertex_input()(descending_paths.cells[k]); }, critical[1], critical[0],
            heights);
        lines.add(
            ascending, ascending_paths, named.triangles.data() + triangles, numbers.triangles.data() + triangles,
            [&](Id t) { return tetrahedron_of(mesh, t); },
            [&](Offset k) { return mesh.tetrahedron_input()(ascending_paths.cells[k]); }, critical[2], critical[3],
            heights);
        lines.add(
            connector, connectors, named.edges.data() + connector_edges, numbers.edges.data() + connector_edges,
            [](const Triangle& triangle) { return triangle; },
            [&](Offset k) { return numbers.triangles[connector_triangles + k]; }, critical[1], critical[2], heights);
        return lines.take();
      },
      dataset.points);
}

}  // namespace gale::outputs
