#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/reached.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/descending_wall.hpp>
#include <gale/algorithms/morse_smale/paths_on_ranks.hpp>
#include <gale/algorithms/morse_smale/wider_successors.hpp>

namespace gale::detail {

/// A gradient of one rank's part, and what ways from there reach on other ranks (`reach_beyond`): what follows them
/// finds what it would find in the whole. Vertices and cells of others come after GALE's own. Some 28 bytes a vertex
/// beside the part's. Refers to the gradient.
class WiderGradient {
 public:
  WiderGradient(const DiscreteGradient& gradient, const PathSimplices& cells, Reached reached);

  WallGround ground() const;
  const Array<const Id, HostMemory>& vertex_successors() const { return vertex_successors_; }
  WiderSuccessors cell_successors() const;

  /// The rank's critical simplices and those that were reached, in the order of CriticalSimplices by global ids.
  const CriticalSimplices& critical() const { return critical_; }

  /// Whether each of critical() is the rank's own, by dimension; of triangle meshes nothing for 3.
  const std::array<std::vector<char>, 4>& is_own() const { return is_own_; }

  /// The places there of the rank's own edges.
  const std::vector<Id>& own_edges() const { return own_edges_; }

  Id vertices() const { return static_cast<Id>(names_.extent(0)); }
  Id cells() const { return own_cells_ + static_cast<Id>(cell_corners_.size()); }

  /// A number for each vertex, dense from 0: they compare as global ids do.
  Id name(Id vertex) const { return names_(vertex); }
  const Array<const Id, HostMemory>& names() const { return names_; }

  /// A number for each cell, dense from 0. Own cells' numbers compare as global ids do; others' come after these.
  Id cell_name(Id cell) const { return is_own_cell(cell) ? cell_input_[cell] : cell; }
  bool is_own_cell(Id cell) const { return cell < own_cells_; }

  GlobalId vertex_id(Id vertex) const;
  GlobalId cell_id(Id cell) const;
  std::uint64_t value(Id vertex) const;
  bool has_short_values() const { return gradient_.order().has_short_values(); }

  /// Reads the corners of cells one after the other: a function of the cell, for one thread.
  auto corners_in_turn() const {
    return [this, own = CellsInTurn(corners_)](Id cell) mutable -> std::array<Id, 4> {
      if (!is_own_cell(cell)) return cell_corners_[cell - own_cells_];
      const Quad quad = own(cell);
      return {quad.a, quad.b, quad.c, quad.d};
    };
  }

 private:
  void name_vertices();
  void number(const Reached& reached, const PathSimplices& cells);
  void fill_keys();
  void fill_successors(const Reached& reached);
  void fill_rows(const Reached& reached, const Array<Id, HostMemory>& vertex_successors);
  void add_critical(const Reached& reached);

  /// Calls visit(rank, entry) for all that other ranks have found.
  template <class T, class Visit>
  void for_each(const Dealt<T>& received, const Visit& visit) const;
  Id vertex(int rank, Id place) const { return vertex_of_[vertex_begin_[rank] + place]; }
  Id cell(int rank, Id place) const { return cell_of_[cell_begin_[rank] + place]; }

  const DiscreteGradient& gradient_;
  const Mesh mesh_;
  const Exchange& exchange_;
  const CellReader corners_;
  const OtherIds vertex_input_, cell_input_;
  const Id own_vertices_, own_cells_;
  std::vector<Offset> vertex_begin_, cell_begin_;
  std::vector<Id> vertex_of_, cell_of_;          ///< of what was received
  std::vector<ReachedVertex> beyond_;            ///< by global id
  std::vector<GlobalId> cell_ids_;               ///< of others' cells
  std::vector<std::array<Id, 4>> cell_corners_;  ///< of these
  Array<const Id, HostMemory> names_;
  Array<const std::uint64_t, HostMemory> keys_;
  Array<const Id, HostMemory> vertex_successors_;
  std::vector<std::pair<Id, Id>> steps_of_exits_;  ///< own cells whose successors the part lacks, and these; ascending
  std::vector<Id> steps_beyond_;                   ///< successors of others' cells
  EdgePairs pairs_;
  CriticalSimplices critical_;
  std::array<std::vector<char>, 4> is_own_;
  std::vector<Id> own_edges_;
};

}  // namespace gale::detail
