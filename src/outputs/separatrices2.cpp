#include <algorithm>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/stop.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>
#include <gale/mesh/positions.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/separatrices2.hpp>
#include <gale/outputs/separatrix_arrays.hpp>
#include <gale/outputs/separatrix_ends.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

namespace {

using detail::End, detail::Height, detail::NumbersOfAll;

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

/// A critical triangle that bounds the ascending wall of a critical edge, perhaps another rank's.
struct MetTriangle {
  GlobalId edge;  ///< its CellId
  End triangle;   ///< its height as all ranks compare it
};

/// What bounds walls, and their numbers. Collective.
struct Bounds {
  Bounds(const MorseSmaleComplex& complex, const io::PointArray& field,
         const Separatrices<TriangleVertices>& connectors, const KnownSimplices& critical)
      : ranks(complex.gradient.mesh().exchange().ranks()),
        ends(ends_of_all(ranks, complex, field, critical)),
        falling(ranks, complex.descending_walls.sources, ends[2]),
        rising(ranks, complex.ascending_walls.walls.sources, ends[1]) {
    const auto count = static_cast<Offset>(connectors.sources.size());
    Array<GlobalId, HostMemory> highest;  // of the edges
    gale::detail::together(ranks, [&] {
      of_triangles.resize(ends[2].size());
      of_edges.resize(ends[1].size());
      highest = allocate<Array<GlobalId, HostMemory>>("GALE::bounded_edges", count);
      for (Offset i = 0; i < count; ++i) {
        of_triangles[connectors.destinations[i]].push_back(ends[1][connectors.sources[i]]);
        highest(i) = ends[1][connectors.sources[i]].highest.vertex;
      }
    });
    // Who owns an edge has its wall, and is told its triangles.
    const std::vector<std::uint64_t> heights = heights_on_ranks(ranks, complex);
    const auto owners = complex.gradient.mesh().exchange().owners_of(highest);
    gale::detail::together(ranks, [&] {
      for (Offset i = 0; i < count; ++i)
        if (owners(i) < 0) throw Error("no rank has vertex " + std::to_string(highest(i)));
    });
    const auto received = gale::detail::exchange(
        ranks, "GALE::met_triangles",
        gale::detail::collect_by_rank<MetTriangle>(
            ranks, "GALE::told_triangles", count,
            [&](Id i) { return complex.owns(1, connectors.sources[i]) ? ranks.rank() : owners(i); },
            [&](Id i) {
              const Id triangle = connectors.destinations[i];
              MetTriangle met{ends[1][connectors.sources[i]].cell, ends[2][triangle]};
              if (!heights.empty()) met.triangle.highest.key = heights[critical[2][triangle].highest()];
              return met;
            }));
    gale::detail::together(ranks, [&] {
      const auto is_before = [](const End& edge, GlobalId cell) { return edge.cell < cell; };
      for (Offset i = 0; i < received.count(); ++i) {
        const MetTriangle& met = received.entries(i);
        const auto edge = std::lower_bound(ends[1].begin(), ends[1].end(), met.edge, is_before);
        if (edge == ends[1].end() || edge->cell != met.edge)
          throw Error("the wall of edge " + std::to_string(met.edge) + " isn't this rank's");
        of_edges[edge - ends[1].begin()].push_back(met.triangle);
      }
    });
  }

  const Ranks& ranks;
  const std::array<std::vector<End>, 3> ends;
  const NumbersOfAll falling, rising;
  std::vector<std::vector<End>> of_triangles, of_edges;  ///< by place: the critical simplices that bound the wall

 private:
  static std::array<std::vector<End>, 3> ends_of_all(const Ranks& ranks, const MorseSmaleComplex& complex,
                                                     const io::PointArray& field, const KnownSimplices& critical) {
    std::array<std::vector<End>, 3> all;
    gale::detail::together(ranks, [&] {
      for (const int dimension : {1, 2})
        all[dimension] = detail::ends_of(critical[dimension], field, complex.excerpt.order());
    });
    return all;
  }

  /// Keys of the excerpt's vertices that compare on all ranks, but for ties; nothing on one rank.
  static std::vector<std::uint64_t> heights_on_ranks(const Ranks& ranks, const MorseSmaleComplex& complex) {
    std::vector<std::uint64_t> here, there;
    if (ranks.size() == 1) return there;
    const Mesh& mesh = complex.gradient.mesh();
    gale::detail::together(ranks, [&] {
      const OtherIds internal = mesh.vertices_of_input();
      for (Id v = 0; v < mesh.vertices(); ++v) here.push_back(complex.gradient.order().value_key(internal[v]));
      there.resize(complex.excerpt.mesh().vertices());
    });
    gale::detail::plan_to(complex.excerpt.mesh(), mesh)(ranks, here.data(), there.data());
    return there;
  }
};

template <class Number>
class Walls {
 public:
  Walls(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex, const Bounds& bounds)
      : dataset_(dataset),
        complex_(complex),
        bounds_(bounds),
        mesh_(complex.excerpt.mesh()),
        vertex_input_(mesh_.vertices_in_input()),
        cell_input_(mesh_.cells_in_input()),
        vertices_(mesh_.vertices()),
        tetrahedra_(mesh_.cells()),
        field_(field) {}

