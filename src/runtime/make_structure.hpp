#pragma once

#include <gale/export.hpp>
#include <gale/runtime/structure.hpp>

namespace gale {

/// A structure that computes in the way `options.way` says. Preconditions `mesh` for the relations `wanted`: enumerates
/// edges and triangles as far as these need them, and starts the threads that it needs.
///
/// - `gale`: leaders where the mesh is on a device, helpers elsewhere.
/// - `leaders`: a consumer that finds no block pushes a request on the queue of its relation and waits. The queue's
///   leader takes all that wait, adds the segments that follow each, leaves out what is resident or under way, and
///   launches them as one batch; while that is copied to the host, the next computes. Blocks stay until the host budget
///   needs their place, the longest unread first. In a sweep the leaders run ahead of the consumers as far as the
///   budget goes (the paper's §4).
/// - `helpers`, `inline`: a consumer computes what it misses. In a sweep of fewer consumers than there are cores,
///   helpers on the others compute segments ahead of them; a consumer takes what is ready, computes when nothing is,
///   and waits for nobody.
/// - `explicit`: every row at once. Throws gale::Error where GALE was built without Kokkos-Kernels.
///
/// Where the device lacks memory for any of them, the host computes in the way of helpers, and notices say so.
///
/// Throws gale::Error for no relation at all, for an option below 0, and if there are more than 2^31 - 1 edges or
/// triangles where these are needed.
GALE_EXPORT std::unique_ptr<Structure> make_structure(const Mesh& mesh, RelationSet wanted,
                                                      const StructureOptions& options = {});

}  // namespace gale
