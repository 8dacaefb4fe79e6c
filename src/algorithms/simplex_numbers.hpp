#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/export.hpp>
#include <gale/runtime/computation.hpp>

namespace gale {

/// Some edges and triangles of a mesh, named by their vertices: GALE's ids, in any order. The same simplex may occur
/// more than once.
struct NamedSimplices {
  std::vector<std::array<Id, 2>> edges;      ///< two vertices each
  std::vector<std::array<Id, 3>> triangles;  ///< three vertices each

  /// On one rank's part of a mesh: what they are named in, if it isn't the part itself; any vertices, with their global
  /// ids, as MorseSmaleComplex::excerpt has them. So any simplex of the whole may be named.
  std::optional<Mesh> excerpt{};
};

/// The numbers by which users know these simplices.
struct SimplexNumbers {
  std::vector<GlobalId> edges;      ///< in the order in which they were asked for
  std::vector<GlobalId> triangles;  ///< in the order in which they were asked for

  /// For each vertex of the mesh, or of the excerpt (GALE's id), 1 if it belongs to a triangle with exactly one
  /// tetrahedron, else 0; of a part's ghosts it says nothing.
  Array<const std::uint8_t, HostMemory> on_surface;
};

/// The place of each named edge (triangle) among all of the mesh, each written with its input vertices ascending, in
/// lexicographic order: what `input_numbers` has for all of them, without enumerating any.
///
/// By threads of the host; of a grid by arithmetic, else with a structure that `computed` has, or is given: the work of
/// a sweep of critical points, and 0.1 us a named simplex, in parallel; 9 bytes a vertex and 16 a named simplex, the
/// result among them. Throws gale::Error, with the input vertices, if the mesh has no such simplex, and if it has more
/// than 2^31 - 1 edges or triangles; and as require_consumers, make_structure and sweeps do.
///
/// On a triangle mesh triangles are cells, whose input ids are their numbers: throws gale::Error where some are named.
///
/// On one rank's part of a mesh these are places among those of all ranks, vertices have their global ids, and there
/// may be more. Collective then: a few rounds of messages, of 16 bytes a vertex and 40 a simplex.
GALE_EXPORT SimplexNumbers number_simplices(const Mesh& mesh, const NamedSimplices& named,
                                            const ComputeOptions& options = {}, Computed* computed = nullptr);

/// Finds them in a sweep of VV and link with a structure of the caller's, which must be preconditioned for these; the
/// same result whatever the structure, its segments, and the number of threads.
GALE_EXPORT SimplexNumbers number_simplices(Structure& structure, const NamedSimplices& named,
                                            const SweepOptions& options = {});

/// What the sweep reads.
inline constexpr RelationSet simplex_numbers_relations = Relation::VV | link_form;

}  // namespace gale
