#pragma once

#include <array>
#include <cstdint>

#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/base/memory.hpp>
#include <gale/mesh/grid/grid_stars.hpp>
#include <gale/mesh/intervals.hpp>

namespace gale::detail {

/// What a vertex and its edges to lower ones are paired with, in a grid that has all its cubes: four bits for each
/// direction of neighbours, and for the vertex. There is the direction of the third vertex of the triangle that an edge
/// is paired with, that of the edge that the vertex is paired with, or one of the two numbers behind directions.
class PairCode {
 public:
  static constexpr int unpaired = 14;   ///< an edge that is paired with no triangle, a vertex with no edge
  static constexpr int not_lower = 15;  ///< the neighbour is higher, or isn't there; a vertex is another rank's
  static constexpr int itself = 14;     ///< where the vertex has its bits, behind those of directions

  PairCode() = default;
  KOKKOS_FUNCTION explicit PairCode(std::uint64_t bits) : bits_(bits) {}

  KOKKOS_FUNCTION std::uint64_t bits() const { return bits_; }
  KOKKOS_FUNCTION int operator[](int direction) const { return static_cast<int>(bits_ >> 4 * direction & 15); }

  /// Sets what was `not_lower`.
  KOKKOS_FUNCTION void set(int direction, int to) { bits_ ^= std::uint64_t(to ^ not_lower) << 4 * direction; }

 private:
  std::uint64_t bits_ = ~std::uint64_t(0);
};

/// Steps from a vertex to its neighbours, by their directions, in a grid that has all its cubes.
struct GridSteps {
  Id step[grid_directions];

  GridSteps() = default;
  explicit GridSteps(const GridView& grid) {
    const Id row = grid.nx, layer = grid.nx * grid.ny;
    const Id all[] = {-layer - row - 1, -layer - row, -layer - 1, -layer,      -row - 1,       -row, -1, 1, row,
                      row + 1,          layer,        layer + 1,  layer + row, layer + row + 1};
    for (int d = 0; d < grid_directions; ++d) step[d] = all[d];
  }

  /// The direction of a step between neighbours; -1 if it is none.
  KOKKOS_FUNCTION int direction(Id between) const {
    for (int d = 0; d < grid_directions; ++d) {
      if (step[d] == between) return d;
    }
    return -1;
  }
};

/// Makes the codes of some vertices of such a grid from their rows, which row_of(vertex) says, an EdgePairRow.
template <class Memory, class RowOf>
struct EncodeRows {
  GridView grid;
  const StarKind* kinds;
  const std::uint64_t* keys;
  const Id* successors;  ///< of vertices
  Interval vertices;
  RowOf row_of;
  Array<std::uint64_t, Memory> codes;  ///< by vertex

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const Id vertex = vertices.first + static_cast<Id>(i);
    GridCursor at(grid);
    at.go_to(vertex);
    const StarKind& kind = kinds[at.kind()];
    const Id successor = successors[vertex];
    int direction[grid_directions];
    int lower = 0, to_successor = PairCode::unpaired;
    for (int k = 0; k < kind.neighbours; ++k) {
      const Id neighbour = at.neighbour(kind.direction[k]);
      if (neighbour == successor) to_successor = kind.direction[k];
      direction[lower] = kind.direction[k];
      lower += keys[neighbour] < keys[vertex];
    }
    PairCode code;
    code.set(PairCode::itself, to_successor);
    const auto row = row_of(vertex);
    for (int k = 0; k < lower; ++k) {
      const Id third = row.place_of_third(k);
      code.set(direction[k], third == no_id ? PairCode::unpaired : direction[third]);
    }
    codes(vertex) = code.bits();
  }
};

/// The codes of a grid that has all its cubes, as the host reads them.
class GridCodes {
 public:
  GridCodes(const GridView& grid, const Array<const std::uint64_t, HostMemory>& codes) : codes_(codes), steps_(grid) {}

  PairCode operator[](Id vertex) const { return PairCode(codes_(vertex)); }
  const std::uint64_t* place(Id vertex) const { return &codes_(vertex); }

  /// What DiscreteGradient::vertex_successor says of a vertex.
  Id successor(Id vertex) const {
    const int direction = (*this)[vertex][PairCode::itself];
    if (direction < PairCode::unpaired) return vertex + step(direction);
    return direction == PairCode::unpaired ? no_id : DiscreteGradient::elsewhere;
  }

  /// From a vertex to its neighbour in a direction.
  Id step(int direction) const { return steps_.step[direction]; }

  /// The direction of a step between neighbours; -1 if it is none.
  int direction(Id step) const { return steps_.direction(step); }

  std::size_t bytes() const { return codes_.extent(0) * sizeof(std::uint64_t); }

 private:
  Array<const std::uint64_t, HostMemory> codes_;  ///< by vertex
  GridSteps steps_;
};

}  // namespace gale::detail
