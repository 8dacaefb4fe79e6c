#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include <gale/algorithms/numbers/numbering.hpp>
#include <gale/base/bits.hpp>
#include <gale/base/error.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/grid.hpp>

namespace gale::detail {

namespace {

constexpr int later_directions = grid_directions / 2;  ///< the others lead to vertices with lower ids

/// The edges and triangles that a vertex is the first one of, where its star is of a kind.
struct LaterKind {
  static constexpr std::uint8_t none = 255;

  std::uint8_t edges = 0, triangles = 0;  ///< how many there are
  std::uint8_t is_open = 0;

  /// The place of the edge in a later direction, and of the triangle between two, the first one lower; none where there
  /// isn't any.
  std::array<std::uint8_t, later_directions> edge{};
  std::array<std::array<std::uint8_t, later_directions>, later_directions> triangle{};

  LaterKind() = default;
  explicit LaterKind(const StarKind& kind) : is_open(kind.is_open) {
    edge.fill(none);
    for (auto& row : triangle) row.fill(none);
    const auto leads = [](std::uint32_t directions, int later) {
      return (directions >> (later_directions + later) & 1) != 0;
    };
    for (int one = 0; one < later_directions; ++one) {
      if (!leads(kind.directions, one)) continue;
      edge[one] = edges++;
      for (int other = one + 1; other < later_directions; ++other) {
        if (leads(kind.touching[later_directions + one], other)) triangle[one][other] = triangles++;
      }
    }
  }
};

/// Where the vertices of a grid are, and which later direction leads from one to another.
class Directions {
 public:
  Directions(const GridView& grid, Id vertices) : grid_(grid) {
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (std::uint64_t(grid.nx) * std::uint64_t(grid.ny) > most)
      throw Error("a layer of " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) +
                  " points is too large to number a grid's simplices: " + std::to_string(most) + " is the most");
    const std::uint32_t y = grid.nx, z = y * grid.ny;
    find_slots({1, y, y + 1, z, z + 1, z + y, z + y + 1});
    if (!grid.is_whole()) places_ = allocate<Array<std::uint32_t, HostMemory>>("GALE::places_of_vertices", vertices);
  }

  /// To be called once for each vertex.
  void find_place(Id vertex) const {
    if (grid_.is_whole()) return;
    const GridPlace at = grid_.place_of_vertex(vertex);
    places_(vertex) = at.x + std::uint32_t(grid_.nx) * (at.y + std::uint32_t(grid_.ny) * at.z);
  }

  /// Prefetches what `between` reads of a vertex.
  void prefetch(Id vertex) const {
    if (!grid_.is_whole()) __builtin_prefetch(places_.data() + vertex);
  }

  /// The direction that leads from one vertex to a later one; `later_directions` if none does.
  int between(Id from, Id to) const {
    const std::uint32_t step = grid_.is_whole() ? to - from : places_(to) - places_(from);
    const GridStep& found = slots_[slot_of(step)];
    return found.length == step ? found.direction : later_directions;
  }

 private:
  static constexpr int slot_bits = 4;

  /// How much further on the vertex in a direction is.
  struct GridStep {
    std::uint32_t length = 0;
    int direction = later_directions;
  };

  std::uint32_t slot_of(std::uint32_t step) const { return step * factor_ >> (32 - slot_bits); }

  /// Finds a factor that gives each step a slot of its own; of two directions with one step the first has it. Tries all
  /// odd factors: a few will do.
  void find_slots(const std::array<std::uint32_t, later_directions>& steps) {
    for (bool are_apart = false; !are_apart;) {
      factor_ = factor_ * 0x9e3779b1u + 2;
      slots_.fill({});
      are_apart = true;
      for (int direction = 0; direction < later_directions; ++direction) {
        GridStep& slot = slots_[slot_of(steps[direction])];
        const bool is_free = slot.direction == later_directions;
        are_apart = are_apart && (is_free || slot.length == steps[direction]);
        if (is_free) slot = {steps[direction], direction};
      }
    }
  }

