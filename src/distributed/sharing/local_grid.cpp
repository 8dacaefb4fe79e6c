#include <algorithm>
#include <string>

#include <gale/base/bits.hpp>
#include <gale/base/error.hpp>
#include <gale/distributed/sharing/local_cells.hpp>
#include <gale/distributed/sharing/local_grid.hpp>

namespace gale::detail {

namespace {

/// The layers that a rank holds, as a grid of their own.
struct Slab {
  const GridLayers& part;
  int axis;       ///< across the layers
  Interval held;  ///< layers

  explicit Slab(const GridLayers& given)
      : part(given),
        axis(given.points[2] == 1 ? 1 : 2),
        held{std::max(given.layers.first - 1, 0), std::min(given.layers.last + 1, given.points[axis])} {}

  std::array<Id, 3> points() const {
    std::array<Id, 3> points = part.points;
    points[axis] = held.size();
    return points;
  }

  Id rows_of_layer() const { return axis == 2 ? part.points[1] : 1; }
  bool is_whole() const { return part.inside.extent(0) == 0; }
  Offset words() const { return static_cast<Offset>(Grid::words_of_row(part.points[0])); }

  /// Vertices of a layer by the bits.
  Offset count(Id layer) const {
    const Offset rows = rows_of_layer();
    if (is_whole()) return rows * part.points[0];
    const Offset first = (layer - held.first) * rows * words();
    return reduce_sum("GALE::count_layer", HostExecutionSpace(), rows * words(),
                      [&](Offset w) { return Offset(count_bits(part.inside(first + w))); });
  }

  /// The first vertex of a layer, and how many cubes of a grid of these layers begin below it.
  Id first_vertex(const Grid& grid, Id layer) const {
    if (layer == held.last) return grid.vertices();
    const Id at = layer - held.first;
    return axis == 2 ? grid.in<HostMemory>().vertex_at(0, 0, at) : grid.in<HostMemory>().vertex_at(0, at, 0);
  }
  Id cubes_before(const Grid& grid, Id layer) const {
    if (layer >= held.last - 1) return grid.cubes();
    const Id at = layer - held.first;
    return axis == 2 ? grid.in<HostMemory>().cubes_before(0, 0, at) : grid.in<HostMemory>().cubes_before(0, at, 0);
  }

  /// Appends the global ids of the vertices that the grid has of a layer, of which `first` is the first that the whole
  /// has there.
  void add_ids(const Grid& grid, Id layer, GlobalId first, std::vector<GlobalId>& ids) const {
    const GridView view = grid.in<HostMemory>();
    const Offset begin = Offset(layer - held.first) * rows_of_layer();
    for (Offset row = begin; row < begin + rows_of_layer(); ++row) {
      for (Id x = 0; x < view.nx; ++x) {
        if (!is_whole() && (part.inside(row * words() + x / 64) >> (x % 64) & 1) == 0) continue;
        if (view.is_whole() || view.vertices.has(row * view.row + x)) ids.push_back(first);
        ++first;
      }
    }
  }
};

/// Throws SharedError unless the ranks hand over layers of one grid, one after the other, all of them. Collective.
void require_all_layers(const Communicator& ranks, const GridLayers& part) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t points = part.points[axis], least = ranks.least(points);
    if (-ranks.least(-points) != least) throw SharedError("ranks hand over layers of grids of different extents");
  }
  const auto [nx, ny, nz] = part.points;
  if (nx < 2 || ny < 2 || nz < 1) {
    throw SharedError("a grid of " + std::to_string(nx) + " x " + std::to_string(ny) + " x " + std::to_string(nz) +
                      " points has no cells");
  }
  const auto first = ranks.all(part.layers.first), last = ranks.all(part.layers.last);
  std::int64_t next = 0;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    if (first[rank] != next || last[rank] < next) {
      throw SharedError("rank " + std::to_string(rank) + " hands over the layers from " + std::to_string(first[rank]) +
                        " to before " + std::to_string(last[rank]) + ", where those from " + std::to_string(next) +
                        " on are next");
    }
    next = last[rank];
  }
  const Id layers = part.points[nz == 1 ? 1 : 2];
  if (next != layers) {
    throw SharedError("ranks hand over " + std::to_string(next) + " layers of a grid of " + std::to_string(layers));
  }
}

