#pragma once

#include <array>
#include <string>
#include <vector>

#include <gale/distributed/distributed_mesh.hpp>

#include "support/input_mesh.hpp"

namespace gale::test {

/// How vertices are named in tests: by global ids that ascend with the input's, with gaps or without.
struct VertexNames {
  GlobalId first, stride;
};
inline constexpr VertexNames names_with_gaps{5, 3};
inline constexpr VertexNames names_without_gaps{GlobalId(3) << 31, 1};

/// What counts until another is set: part_of sets what its partition wants.
inline VertexNames vertex_names = names_with_gaps;

inline GlobalId vertex_name(Id vertex) { return vertex_names.first + vertex_names.stride * GlobalId(vertex); }
inline GlobalId cell_name(Id cell) { return (GlobalId(1) << 33) + 2 * GlobalId(cell); }
inline Id vertex_named(GlobalId name) { return static_cast<Id>((name - vertex_names.first) / vertex_names.stride); }
inline Id cell_named(GlobalId name) { return static_cast<Id>((name - (GlobalId(1) << 33)) / 2); }

/// The names of the meshes that are cut into parts: `mesh_names()`, then some of `surfaces()`.
const std::vector<std::string>& input_names();

/// One of them. The cells of a surface are its triangles, with the last corner twice.
const InputMesh& input_named(const std::string& name);

/// What one rank hands over of a mesh.
struct GivenPart {
  std::vector<Id> vertices;  ///< of the input, in the order in which they are handed over
  std::vector<GlobalId> vertex_ids;
  std::vector<double> points;
  int corners = 4;              ///< of each cell; 4 where there are none
  std::vector<GlobalId> cells;  ///< their corners
  std::vector<GlobalId> cell_ids;

  void add_vertex(const InputMesh& input, Id vertex);
  void add_cell(const InputMesh& input, Id cell);

  /// Views of this part, which must live as long.
  MeshPart<GlobalId> views() const;

  /// A value for each vertex handed over, of one for each of the input.
  template <class Value>
  Kokkos::View<Value*, HostMemory> values(const std::vector<Value>& all) const {
    const Kokkos::View<Value*, HostMemory> mine("test", vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) mine(i) = all[vertices[i]];
    return mine;
  }
};

/// The ways in which tests cut a mesh into parts: "random", each vertex and each cell anywhere; "blocks", equal numbers
/// of cells, and all their vertices, so that ranks share some; "last", all on the last rank; "shared", all
/// vertices on all ranks; and "curve", "random" to be dealt out again. Without gaps between ids: "overlap", intervals
/// of vertices that have some in common, and "island", those of the first rank amid those of the last.
const std::vector<std::string>& partition_names();

GivenPart part_of(const InputMesh& input, const std::string& partition, const Communicator& ranks);

PartitionOptions options_of(const std::string& partition);

/// That of the whole mesh.
DistributedMesh distribute(const Communicator& ranks, const GivenPart& part, const std::string& partition);

}  // namespace gale::test
