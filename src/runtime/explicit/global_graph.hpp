#pragma once

#include <string>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/relations/relation.hpp>
#include <gale/relations/rows.hpp>

namespace gale::detail {

/// A relation of the whole mesh in the workers' memory: row i is ids[begin(i)] to ids[begin(i + 1) - 1]. Where all rows
/// are of one length there is no `begin`: 8 bytes a row that only Kokkos-Kernels wants, and then for a while.
struct GlobalGraph {
  using Offsets = Array<Offset, WorkerMemory>;
  using Ids = Array<const Id, WorkerMemory>;

  Id rows = 0;
  Id length = 0;  ///< of each row; 0 if they differ
  Offsets begin;  ///< rows + 1; empty if they don't
  Ids ids;
};

/// A relation of the whole mesh on the host, as it is kept.
struct GlobalRows {
  Array<const Id, HostMemory> offsets;  ///< rows + 1
  Array<const Id, HostMemory> ids;

  Rows rows() const { return {0, static_cast<Id>(offsets.extent(0)) - 1, offsets.data(), ids.data()}; }
};

/// A graph's `begin`, also where all rows are of one length.
GlobalGraph::Offsets row_begin(const GlobalGraph& graph);

/// The graph's rows, copied where the host can't read them.
GlobalRows to_host(const GlobalGraph& graph);

/// "GALE::VV": what kernels and arrays of a relation are called.
std::string label_of(Relation relation);

/// Throws gale::Error, naming both, if a relation's entries are more than an Id counts.
void require_countable(Relation relation, Offset entries);

}  // namespace gale::detail
