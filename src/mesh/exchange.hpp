#pragma once

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>
#include <gale/mesh/ranks.hpp>

namespace gale {

namespace detail {
class ExchangePlan;
}

/// What a mesh that is one rank's part of a larger one asks of the other ranks: the ids by which all know its
/// simplices, who owns them, and what others know of them. This class is that of a whole mesh, which asks nobody: ids
/// are input ids. A DistributedMesh has one over MPI.
///
/// Vertices and cells of the part are named by local input ids, which ascend with the global ones.
class GALE_EXPORT Exchange {
 public:
  virtual ~Exchange() = default;

  /// The exchange of any whole mesh.
  static const Exchange& of_whole_mesh();

  /// Whether it is that of one rank's part.
  bool is_of_part() const { return this != &of_whole_mesh(); }

  /// The ranks that share the mesh.
  virtual const Ranks& ranks() const { return Ranks::alone(); }

  /// How many vertices all ranks own together; -1 of a whole mesh, which knows by itself.
  virtual GlobalId vertices() const { return -1; }

  /// How many cells there are on all ranks; -1 of a whole mesh.
  virtual GlobalId cells() const { return -1; }

  /// The global id of a vertex.
  virtual GlobalId vertex_id(Id vertex) const { return vertex; }

  /// The global id of a cell.
  virtual GlobalId cell_id(Id cell) const { return cell; }

  /// The vertex that has a global id; no_id if this rank doesn't hold it.
  virtual Id vertex_of(GlobalId id) const { return static_cast<Id>(id); }

  /// The cell that has a global id; no_id if this rank doesn't hold it.
  virtual Id cell_of(GlobalId id) const { return static_cast<Id>(id); }

  /// The rank that owns a vertex of this part.
  virtual int owner(Id) const { return 0; }

  /// The ranks that own any vertices, by their global ids; -1 where nobody does. Collective.
  virtual Array<int, HostMemory> owners_of(const Array<const GlobalId, HostMemory>& ids) const;

  /// How many vertices this rank has handed over, or -1 of a whole mesh: a field has a value for each.
  virtual Offset given_vertices() const { return -1; }

  /// Brings what ranks know of the vertices that they handed over to those who hold them. For GALE's own algorithms.
  virtual const detail::ExchangePlan& from_givers() const;

  /// Brings what ranks know of vertices that they own to those who have them as ghosts. For GALE's own algorithms.
  virtual const detail::ExchangePlan& from_owners() const;
};

}  // namespace gale
