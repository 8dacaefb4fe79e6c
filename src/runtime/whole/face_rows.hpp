#pragma once

#include <functional>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/runtime/sweep_options.hpp>
#include <gale/runtime/whole/even_rows.hpp>

namespace gale::detail {

/// What a relation's rows and its entries are called, by GALE's ids.
struct RelationNames {
  const Id *rows, *entries;
};

/// Gives the names of a relation's simplices, when these have been enumerated.
using NamesOf = std::function<RelationNames(Relation)>;

/// How many simplices of a dimension the mesh has.
inline Id count_of(const Mesh& mesh, int dimension) { return mesh.interval_begin(dimension)(mesh.segments()); }

/// A whole relation to faces: looked up in the tables of the mesh's simplices, which it enumerates as far as that
/// takes, and written where it stays.
EvenRows<HostMemory> face_rows(const Mesh& mesh, Relation relation, const NamesOf& names_of,
                               const SweepOptions& options);

}  // namespace gale::detail