/// A grid of the same dimension without vertices.
Grid no_cubes(const Slab& slab) {
  const std::array<Id, 3> points = {2, 2, slab.axis == 2 ? 2 : 1};
  return Grid(points, Array<std::uint64_t, HostMemory>("GALE::no_points", 2 * points[2]));
}

Grid grid_of(const Slab& slab) {
  if (slab.is_whole()) return Grid(slab.points());
  Grid grid(slab.points(), slab.part.inside);
  for (Id layer = slab.part.layers.first; layer < slab.part.layers.last; ++layer) {
    const Offset used = slab.first_vertex(grid, layer + 1) - slab.first_vertex(grid, layer);
    if (used < slab.count(layer)) {
      throw Error("layer " + std::to_string(layer) + " has " + std::to_string(slab.count(layer)) +
                  " vertices, of which cubes of vertices use " + std::to_string(used));
    }
  }
  return grid;
}

}  // namespace

LocalGrid local_grid(const Communicator& ranks, const GridLayers& part, Offset most_local) {
  require_all_layers(ranks, part);
  const Slab slab(part);
  const bool has_layers = part.layers.size() > 0;
  LocalGrid local;
  GlobalId vertices = 0, cubes = 0, cubes_below = 0;  // of layers of its own, and that begin in the layer below
  Offset held_vertices = 0, held_cells = 0;
  const int cells_per_cube = slab.axis == 2 ? tetrahedra_per_cube : 2;
  if (has_layers && slab.is_whole()) {
    const Offset rows = slab.rows_of_layer(), nx = part.points[0];
    held_vertices = rows * nx * slab.held.size();
    held_cells = (slab.axis == 2 ? rows - 1 : 1) * (nx - 1) * (slab.held.size() - 1) * cells_per_cube;
  }
  require_local(ranks, "vertices", held_vertices, most_local);
  require_local(ranks, "cells", held_cells, most_local);
  together(ranks, [&] {
    const Offset words = slab.words() * slab.rows_of_layer() * slab.held.size();
    if (has_layers && !slab.is_whole() && static_cast<Offset>(part.inside.extent(0)) != words) {
      throw Error("layers of a grid have " + std::to_string(part.inside.extent(0)) + " words of bits, not " +
                  std::to_string(words));
    }
    if (!has_layers) {
      local.grid = no_cubes(slab);
      return;
    }
    const Grid grid = grid_of(slab);
    local.owned = {slab.first_vertex(grid, part.layers.first), slab.first_vertex(grid, part.layers.last)};
    vertices = local.owned.size();
    cubes_below = slab.cubes_before(grid, part.layers.first);
    cubes = slab.cubes_before(grid, part.layers.last) - cubes_below;
    held_vertices = grid.vertices();
    held_cells = grid.cells();
    local.grid = vertices > 0 ? grid : no_cubes(slab);
  });
  require_local(ranks, "vertices", held_vertices, most_local);
  require_local(ranks, "cells", held_cells, most_local);
  const GlobalId first = ranks.sum_before(vertices), first_cube = ranks.sum_before(cubes);
  local.all_vertices = ranks.sum(vertices);
  local.all_cells = ranks.sum(cubes) * cells_per_cube;
  if (local.all_cells == 0) throw SharedError("the mesh has no cells");
  local.owned_ids = {first, first + vertices};
  local.first_cell = (first_cube - cubes_below) * cells_per_cube;
  together(ranks, [&] {
    if (vertices == 0) return;
    std::vector<GlobalId> ghosts;
    const Id below = part.layers.first - 1, above = part.layers.last;
    if (below >= 0) slab.add_ids(*local.grid, below, first - slab.count(below), ghosts);
    if (above < part.points[slab.axis]) slab.add_ids(*local.grid, above, first + vertices, ghosts);
    local.ghosts = array_of("GALE::grid_ghosts", ghosts);
  });
  return local;
}

}  // namespace gale::detail
