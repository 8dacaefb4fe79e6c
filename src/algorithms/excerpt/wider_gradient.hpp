#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/reached.hpp>
#include <gale/algorithms/excerpt/wider_simplices.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/wider_successors.hpp>

namespace gale::detail {

/// An edge that another rank has told of, and the third vertex of the triangle that it is paired with, or
/// `edge_is_critical`. Those that nobody has told of are paired with their higher ends.
struct ToldEdge {
  Id high, low, third;
};

/// A gradient of one rank's part, and what ways from there reach on other ranks (`reach_beyond`): what follows them
/// finds what it would find in the whole. Simplices are numbered as WiderSimplices has them. Refers to the gradient.
class WiderGradient {
 public:
  WiderGradient(const DiscreteGradient& gradient, std::shared_ptr<const WiderSimplices> simplices,
                const Reached& reached);
  WiderGradient(const WiderGradient&) = delete;
  WiderGradient& operator=(const WiderGradient&) = delete;

  /// The gradient of the part.
  const DiscreteGradient& part() const { return gradient_; }

  const MoreSuccessors& vertex_successors() const { return vertex_successors_; }
  const MoreSuccessors& cell_successors() const { return cell_successors_; }

  /// The rank's critical simplices and those that were reached, in the order of CriticalSimplices by global ids.
  const CriticalSimplices& critical() const { return critical_; }

  /// Whether each of critical() is the rank's own, by dimension; of triangle meshes nothing for 3.
  const std::array<std::vector<char>, 4>& is_own() const { return is_own_; }

  /// The places there of the rank's own edges.
  const std::vector<Id>& own_edges() const { return own_edges_; }

  /// The edges that were told.
  const std::vector<ToldEdge>& told_edges() const { return told_edges_; }

  /// Which simplices these are.
  const std::shared_ptr<const WiderSimplices>& simplices() const { return simplices_; }

 private:
  void fill_successors(const Reached& reached);
  void add_edges(const Reached& reached);
  void add_critical(const Reached& reached);

  Id vertex(int rank, Id place) const { return simplices_->vertex(rank, place); }
  Id cell(int rank, Id place) const { return simplices_->cell(rank, place); }

  const DiscreteGradient& gradient_;
  const std::shared_ptr<const WiderSimplices> simplices_;
  MoreSuccessors vertex_successors_, cell_successors_;
  std::vector<ToldEdge> told_edges_;
  CriticalSimplices critical_;
  std::array<std::vector<char>, 4> is_own_;
  std::vector<Id> own_edges_;
};

}  // namespace gale::detail
