#pragma once

#include <gale/base/csr.hpp>
#include <gale/mesh/simplices.hpp>

// Edges and triangles in lexicographic order, vertex by vertex: each finds its own, which are those to higher vertices,
// in the cells that have them. Functions throw gale::Error if there are more than 2^31 - 1 simplices, naming their
// number, and OutOfMemory; then the tables are as they were. The last steps are enqueued on the instance of a device,
// as loops are.

namespace gale::detail {

/// The tables of `Simplices` themselves; empty until they are made.
struct SimplexTables {
  Mirrored<Id> edge_begin, edge_low, edge_high;
  Mirrored<Id> triangle_begin, triangle_edge, triangle_apex;
  Mirrored<Id> lower_begin, lower_edges;
  Id longest_list = 0;
};

/// For each vertex the cells of which it is neither the lowest nor the highest, in no order: with those of which it is
/// the lowest, all that its edges and triangles to higher vertices are in.
template <class Memory>
using MiddleStars = Csr<Id, Memory>;

template <class Space>
MiddleStars<MemoryOf<Space>> find_middle_stars(const Space& space, const Simplices<MemoryOf<Space>>& simplices);

/// Makes the tables of edges, and those of triangles if these are wanted, as the host does: each thread finds those of
/// its segments, in these segments' cells, and writes them down as it finds them, into arrays with room for what a
/// manifold has; where that isn't enough, all are found once more. Edges that are there stay.
void enumerate_by_segments(const EncodedMesh<HostMemory>& mesh, const Borrowed<Id, HostMemory>& cell_begin,
                           bool triangles, SimplexTables& tables);

/// Makes edge_begin, edge_low and edge_high as a device does: lanes count the higher ends of a vertex's edges in memory
/// of their own and find them again to write them; where they are too many, they are sorted. `simplices` has the cells.
template <class Space>
void enumerate_edges(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                     const MiddleStars<MemoryOf<Space>>& stars, SimplexTables& tables);

/// Makes lower_begin, lower_edges and longest_list. `simplices` has the edges and cell_begin.
template <class Space>
void sort_edges_by_higher(const Space& space, const Simplices<MemoryOf<Space>>& simplices, SimplexTables& tables);

/// Makes triangle_begin and triangle_apex as a device does. `simplices` has the tetrahedra and edges.
template <class Space>
void enumerate_triangles(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                         const MiddleStars<MemoryOf<Space>>& stars, SimplexTables& tables);

/// Makes triangle_begin and triangle_apex of triangles that are the mesh's cells. `simplices` has these and the edges.
template <class Space>
void find_triangles_of_edges(const Space& space, const Simplices<MemoryOf<Space>>& simplices, SimplexTables& tables);

/// Makes of how many entries each row has where they begin, in the same memory, and room for the entries. `name` says
/// what these are, e.g. "edges". The last place of `count` is for the end.
template <class Space>
Csr<Id, MemoryOf<Space>, Id> rows_with(const Space& space, const std::string& name,
                                       const Array<Id, MemoryOf<Space>>& count);

/// The row of each entry, where rows begin at `begin`: e.g. edge_low from edge_begin.
template <class Space>
Array<Id, MemoryOf<Space>> row_of_entries(const Space& space, const char* label,
                                          const Borrowed<Id, MemoryOf<Space>>& begin, Offset entries);

/// How many entries the longest row has.
template <class Space>
Id longest_row(const Space& space, const Borrowed<Id, MemoryOf<Space>>& begin);

}  // namespace gale::detail
