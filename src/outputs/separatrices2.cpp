#include <gale/base/error.hpp>
#include <gale/base/stop.hpp>
#include <gale/mesh/positions.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/separatrices2.hpp>
#include <gale/outputs/separatrix_arrays.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

namespace {

enum WallType : std::int8_t { ascending_wall = 1, descending_wall = 2 };

/// Gives numbers to those of a mesh's vertices (tetrahedra) that are used, by ascending input id.
class Numbering {
 public:
  explicit Numbering(Id simplices) : numbers_(simplices, no_id) {}

  /// Says that the one of this input id is used. `id` is anything that the caller knows it by.
  void use(Id input, Id id) { numbers_[input] = id; }

  /// Once all that are used have been named: numbers them from `first` on. Returns what the caller knows each by.
  std::vector<Id> number(Id first) {
    std::vector<Id> used;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      if (numbers_[i] == no_id) continue;
      used.push_back(numbers_[i]);
      numbers_[i] = first + static_cast<Id>(used.size()) - 1;
    }
    return used;
  }

  /// The number of one that is used, by its input id.
  Id operator[](Id input) const { return numbers_[input]; }

 private:
  std::vector<Id> numbers_;
};

/// For each of `count` critical simplices those that connectors join it to, once each, ascending. The i-th connector
/// joins `of[i]` to `to[i]`.
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
  Walls(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex,
        const Separatrices<TriangleVertices>& connectors, const KnownSimplices& critical)
      : dataset_(dataset),
        complex_(complex),
        connectors_(connectors),
        mesh_(complex.excerpt.mesh()),
        vertex_input_(mesh_.vertices_in_input()),
        cell_input_(mesh_.cells_in_input()),
        critical_(critical),
        vertex_internal_(mesh_.vertices_of_input()),
        keys_(complex.excerpt.order().keys()),
        vertices_(mesh_.vertices()),
        tetrahedra_(mesh_.cells()),
        field_(field) {}

  io::Surface collect() {
    number_points();
    add_descending();
    add_ascending();
    require_ids("polygons of 2-separatrices", surface_.polygons.begin.size());
    detail::SeparatrixArrays<Id> arrays(walls_.empty() ? 0 : walls_.back().end);
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      gale::detail::stop_if_asked_at(static_cast<Offset>(i));
      arrays.set(i == 0 ? 0 : walls_[i - 1].end, walls_[i]);
    }
    surface_.cell_arrays = arrays.take(field_, false);
    return std::move(surface_);
  }

 private:
  auto is_below() const {
    return [this](Id a, Id b) { return keys_[vertex_internal_[a]] < keys_[vertex_internal_[b]]; };
  }

  /// Whether this cell of the ascending walls, an edge, has a polygon.
  bool is_polygon(Offset edge) const {
    const auto& begin = complex_.ascending_walls.star_begin;
    return begin[edge + 1] - begin[edge] > 2;
  }

  /// Calls use(tetrahedron) for the tetrahedra around such an edge, in their order.
  template <class Use>
  void for_each_in_star(Offset edge, const Use& use) const {
    const auto& walls = complex_.ascending_walls;
    for (Offset k = walls.star_begin[edge]; k < walls.star_begin[edge + 1]; ++k) use(walls.star[k]);
  }

  void number_points() {
    Offset used = 0;
    for (const auto& triangle : complex_.descending_walls.cells) {
      gale::detail::stop_if_asked_at(used++);
      for (const Id vertex : triangle) vertices_.use(vertex_input_[vertex], vertex_input_[vertex]);
    }
    for (std::size_t edge = 0; edge < complex_.ascending_walls.walls.cells.size(); ++edge) {
      gale::detail::stop_if_asked_at(used++);
      if (is_polygon(edge)) for_each_in_star(edge, [&](Id t) { tetrahedra_.use(cell_input_[t], t); });
    }
    const std::vector<Id> vertices = vertices_.number(0);
    const std::vector<Id> tetrahedra = tetrahedra_.number(static_cast<Id>(vertices.size()));
    require_ids("points of 2-separatrices", vertices.size() + tetrahedra.size());
    std::visit(
        [&](const auto& points) {
          std::decay_t<decltype(points)> positions("GALE::walls", vertices.size() + tetrahedra.size());
          Offset row = 0;
          const auto add = [&](const auto& point) {
            gale::detail::stop_if_asked_at(row);
            gale::detail::store(point, positions, row++);
          };
          for (const Id vertex : vertices) add(gale::detail::point_of(points, vertex));
          for (const Id t : tetrahedra)
            add(gale::detail::barycentre(points,
                                         detail::to_input(vertex_input_, detail::corners_of(mesh_.cell_reader(), t))));
          surface_.points = positions;
        },
        dataset_.points);
  }

  /// A descending wall reaches from its source's highest vertex down to the lowest one of the critical edges that bound
  /// it, or of its own vertices where none does.
  void add_descending() {
    const auto& walls = complex_.descending_walls;
    const auto met = neighbours(connectors_.destinations, connectors_.sources, critical_[2].size());
    for (Id i = 0; i < walls.count(); ++i) {
      const CriticalSimplex& source = critical_[2][walls.sources[i]];
      gale::detail::stop_if_asked();
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
      end_wall(descending_wall, source, source.highest(), *std::min_element(low.begin(), low.end(), is_below()),
               critical_[1], saddles);
    }
  }

  /// An ascending wall reaches from its source's lowest vertex up to the highest one of the critical triangles that
  /// bound it, or of its own edges where none does.
  void add_ascending() {
    const auto& walls = complex_.ascending_walls.walls;
    const auto met = neighbours(connectors_.sources, connectors_.destinations, critical_[1].size());
    for (Id i = 0; i < walls.count(); ++i) {
      const CriticalSimplex& source = critical_[1][walls.sources[i]];
      gale::detail::stop_if_asked();
      std::vector<Id> high;
      for (Offset edge = walls.begin[i]; edge < walls.begin[i + 1]; ++edge) {
        high.push_back(vertex_input_[walls.cells[edge][0]]);
        if (!is_polygon(edge)) continue;
        for_each_in_star(edge, [&](Id t) { surface_.polygons.points.push_back(tetrahedra_[cell_input_[t]]); });
        end_polygon();
      }
      const auto& saddles = met[walls.sources[i]];
      if (!saddles.empty()) high.clear();
      for (const Id saddle : saddles) high.push_back(critical_[2][saddle].highest());
      end_wall(ascending_wall, source, *std::max_element(high.begin(), high.end(), is_below()), source.lowest(),
               critical_[2], saddles);
    }
  }

  void end_polygon() { surface_.polygons.begin.push_back(static_cast<Offset>(surface_.polygons.points.size())); }

  /// Ends a wall, whose polygons are those that were added last. `met` are the places in `critical` of the simplices
  /// that bound it.
  void end_wall(WallType type, const CriticalSimplex& source, Id highest, Id lowest,
                const std::vector<CriticalSimplex>& critical, const std::vector<Id>& met) {
    Id on_surface = source.on_surface;
    for (const Id saddle : met) on_surface += critical[saddle].on_surface;
    walls_.push_back({static_cast<Offset>(surface_.polygons.begin.size()) - 1, static_cast<Id>(source.cell), no_id,
                      static_cast<Id>(walls_.size()), type, value_at(field_, highest), value_at(field_, lowest),
                      on_surface});
  }

  const io::Dataset& dataset_;
  const MorseSmaleComplex& complex_;
  const Separatrices<TriangleVertices>& connectors_;
  const Mesh mesh_;
  OtherIds vertex_input_;
  OtherIds cell_input_;
  const KnownSimplices& critical_;
  OtherIds vertex_internal_;
  const std::uint64_t* keys_;
  Numbering vertices_, tetrahedra_;
  io::Surface surface_;
  const io::PointArray& field_;
  std::vector<detail::SeparatrixValues<Id>> walls_;
};

}  // namespace

io::Surface separatrices2(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex,
                          const Separatrices<TriangleVertices>& connectors, const KnownSimplices& critical) {
  return Walls(dataset, field, complex, connectors, critical).collect();
}

}  // namespace gale::outputs
