#include <algorithm>
#include <array>
#include <string>
#include <vector>

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
      : part(given), axis(given.points[2] == 1 ? 1 : 2), held(held_with(given.layers)) {}

  /// The layers that a rank holds that hands over these.
  Interval held_with(const Interval& layers) const {
    return {std::max(layers.first - 1, 0), std::min(layers.last + 1, part.points[axis])};
  }

  std::array<Id, 3> points() const {
    std::array<Id, 3> points = part.points;
    points[axis] = held.size();
    return points;
  }

  Id rows_of_layer() const { return axis == 2 ? part.points[1] : 1; }
  int cells_per_cube() const { return axis == 2 ? tetrahedra_per_cube : 2; }

  /// Where all points are vertices: those of a layer, and cells between two layers.
  Offset vertices_of_layer() const { return Offset(rows_of_layer()) * part.points[0]; }
  Offset cells_between_layers() const {
    return (axis == 2 ? Offset(rows_of_layer()) - 1 : 1) * (part.points[0] - 1) * cells_per_cube();
  }

  bool is_whole() const { return part.inside.extent(0) == 0; }
  Offset words() const { return static_cast<Offset>(Grid::words_of_row(part.points[0])); }

  /// Vertices of a layer by the bits.
  Offset count(Id layer) const {
    if (is_whole()) return vertices_of_layer();
    const Offset rows = rows_of_layer();
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

/// What each rank hands over.
struct LayersOfRanks {
  std::vector<Interval> layers;
  bool are_whole = true;  ///< whether all points are vertices
};

/// Throws SharedError unless the ranks hand over layers of one grid, one after the other, all of them. Collective.
LayersOfRanks require_all_layers(const Communicator& ranks, const GridLayers& part) {
  const auto [nx, ny, nz] = part.points;
  const auto all = all_numbers(
      ranks, std::array<std::int64_t, 6>{nx, ny, nz, part.layers.first, part.layers.last, part.inside.extent(0) > 0});
  const bool are_of_one = std::all_of(all.begin(), all.end(), [&](const auto& one) {
    return std::equal(one.begin(), one.begin() + 3, all[0].begin());
  });
  if (!are_of_one) throw SharedError("ranks hand over layers of grids of different extents");
  if (nx < 2 || ny < 2 || nz < 1) {
    throw SharedError("a grid of " + std::to_string(nx) + " x " + std::to_string(ny) + " x " + std::to_string(nz) +
                      " points has no cells");
  }
  LayersOfRanks found;
  Id next = 0;
  for (const auto& one : all) {
    const Interval layers{static_cast<Id>(one[3]), static_cast<Id>(one[4])};
    if (layers.first != next || layers.last < next) {
      throw SharedError("rank " + std::to_string(found.layers.size()) + " hands over the layers from " +
                        std::to_string(layers.first) + " to before " + std::to_string(layers.last) +
                        ", where those from " + std::to_string(next) + " on are next");
    }
    next = layers.last;
    found.layers.push_back(layers);
    found.are_whole = found.are_whole && one[5] == 0;
  }
  const Id layers = part.points[nz == 1 ? 1 : 2];
  if (next != layers) {
    throw SharedError("ranks hand over " + std::to_string(next) + " layers of a grid of " + std::to_string(layers));
  }
  return found;
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

/// Where all points are vertices each rank knows by itself what the others hold.
LocalGrid whole_layers(const Communicator& ranks, const GridLayers& part, const std::vector<Interval>& layers,
                       Offset most_local) {
  const Slab slab(part);
  const Offset layer = slab.vertices_of_layer(), cells = slab.cells_between_layers();
  Offset most_layers = 0;
  LocalGrid local;
  for (const Interval& some : layers) {
    if (some.size() > 0) most_layers = std::max<Offset>(most_layers, slab.held_with(some).size());
    local.owned_ids.push_back({some.first * layer, some.last * layer});
  }
  require_fits(ranks.size(), "vertices", most_layers * layer, most_local);
  require_fits(ranks.size(), "cells", (most_layers - 1) * cells, most_local);
  local.all_vertices = part.points[slab.axis] * layer;
  local.all_cells = (part.points[slab.axis] - 1) * cells;
  local.first_cell = slab.held.first * cells;
  local.whole_layer = layer;
  together(ranks, [&] {
    if (part.layers.size() == 0) {
      local.grid = no_cubes(slab);
      return;
    }
    local.grid = Grid(slab.points());
    const auto& [first, end] = local.owned_ids[ranks.rank()];
    const Offset below = (part.layers.first - slab.held.first) * layer, owned = end - first;
    local.owned = {static_cast<Id>(below), static_cast<Id>(below + owned)};
    const GlobalId lowest = first - below;
    local.ghosts = tabulated<GlobalId>("GALE::grid_ghosts", local.grid->vertices() - owned,
                                       [&](Offset i) { return lowest + (i < below ? i : i + owned); });
  });
  return local;
}

}  // namespace

LocalGrid local_grid(const Communicator& ranks, const GridLayers& part, Offset most_local) {
  const LayersOfRanks of_ranks = require_all_layers(ranks, part);
  if (of_ranks.are_whole) return whole_layers(ranks, part, of_ranks.layers, most_local);
  const Slab slab(part);
  const bool has_layers = part.layers.size() > 0;
  LocalGrid local;
  GlobalId vertices = 0, cubes = 0, cubes_below = 0;  // of layers of its own, and that begin in the layer below
  Offset held_vertices = 0, held_cells = 0;
  const int cells_per_cube = slab.cells_per_cube();
  if (has_layers && slab.is_whole()) {
    held_vertices = slab.vertices_of_layer() * slab.held.size();
    held_cells = slab.cells_between_layers() * (slab.held.size() - 1);
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
  GlobalId all_cubes = 0, first_cube = 0;
  for (const auto& [of_rank, cubes_of_rank] : all_numbers(ranks, std::array<std::int64_t, 2>{vertices, cubes})) {
    if (static_cast<int>(local.owned_ids.size()) < ranks.rank()) first_cube += cubes_of_rank;
    local.owned_ids.push_back({local.all_vertices, local.all_vertices + of_rank});
    local.all_vertices += of_rank;
    all_cubes += cubes_of_rank;
  }
  local.all_cells = all_cubes * cells_per_cube;
  if (local.all_cells == 0) throw SharedError("the mesh has no cells");
  local.first_cell = (first_cube - cubes_below) * cells_per_cube;
  together(ranks, [&] {
    if (vertices == 0) return;
    std::vector<GlobalId> ghosts;
    const auto& [first, end] = local.owned_ids[ranks.rank()];
    const Id below = part.layers.first - 1, above = part.layers.last;
    if (below >= 0) slab.add_ids(*local.grid, below, first - slab.count(below), ghosts);
    if (above < part.points[slab.axis]) slab.add_ids(*local.grid, above, end, ghosts);
    local.ghosts = array_of("GALE::grid_ghosts", ghosts);
  });
  return local;
}

}  // namespace gale::detail
