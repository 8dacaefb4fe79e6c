#include <gale/base/require_ids.hpp>
#include <gale/outputs/positions.hpp>
#include <gale/outputs/separatrices2.hpp>

namespace gale::outputs {

namespace {

enum Type : std::int8_t { ascending = 1, descending = 2 };

/// Numbers those of some simplices that are named, by ascending input id.
class Numbering {
 public:
  explicit Numbering(Id simplices) : numbers_(simplices, no_id) {}

  /// `id` is anything that the caller knows it by.
  void name(Id simplex, Id id) { numbers_[simplex] = id; }

  /// Once all are named: their ids.
  std::vector<Id> number(Id first) {
    std::vector<Id> named;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      if (numbers_[i] == no_id) continue;
      named.push_back(numbers_[i]);
      numbers_[i] = first + static_cast<Id>(named.size()) - 1;
    }
    return named;
  }

  Id operator[](Id simplex) const { return numbers_[simplex]; }

 private:
  std::vector<Id> numbers_;
};

/// For each critical simplex those that its connectors lead to, once each.
std::vector<std::vector<Id>> neighbours(const std::vector<Id>& of, const std::vector<Id>& to, std::size_t count) {
  std::vector<std::vector<Id>> all(count);
  for (std::size_t i = 0; i < of.size(); ++i) all[of[i]].push_back(to[i]);
  for (auto& some : all) {
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
  }
  return all;
}

class Walls {
 public:
  Walls(const io::Dataset& dataset, const MorseSmaleComplex& complex, const Separatrices<TriangleVertices>& connectors,
        const KnownSimplices& critical, const Heights& heights)
      : dataset_(dataset),
        complex_(complex),
        connectors_(connectors),
        mesh_(complex.gradient.mesh()),
        vertex_input_(mesh_.vertex_input().data()),
        tetrahedron_input_(mesh_.tetrahedron_input().data()),
        critical_(critical),
        heights_(heights),
        vertices_(mesh_.vertices()),
        tetrahedra_(mesh_.tetrahedra()) {}

  io::Surface collect() {
    number_points();
    add_descending();
    add_ascending();
    require_ids("polygons of 2-separatrices", surface_.polygons.begin.size());
    surface_.cell_arrays = {{"SourceId", 1, std::move(sources_)},
                            {"SeparatrixId", 1, std::move(ids_)},
                            {"SeparatrixType", 1, std::move(types_)},
                            {"SeparatrixFunctionMaximum", 1, std::move(maxima_)},
                            {"SeparatrixFunctionMinimum", 1, std::move(minima_)},
                            {"SeparatrixFunctionDifference", 1, std::move(differences_)},
                            {"NumberOfCriticalPointsOnBoundary", 1, std::move(on_surface_)}};
    return std::move(surface_);
  }

 private:
  auto is_below() const {
    return [this](Id a, Id b) { return heights_.is_below(a, b); };
  }

  bool is_polygon(Offset edge) const {
    const auto& begin = complex_.ascending_walls.star_begin;
    return begin[edge + 1] - begin[edge] > 2;
  }

  template <class Use>
  void for_each_in_star(Offset edge, const Use& use) const {
    const auto& walls = complex_.ascending_walls;
    for (Offset k = walls.star_begin[edge]; k < walls.star_begin[edge + 1]; ++k) use(walls.star[k]);
  }

  void number_points() {
    for (const auto& triangle : complex_.descending_walls.cells) {
      for (const Id vertex : triangle) vertices_.name(vertex_input_[vertex], vertex_input_[vertex]);
    }
    for (std::size_t edge = 0; edge < complex_.ascending_walls.walls.cells.size(); ++edge) {
      if (is_polygon(edge)) for_each_in_star(edge, [&](Id t) { tetrahedra_.name(tetrahedron_input_[t], t); });
    }
    const std::vector<Id> vertices = vertices_.number(0);
    const std::vector<Id> tetrahedra = tetrahedra_.number(static_cast<Id>(vertices.size()));
    require_ids("points of 2-separatrices", vertices.size() + tetrahedra.size());
    std::visit(
        [&](const auto& points) {
          std::decay_t<decltype(points)> positions("positions", vertices.size() + tetrahedra.size());
          Offset row = 0;
          for (const Id vertex : vertices) store(point_of(points, vertex), positions, row++);
          for (const Id t : tetrahedra) store(barycentre(points, vertices_of(t)), positions, row++);
          surface_.points = positions;
        },
        dataset_.points);
  }

