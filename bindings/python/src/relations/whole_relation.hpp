#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include <gale/mesh/mesh.hpp>
#include <gale/relations/relation.hpp>
#include <gale/runtime/sweep_options.hpp>

namespace gale::python {

/// All rows of a relation, in the numbers of the input.
struct WholeRelation {
  Id rows = 0, columns = 0;               ///< how many simplices have rows, and may be entries
  std::shared_ptr<std::int64_t[]> begin;  ///< where each row begins, and the last one ends
  std::shared_ptr<Id> entries;            ///< ascending in each row
};

/// GALE's id of a simplex -> its number in the input: of a relation's rows and of its entries.
struct Numbers {
  const Id *rows, *entries;
};
using NumbersOf = std::function<Numbers(Relation)>;

/// Computes it: in a sweep where the mesh lies on a device, which does the work then. On the host a relation to faces
/// is looked up in the tables of simplices; one from faces is such a relation the other way round; EE and FF are merged
/// from the rows of each simplex's faces; VV and TT come from a sweep.
WholeRelation whole_relation(const Mesh& mesh, Relation relation, const NumbersOf& numbers_of,
                             const SweepOptions& options);

/// How many simplices of a dimension the mesh has, where these have been enumerated.
Id known_simplices(const Mesh& mesh, int dimension);

}  // namespace gale::python
