#pragma once

#include <algorithm>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/base/error.hpp>

namespace gale::detail {

/// An edge as kernels follow it.
struct PairedEdge {
  Offset number;  ///< among all edges
  Id third;       ///< of the triangle that it is paired with, or why there is none: edge_is_critical, edge_has_vertex
};

/// The edges of a gradient that kernels found, for kernels: those whose higher ends this rank owns. Those of a
/// grid that has all its cubes are read from codes, one load each, where there is room for these. Owns nothing.
struct EdgesInKernels {
  const Id* pair_words;
  const Offset* pairs_begin;
  const Id* vertex_successor;
  const std::uint64_t* codes = nullptr;  ///< by vertex
  GridSteps steps{};                     ///< of the grid that has them
  Interval owned;                        ///< vertices
  Offset count;                          ///< numbers of edges are below

  explicit EdgesInKernels(const DiscreteGradient& gradient)
      : pair_words(gradient.store().pair_words().in<WorkerMemory>().data()),
        pairs_begin(gradient.store().pairs_begin().in<WorkerMemory>().data()),
        vertex_successor(gradient.store().vertex_successors().in<WorkerMemory>().data()),
        owned(gradient.mesh().owned_vertices()),
        count(static_cast<Offset>(gradient.store().pair_words().size())) {
    if (!gradient.store().has_codes()) return;
    try {
      codes = gradient.store().codes(true).in<WorkerMemory>().data();
      steps = GridSteps(gradient.mesh().grid()->in<WorkerMemory>());
      count = grid_directions * Offset(gradient.mesh().vertices());
    } catch (const OutOfMemory&) {
      codes = nullptr;
    }
  }

  /// Estimates how many edges walls pass, from how many are numbered: tables that begin smaller grow again and again.
  static Offset usual_passed(Offset numbers) { return std::clamp<Offset>(numbers / 32, few_passed, 1 << 22); }

  /// Suffices for small tables to begin with.
  static constexpr Offset few_passed = 1 << 16;

  /// An edge of an owned vertex to a lower one.
  KOKKOS_FUNCTION PairedEdge operator()(Id high, Id low) const {
    return codes == nullptr ? in_row(high, low) : in_code(high, low);
  }

  // Numbers of a vertex's edges follow one another, if it is an owned one; where they are read from codes there are
  // more of them than edges.

  KOKKOS_FUNCTION Offset first_number(Id high) const {
    return codes == nullptr ? pairs_begin[high] + 1 : grid_directions * Offset(high);
  }
  KOKKOS_FUNCTION int numbers(Id high) const { return codes == nullptr ? row(high).size() : grid_directions; }

  /// The lower end of the edge that has the i-th of these numbers.
  KOKKOS_FUNCTION Id low(Id high, int i) const { return codes == nullptr ? row(high).ids()[i] : high + steps.step[i]; }

 private:
  KOKKOS_FUNCTION EdgePairRow row(Id high) const {
    return EdgePairRow(const_cast<Id*>(pair_words) + pairs_begin[high]);  // nobody writes to it
  }

  /// Reads it from the row of its higher end: its number is the place of the word.
  KOKKOS_FUNCTION PairedEdge in_row(Id high, Id low) const {
    const EdgePairRow all = row(high);
    const Id place = all.find(low), third = all.third(place);
    const Id why_none = vertex_successor[high] == low ? edge_has_vertex : edge_is_critical;
    return {first_number(high) + place, third == no_id ? why_none : third};
  }

  /// Reads it from the code of its higher end: of each vertex there are as many numbers as directions.
  KOKKOS_FUNCTION PairedEdge in_code(Id high, Id low) const {
    const PairCode code(codes[high]);
    const int direction = steps.direction(low - high), to = code[direction];
    const Id why_none = code[PairCode::itself] == direction ? edge_has_vertex : edge_is_critical;
    return {first_number(high) + direction, to < PairCode::unpaired ? high + steps.step[to] : why_none};
  }
};

}  // namespace gale::detail