  const GridView grid_;
  std::uint32_t factor_ = 1;
  std::array<GridStep, 1 << slot_bits> slots_;
  Array<std::uint32_t, HostMemory> places_;  ///< x fastest; of a whole grid they are the ids
};

/// A simplex's vertices, ascending. Throws gale::Error for a vertex that the mesh doesn't have.
template <std::size_t N>
std::array<Id, N> vertices_of(const Mesh& mesh, const std::array<Id, N>& simplex) {
  require_vertices(mesh, simplex);
  return ascending(simplex);
}

using Counts = Array<Id, HostMemory>;

}  // namespace

SimplexNumbers number_on_grid(const Mesh& mesh, const NamedSimplices& named) {
  const GridView grid = mesh.grid()->in<HostMemory>();
  std::array<LaterKind, grid_kinds> kinds;
  for (int kind = 0; kind < grid_kinds; ++kind) kinds[kind] = LaterKind(mesh.grid()->kinds_in<HostMemory>()[kind]);
  const auto first_edge = allocate<Counts>("GALE::first_edges", mesh.vertices() + 1),
             first_triangle = allocate<Counts>("GALE::first_triangles", mesh.vertices() + 1);
  const auto kind_of = allocate<Array<std::uint8_t, HostMemory>>("GALE::star_kinds", mesh.vertices()),
             on_surface = allocate<Array<std::uint8_t, HostMemory>>("GALE::on_surface", mesh.vertices());
  const Directions directions(grid, mesh.vertices());
  const Id* const begin = mesh.vertex_begin().data();
  parallel_for("GALE::count_simplices", HostExecutionSpace(), mesh.segments(), [&](Offset segment) {
    GridCursor at(grid);
    for (Id v = begin[segment]; v < begin[segment + 1]; ++v) {
      at.go_to(v);
      directions.find_place(v);
      const LaterKind& kind = kinds[at.kind()];
      kind_of(v) = static_cast<std::uint8_t>(at.kind());
      on_surface(v) = kind.is_open;
      first_edge(v) = kind.edges;
      first_triangle(v) = kind.triangles;
    }
  });
  number_first_simplices("edges", first_edge);
  number_first_simplices("triangles", first_triangle);

  SimplexNumbers numbers{{}, {}, on_surface};
  side_by_side([&] { numbers.triangles.resize(named.triangles.size()); },
               [&] { numbers.edges.resize(named.edges.size()); });
  const auto prefetch = [&](const auto& simplices, const Counts& first, Offset i) {
    constexpr Offset ahead = 16;
    if (static_cast<Offset>(simplices.size()) - i <= ahead) return;
    const auto& later = simplices[i + ahead];
    const auto [lowest, highest] = std::minmax_element(later.begin(), later.end());
    if (*lowest < 0 || *highest >= mesh.vertices()) return;  // to be refused in its turn
    __builtin_prefetch(kind_of.data() + *lowest);
    __builtin_prefetch(first.data() + *lowest);
    for (const Id vertex : later) directions.prefetch(vertex);
  };
  parallel_for("GALE::number_edges", HostExecutionSpace(), named.edges.size(), [&](Offset i) {
    prefetch(named.edges, first_edge, i);
    const auto edge = vertices_of(mesh, named.edges[i]);
    const int direction = directions.between(edge[0], edge[1]);
    const LaterKind& kind = kinds[kind_of(edge[0])];
    if (direction == later_directions || kind.edge[direction] == LaterKind::none)
      refuse_simplex(mesh.vertices_in_input(), edge);
    numbers.edges[i] = first_edge(edge[0]) + kind.edge[direction];
  });
  parallel_for("GALE::number_triangles", HostExecutionSpace(), named.triangles.size(), [&](Offset i) {
    prefetch(named.triangles, first_triangle, i);
    const auto triangle = vertices_of(mesh, named.triangles[i]);
    const int one = directions.between(triangle[0], triangle[1]), other = directions.between(triangle[0], triangle[2]);
    const LaterKind& kind = kinds[kind_of(triangle[0])];
    if (one == later_directions || other == later_directions || kind.triangle[one][other] == LaterKind::none)
      refuse_simplex(mesh.vertices_in_input(), triangle);
    numbers.triangles[i] = first_triangle(triangle[0]) + kind.triangle[one][other];
  });
  return numbers;
}

}  // namespace gale::detail