  /// Input vertices of a tetrahedron.
  std::array<Id, 4> vertices_of(Id t) const {
    const auto& all = mesh_.encoded().tetrahedra;
    return {vertex_input_[all(t, 0)], vertex_input_[all(t, 1)], vertex_input_[all(t, 2)], vertex_input_[all(t, 3)]};
  }

  /// From the lowest vertex of the critical edges that a wall meets, or of itself where it meets none, to its source's
  /// highest.
  void add_descending() {
    const auto& walls = complex_.descending_walls;
    const auto met = neighbours(connectors_.destinations, connectors_.sources, critical_[2].size());
    for (Id i = 0; i < walls.count(); ++i) {
      const CriticalSimplex& source = critical_[2][walls.sources[i]];
      std::vector<Id> low;
      for (auto triangle = walls.first(i); triangle != walls.last(i); ++triangle) {
        for (const Id vertex : *triangle) {
          low.push_back(vertex_input_[vertex]);
          surface_.polygons.points.push_back(vertices_[vertex_input_[vertex]]);
        }
        end_polygon();
      }
      const auto& saddles = met[walls.sources[i]];
      if (!saddles.empty()) low.clear();
      for (const Id saddle : saddles) low.push_back(critical_[1][saddle].lowest());
      add_arrays(descending, source, source.highest(), *std::min_element(low.begin(), low.end(), is_below()),
                 critical_[1], saddles);
    }
  }

  /// From its source's lowest vertex to the highest of the critical triangles that a wall meets, or of itself where it
  /// meets none.
  void add_ascending() {
    const auto& walls = complex_.ascending_walls.walls;
    const auto met = neighbours(connectors_.sources, connectors_.destinations, critical_[1].size());
    for (Id i = 0; i < walls.count(); ++i) {
      const CriticalSimplex& source = critical_[1][walls.sources[i]];
      std::vector<Id> high;
      for (Offset edge = walls.begin[i]; edge < walls.begin[i + 1]; ++edge) {
        high.push_back(vertex_input_[walls.cells[edge][0]]);
        if (!is_polygon(edge)) continue;
        for_each_in_star(edge, [&](Id t) { surface_.polygons.points.push_back(tetrahedra_[tetrahedron_input_[t]]); });
        end_polygon();
      }
      const auto& saddles = met[walls.sources[i]];
      if (!saddles.empty()) high.clear();
      for (const Id saddle : saddles) high.push_back(critical_[2][saddle].highest());
      add_arrays(ascending, source, *std::max_element(high.begin(), high.end(), is_below()), source.lowest(),
                 critical_[2], saddles);
    }
  }

  void end_polygon() { surface_.polygons.begin.push_back(static_cast<Offset>(surface_.polygons.points.size())); }

  /// Of a wall's polygons, which have none yet. `met` are the places of the critical simplices that it meets.
  void add_arrays(Type type, const CriticalSimplex& source, Id highest, Id lowest,
                  const std::vector<CriticalSimplex>& critical, const std::vector<Id>& met) {
    const std::size_t polygons = surface_.polygons.begin.size() - 1;
    const double maximum = heights_.value(highest), minimum = heights_.value(lowest);
    Id on_surface = source.on_surface;
    for (const Id saddle : met) on_surface += critical[saddle].on_surface;
    sources_.resize(polygons, source.cell);
    ids_.resize(polygons, next_id_++);
    types_.resize(polygons, type);
    maxima_.resize(polygons, maximum);
    minima_.resize(polygons, minimum);
    differences_.resize(polygons, Heights::difference(maximum, minimum));
    on_surface_.resize(polygons, on_surface);
  }

  const io::Dataset& dataset_;
  const MorseSmaleComplex& complex_;
  const Separatrices<TriangleVertices>& connectors_;
  const Mesh mesh_;
  const Id* vertex_input_;
  const Id* tetrahedron_input_;
  const KnownSimplices& critical_;
  const Heights& heights_;
  Numbering vertices_, tetrahedra_;
  io::Surface surface_;
  Id next_id_ = 0;
  std::vector<Id> sources_, ids_, on_surface_;
  std::vector<std::int8_t> types_;
  std::vector<double> maxima_, minima_, differences_;
};

}  // namespace

io::Surface separatrices2(const io::Dataset& dataset, const MorseSmaleComplex& complex,
                          const Separatrices<TriangleVertices>& connectors, const KnownSimplices& critical,
                          const Heights& heights) {
  return Walls(dataset, complex, connectors, critical, heights).collect();
}

}  // namespace gale::outputs
