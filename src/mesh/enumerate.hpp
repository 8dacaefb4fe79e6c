#pragma once

#include <gale/mesh/simplices.hpp>

namespace gale::detail {

/// The tetrahedra of which a vertex is the second or third: with those of which it is the lowest, all that its edges
/// and triangles to higher vertices are in.
template <class Memory>
struct MiddleStars {
  Array<Offset, Memory> begin;   ///< vertices + 1
  Array<Id, Memory> tetrahedra;  ///< in no order
};

template <class Space>
MiddleStars<MemoryOf<Space>> find_middle_stars(const Space& space, const Simplices<MemoryOf<Space>>& simplices);

// Each fills the tables of its name in a space, from those before it. Throws gale::Error if there are more than
// 2^31 - 1 simplices, naming their number, and OutOfMemory; then the tables are as they were. The last steps are
// enqueued on the instance of a device, as loops are.

/// edge_begin, edge_low and edge_high. `simplices` has the tetrahedra.
template <class Space>
void enumerate_edges(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                     const MiddleStars<MemoryOf<Space>>& stars, SimplexTables& tables);

/// triangle_begin and triangle_apex. `simplices` has the edges too.
template <class Space>
void enumerate_triangles(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                         const MiddleStars<MemoryOf<Space>>& stars, SimplexTables& tables);

/// triangle_edge. `simplices` has the triangles; the edges and tetrahedra it may lack.
template <class Space>
void find_triangle_edges(const Space& space, const Simplices<MemoryOf<Space>>& simplices, SimplexTables& tables);

/// lower_begin and lower_edges. `simplices` has the edges.
template <class Space>
void sort_edges_by_higher(const Space& space, const Simplices<MemoryOf<Space>>& simplices, SimplexTables& tables);

}  // namespace gale::detail
