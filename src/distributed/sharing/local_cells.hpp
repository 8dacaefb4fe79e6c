#pragma once

#include <gale/distributed/mesh_part.hpp>
#include <gale/distributed/sharing/cell_places.hpp>
#include <gale/distributed/sharing/outer_cells.hpp>
#include <gale/distributed/sharing/vertex_directory.hpp>

namespace gale::detail {

/// Cells on their way to other ranks, or from these.
template <class Index>
struct SentCells {
  EntriesByRank<GlobalId> ids;
  EntriesByRank<Index> vertices;  ///< as many of each as cells have

  Offset count() const { return ids.entries.extent(0); }
};

/// The cells that touch a vertex which this rank owns: those of its own part where they are, and those that it got.
template <class Index>
class LocalCells {
 public:
  /// Sends each cell to the ranks that own a vertex of it. `own`: ids that this rank owns, as many as are known without
  /// a search: cells of these alone concern no other rank, and the others are the `outer` ones. Collective. Throws
  /// gale::Error as DistributedMesh says. Refers to `part`, whose cells have as many columns on all ranks.
  LocalCells(const Communicator& ranks, const MeshPart<Index>& part, const VertexDirectory& directory,
             const IdInterval& own, const SomeCells& outer, Offset most_local);

  Offset count() const { return places_.count(); }

  /// How many vertices each has.
  int corners() const { return static_cast<int>(part_.cells.extent(1)); }

  /// Their global ids, ascending, and where they come from.
  const CellPlaces& places() const { return places_; }

  /// The global ids of the vertices of cells first..last-1 of all, in order: calls visit(i, corners, count) for some
  /// that follow one another, i to i + count - 1, of which `corners` are.
  template <class Visit>
  void visit(Offset first, Offset last, const Visit& visit) const {
    places_.visit(
        first, last, [&](Offset i, Offset place, Offset count) { visit(i, part_vertices(place), count); },
        [&](Offset i, Offset r) { visit(i, received_vertices(r), Offset(1)); });
  }

  /// The places in the part of those with vertices outside `own` that are kept, ascending.
  const Array<Id, HostMemory>& outer() const { return outer_; }

  /// How many came from other ranks.
  Offset received_count() const { return received_.count(); }

  /// The global ids of the vertices of a cell of the part, by its place, and of a received one.
  const Index* part_vertices(Offset place) const { return part_.cells.data() + corners() * place; }
  const Index* received_vertices(Offset r) const { return received_.vertices.entries.data() + corners() * r; }

  /// Throws gale::Error for one of the part that is none.
  void require_cells() const;

  /// The vertices that they have and that this rank doesn't own, ascending.
  GlobalIds vertices_beside(const OwnedIds& owned) const;

 private:
  KeptCells choose(const Communicator& ranks, const VertexDirectory& directory, const SomeCells& outer,
                   GlobalId first_id, SentCells<Index>& sent);

  const MeshPart<Index>& part_;
  const IdInterval own_;
  Array<Id, HostMemory> outer_;  ///< cells of the part that are kept and have vertices outside `own`
  SentCells<Index> received_;
  CellPlaces places_;
};

/// Throws gale::Error on all ranks if one would hold more than `most` of what `name` says, e.g. "cells": it says how
/// many ranks it takes. Collective.
void require_local(const Communicator& ranks, const char* name, Offset count, Offset most);

/// Throws that error where the greatest count of so many ranks, which all know, is more than `most`.
void require_fits(int ranks, const char* name, Offset greatest, Offset most);

}  // namespace gale::detail