  io::Surface collect() {
    number_points();
    add_descending();
    add_ascending();
    require_ids("polygons of 2-separatrices", surface_.polygons.begin.size());
    detail::SeparatrixArrays<Number> arrays(walls_.empty() ? 0 : walls_.back().end);
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      gale::detail::stop_if_asked_at(static_cast<Offset>(i));
      arrays.set(i == 0 ? 0 : walls_[i - 1].end, walls_[i]);
    }
    surface_.cell_arrays = arrays.take(field_, false);
    return std::move(surface_);
  }

 private:
  Height height(Id vertex) const { return detail::height_of(complex_.excerpt.order(), field_, vertex_input_[vertex]); }

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
    for (Id i = 0; i < walls.count(); ++i) {
      const End& source = bounds_.ends[2][walls.sources[i]];
      const std::vector<End>& met = bounds_.of_triangles[walls.sources[i]];
      gale::detail::stop_if_asked();
      Height low = met.empty() ? source.lowest : met.front().lowest;
      for (auto triangle = walls.first(i); triangle != walls.last(i); ++triangle) {
        for (const Id vertex : *triangle) {
          if (met.empty()) low = std::min(low, height(vertex));
          surface_.polygons.points.push_back(vertices_[vertex_input_[vertex]]);
        }
        end_polygon();
      }
      for (const End& edge : met) low = std::min(low, edge.lowest);
      end_wall(descending_wall, source, bounds_.falling[i], source.highest, low, met);
    }
  }

  /// An ascending wall reaches from its source's lowest vertex up to the highest one of the critical triangles that
  /// bound it, or of its own edges where none does.
  void add_ascending() {
    const auto& walls = complex_.ascending_walls.walls;
    for (Id i = 0; i < walls.count(); ++i) {
      const End& source = bounds_.ends[1][walls.sources[i]];
      const std::vector<End>& met = bounds_.of_edges[walls.sources[i]];
      gale::detail::stop_if_asked();
      Height high = met.empty() ? source.highest : met.front().highest;
      for (Offset edge = walls.begin[i]; edge < walls.begin[i + 1]; ++edge) {
        if (met.empty()) high = std::max(high, height(walls.cells[edge][0]));
        if (!is_polygon(edge)) continue;
        for_each_in_star(edge, [&](Id t) { surface_.polygons.points.push_back(tetrahedra_[cell_input_[t]]); });
        end_polygon();
      }
      for (const End& triangle : met) high = std::max(high, triangle.highest);
      end_wall(ascending_wall, source, bounds_.falling.count() + bounds_.rising[i], high, source.lowest, met);
    }
  }

  void end_polygon() { surface_.polygons.begin.push_back(static_cast<Offset>(surface_.polygons.points.size())); }

  /// Ends a wall, whose polygons are those that were added last; `met` bound it.
  void end_wall(WallType type, const End& source, GlobalId number, const Height& highest, const Height& lowest,
                const std::vector<End>& met) {
    Id on_surface = source.on_surface;
    for (const End& saddle : met) on_surface += saddle.on_surface;
    walls_.push_back({static_cast<Offset>(surface_.polygons.begin.size()) - 1, static_cast<Number>(source.cell), no_id,
                      static_cast<Number>(number), type, highest.value, lowest.value, on_surface});
  }

  const io::Dataset& dataset_;
  const MorseSmaleComplex& complex_;
  const Bounds& bounds_;
  const Mesh mesh_;
  OtherIds vertex_input_;
  OtherIds cell_input_;
  Numbering vertices_, tetrahedra_;
  io::Surface surface_;
  const io::PointArray& field_;
  std::vector<detail::SeparatrixValues<Number>> walls_;
};

}  // namespace

io::Surface separatrices2(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex,
                          const Separatrices<TriangleVertices>& connectors, const KnownSimplices& critical) {
  const Bounds bounds(complex, field, connectors, critical);
  io::Surface surface;
  gale::detail::together(bounds.ranks, [&] {
    surface = complex.excerpt.mesh().is_part() ? Walls<GlobalId>(dataset, field, complex, bounds).collect()
                                               : Walls<Id>(dataset, field, complex, bounds).collect();
  });
  return surface;
}

}  // namespace gale::outputs
