#pragma once

#include <gale/mesh/simplices.hpp>

namespace gale::detail {

/// The tetrahedra of which a vertex is the second or third: with those of which it is the lowest, all that its edges
/// and triangles to higher vertices are in.
struct MiddleStars {
  Array<Offset, WorkerMemory> begin;   ///< vertices + 1
  Array<Id, WorkerMemory> tetrahedra;  ///< in no order
};

MiddleStars find_middle_stars(const Simplices<WorkerMemory>& simplices);

// Each fills the tables of its name in the workers' space, from those before it. Throws gale::Error if there are more
// than 2^31 - 1 simplices, naming their number.

/// edge_begin, edge_low and edge_high. `simplices` has the tetrahedra.
void enumerate_edges(const Simplices<WorkerMemory>& simplices, const MiddleStars& stars,
                     SimplexTables<WorkerMemory>& tables);

/// triangle_begin, triangle_edge and triangle_apex. `simplices` has the edges too.
void enumerate_triangles(const Simplices<WorkerMemory>& simplices, const MiddleStars& stars,
                         SimplexTables<WorkerMemory>& tables);

/// lower_begin and lower_edges. Likewise.
void sort_edges_by_higher(const Simplices<WorkerMemory>& simplices, SimplexTables<WorkerMemory>& tables);

}  // namespace gale::detail
