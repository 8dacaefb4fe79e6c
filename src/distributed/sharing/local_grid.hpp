#pragma once

#include <optional>
#include <vector>

#include <gale/distributed/communicator.hpp>
#include <gale/distributed/grid_layers.hpp>
#include <gale/distributed/sharing/id_interval.hpp>
#include <gale/mesh/exchange/global_index.hpp>
#include <gale/mesh/grid.hpp>

namespace gale::detail {

/// What a rank holds of a grid: its layers, and the layers beside them. Local input ids are those of `grid`.
struct LocalGrid {
  std::optional<Grid> grid;  ///< one without vertices where the rank owns none
  Interval owned;            ///< the vertices that it owns, by local ids
  GlobalIds ghosts;          ///< the others by global ids, ascending
  GlobalId first_cell = 0;   ///< the global id of the first cell; the others follow
  GlobalId all_vertices = 0, all_cells = 0;
  std::vector<IdInterval> owned_ids;  ///< the vertices that each rank owns

  /// How many vertices each layer has where all points are vertices: so many before those that a rank owns are its
  /// ghosts, as far as there are any, and so many after them. Else 0.
  Offset whole_layer = 0;
};

/// Collective. Throws gale::Error on all ranks where layers don't fit together, a vertex has no cube, there is no cell,
/// and where one rank would hold more vertices or cells than `most_local`.
LocalGrid local_grid(const Communicator& ranks, const GridLayers& part, Offset most_local);

}  // namespace gale::detail
