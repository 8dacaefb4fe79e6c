#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gale/algorithms/excerpt/reached.hpp>
#include <gale/algorithms/excerpt/vertex_names.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>

namespace gale::detail {

/// The vertices and cells of one rank's part, and those that ways from there reach on other ranks (`reach_beyond`),
/// which come after GALE's own.
class WiderSimplices {
 public:
  WiderSimplices(const DiscreteGradient& gradient, const PathSimplices& cells, const Reached& reached);
  WiderSimplices(const WiderSimplices&) = delete;
  WiderSimplices& operator=(const WiderSimplices&) = delete;

  const Mesh& mesh() const { return mesh_; }

  /// How many there are, the part's and all.
  Id own_vertices() const { return own_vertices_; }
  Id own_cells() const { return own_cells_; }
  Id vertices() const { return own_vertices_ + static_cast<Id>(beyond_.size()); }
  Id cells() const { return own_cells_ + static_cast<Id>(cell_corners_.size()); }
  bool is_own_cell(Id cell) const { return cell < own_cells_; }

  /// What a rank calls by a place in its list.
  Id vertex(int rank, Id place) const { return vertex_of_[vertex_begin_[rank] + place]; }
  Id cell(int rank, Id place) const { return cell_of_[cell_begin_[rank] + place]; }

  /// The order of the part's vertices.
  const VertexOrder& order() const { return order_; }

  /// For each other vertex how many of the part's come before it, by global ids.
  const std::vector<Id>& own_before() const { return own_before_; }

  /// A number for each vertex, dense from 0.
  const VertexNames& names() const { return names_; }

  /// A number for each cell, dense from 0. Own cells' numbers compare as global ids do; others' come after these.
  Id cell_name(Id cell) const { return is_own_cell(cell) ? cell_input_[cell] : cell; }

  /// Global ids.
  GlobalId vertex_id(Id vertex) const;
  GlobalId cell_id(Id cell) const;

  /// What VertexOrder::value_key says of a vertex.
  std::uint64_t value(Id vertex) const;
  bool has_short_values() const { return order_.has_short_values(); }

  /// Reads the corners of cells one after the other: a function of the cell, for one thread.
  auto corners_in_turn() const {
    return [this, own = CellsInTurn(corners_)](Id cell) mutable -> std::array<Id, 4> {
      if (!is_own_cell(cell)) return cell_corners_[cell - own_cells_];
      const Quad quad = own(cell);
      return {quad.a, quad.b, quad.c, quad.d};
    };
  }

 private:
  void number_vertices(const Reached& reached);
  void number_cells(const Reached& reached, const PathSimplices& cells);
  void name_others();

  const Mesh mesh_;
  const VertexOrder order_;
  const Exchange& exchange_;
  const CellReader corners_;
  const OtherIds vertex_input_, cell_input_;
  const Id own_vertices_, own_cells_;
  std::vector<Offset> vertex_begin_, cell_begin_;
  std::vector<Id> vertex_of_, cell_of_;          ///< of what was received
  std::vector<ReceivedVertex> beyond_;           ///< by global id
  std::vector<Id> own_before_;                   ///< of these, see VertexNames
  std::vector<GlobalId> cell_ids_;               ///< of others' cells
  std::vector<std::array<Id, 4>> cell_corners_;  ///< of these
  VertexNames names_;
};

}  // namespace gale::detail
