#pragma once

#include <type_traits>

#include <gale/distributed/mesh_part.hpp>
#include <gale/distributed/sharing/id_interval.hpp>
#include <gale/mesh/encoded_mesh.hpp>

namespace gale::detail {

/// Calls body(corners) with the number of a cell's vertices, 3 or 4, as a constant.
template <class Body>
void with_constant(Offset corners, const Body& body) {
  if (corners == 4) {
    body(std::integral_constant<int, 4>());
  } else {
    body(std::integral_constant<int, 3>());
  }
}

/// Cells of a part by ascending places; all of it where there are no places.
struct SomeCells {
  Offset count = 0;
  Array<Id, HostMemory> places;

  Id operator[](Offset i) const { return places.extent(0) == 0 ? static_cast<Id>(i) : places(i); }
};

/// What one pass over a part's cells yields.
template <class Memory>
struct ReadCells {
  SomeCells outer;  ///< the cells with vertices outside the interval that was given, all where that is empty

  /// All cells where a mesh is made of them, each vertex by its place in the interval, triangles with the third one
  /// twice; outer cells are zeros. Empty where nothing was written.
  Array<const Quad, Memory> rows;
};

/// Reads a part's cells once: finds those with vertices outside `own`, which isn't empty, and meanwhile writes all for
/// `space`. Throws OutOfMemory.
template <class Space, class Index>
ReadCells<MemoryOf<Space>> write_cells(const Space& space, const MeshPart<Index>& part, const IdInterval& own);

/// Finds a part's cells with vertices outside `own`. Where a device will make the mesh, it gets the rows of all if
/// `own` isn't empty and its memory suffices.
template <class Index>
ReadCells<WorkerMemory> read_cells(const MeshPart<Index>& part, const IdInterval& own);

}  // namespace gale::detail
