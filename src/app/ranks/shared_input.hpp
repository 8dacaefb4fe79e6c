#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <gale/app/options.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/distributed/distributed_mesh.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/read.hpp>

namespace gale::app {

/// A part that keeps its cells, which are counted from rank to rank unless they have ids.
template <class PointView, class CellView, class... Ids>
auto part_of(const Array<GlobalId, HostMemory>& vertex_ids, const PointView& points, const CellView& cells,
             const Ids&... cell_ids) {
  auto part = make_part(vertex_ids, points, cells, cell_ids...);
  part.cells = cells;
  return part;
}

/// What one rank has of an input before it is dealt out.
struct SharedInput {
  /// By global ids that fit, or as layers of a grid; keeps its Views.
  std::variant<MeshPart<std::int32_t>, MeshPart<std::int64_t>, GridLayers> part;
  io::PointArray field;                ///< the one to analyse
  io::PointArray order;                ///< what orders the vertices of the part
  std::vector<io::PointArray> arrays;  ///< what these points have; the same arrays on all ranks
  bool has_order = false;              ///< whether `order` is another array than the field; pieces alone say so
  bool has_ids = false;                ///< whether GlobalPointIds of `arrays` are the points' in the input
  bool is_in_float = true;             ///< the input's coordinates
  bool is_dealt_out = false;           ///< the first rank has all
  std::vector<std::string> notices;

  /// The number of the input's cell that each cell of the part is of; none where all ranks' are the input's.
  Array<GlobalId, HostMemory> cells;
};

/// Types, components and names of arrays; and arrays without values, as they were described.
std::string described(const std::vector<io::PointArray>& arrays);
std::vector<io::PointArray> empty_arrays(const std::string& description);

/// Makes this rank's layers of the grid or plane of so many points, for outputs with points and arrays.
SharedInput make_layers(const Ranks& ranks, const InputOptions& input, const std::array<Id, 3>& points,
                        const WantedOfInput& wanted);

/// Deals out the layers of a grid that the first rank has, with the values that `shared` has there and, for outputs,
/// its points; other ranks have no values, but arrays of these types. Collective; throws SharedError.
void deal_layers(const Ranks& ranks, const std::optional<Grid>& grid, const io::Dataset::Positions& points,
                 const WantedOfInput& wanted, SharedInput& shared);

/// Has each rank read some of the pieces of a `.pvtu`, one behind the other, as many as the others. Vertices and
/// cells are numbered as one rank numbers them: in the order of the file's global ids. Without those, cells are
/// counted, and vertices, with a notice, where they occur first: points of equal coordinates are one. Collective;
/// throws SharedError.
SharedInput read_pieces(const Ranks& ranks, const InputOptions& input, const io::PieceNames& pieces);

}  // namespace gale::app
