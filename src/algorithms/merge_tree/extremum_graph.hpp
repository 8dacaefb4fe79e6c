#pragma once

#include <array>
#include <vector>

#include <gale/algorithms/links/large_link.hpp>
#include <gale/algorithms/merge_tree/side_keys.hpp>
#include <gale/base/memory.hpp>
#include <gale/runtime/device_sweep.hpp>
#include <gale/runtime/structure.hpp>

namespace gale::detail {

/// A vertex where components of what is below (above) it may meet, and a vertex of one of them. Once paths were
/// followed, the place of that one's extremum.
struct Meeting {
  Id vertex;
  Id other;
};

/// What one side of an order knows of each vertex by its neighbours. All are GALE's vertices.
template <class Memory>
struct ExtremumGraphSide {
  Array<Id, Memory> next;         ///< of each vertex the neighbour that this side comes to first; -1 if that is itself
  std::vector<Id> extrema;        ///< vertices without `next`, in no order
  std::vector<Meeting> meetings;  ///< of each vertex that has several components of neighbours, one each; in no order
};

template <class Memory>
using ExtremumGraph = std::array<ExtremumGraphSide<Memory>, 2>;

/// What a vertex's neighbours say of it, on both sides.
template <class Word>
struct Sides {
  Word lower = 0;               ///< a bit for each lower neighbour, in VV order
  Id next[2] = {no_id, no_id};  ///< the lowest one, and the highest one
};

template <class Word>
KOKKOS_FORCEINLINE_FUNCTION Sides<Word> sides_of(const std::uint64_t* keys, Id vertex, const Row& neighbours) {
  const std::uint64_t own = keys[vertex];
  std::uint64_t least = own, greatest = own;
  Sides<Word> sides;
  for (Id i = 0; i < neighbours.size(); ++i) {
    const std::uint64_t key = keys[neighbours[i]];
    sides.lower |= Word(key < own) << i;
    if (key < least) {
      least = key;
      sides.next[below] = neighbours[i];
    }
    if (key > greatest) {
      greatest = key;
      sides.next[above] = neighbours[i];
    }
  }
  return sides;
}

/// Finds the graph of single vertices, one after the other. One serves one thread.
class ExtremumFinder {
 public:
  explicit ExtremumFinder(const std::uint64_t* keys) : keys_(keys) {}

  /// Visits a vertex: returns its next vertices, and keeps what else there is to say of it.
  std::array<Id, 2> visit(Id vertex, const Row& neighbours, const LinkRow& link);

  std::array<std::vector<Id>, 2> extrema;
  std::array<std::vector<Meeting>, 2> meetings;

 private:
  std::array<Id, 2> visit_large(Id vertex, const Row& neighbours, const LinkRow& link);

  const std::uint64_t* keys_;
  LargeLink large_;
};

/// Adds the extrema and meetings that they kept.
void add_found(const std::vector<ExtremumFinder>& finders, ExtremumGraph<HostMemory>& graph);

/// Finds it in a sweep of consumers on the host.
ExtremumGraph<HostMemory> extremum_graph(Structure& structure, const std::uint64_t* keys, const SweepOptions& options);

}  // namespace gale::detail
