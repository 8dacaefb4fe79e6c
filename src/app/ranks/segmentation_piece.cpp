#include <algorithm>

#include <gale/app/ranks/complex_pieces.hpp>
#include <gale/io/dataset.hpp>

namespace gale::app {

namespace {

/// The tetrahedra whose highest vertices this rank owns: local input ids, ascending.
std::vector<Id> owned_tetrahedra(const FieldOnRanks& on) {
  const Mesh& mesh = on.mesh.local();
  const auto tetrahedra = mesh.encoded().tetrahedra;
  const std::uint64_t* const keys = on.order.local().keys();
  std::vector<Id> owned;
  for (Id t = 0; t < mesh.tetrahedra(); ++t) {
    Id highest = tetrahedra(t, 0);
    for (int corner = 1; corner < 4; ++corner) {
      if (keys[tetrahedra(t, corner)] > keys[highest]) highest = tetrahedra(t, corner);
    }
    if (highest < mesh.owned_vertices()) owned.push_back(mesh.tetrahedron_input()(t));
  }
  std::sort(owned.begin(), owned.end());
  return owned;
}

/// Which of the local vertices are in the piece, and where there.
struct Vertices {
  std::vector<Id> all;    ///< local input ids, ascending
  std::vector<Id> place;  ///< by local input id; no_id for one that isn't
};

Vertices vertices_of(const DistributedMesh& distributed, const std::vector<Id>& tetrahedra) {
  const Mesh& mesh = distributed.local();
  Vertices vertices{{}, std::vector<Id>(mesh.vertices(), no_id)};
  const auto& input = mesh.vertex_input();
  for (Id v = 0; v < mesh.owned_vertices(); ++v) vertices.place[input(v)] = 0;
  for (const Id t : tetrahedra) {
    for (int corner = 0; corner < 4; ++corner) vertices.place[distributed.corners()(t, corner)] = 0;
  }
  for (Id v = 0; v < mesh.vertices(); ++v) {
    if (vertices.place[v] == no_id) continue;
    vertices.place[v] = static_cast<Id>(vertices.all.size());
    vertices.all.push_back(v);
  }
  return vertices;
}

io::PointArray ids_of(const char* name, const Array<const GlobalId, HostMemory>& values, const std::vector<Id>& some) {
  std::vector<std::int64_t> ids;
  for (const Id i : some) ids.push_back(values(i));
  return {name, 1, std::move(ids)};
}

}  // namespace

io::MeshPiece segmentation(const FieldOnRanks& on, const DistributedManifolds& manifolds,
                           const MorseSmaleParts& wanted) {
  const std::vector<Id> tetrahedra = owned_tetrahedra(on);
  const Vertices vertices = vertices_of(on.mesh, tetrahedra);
  io::MeshPiece piece;
  std::visit(
      [&](const auto& all) {
        const std::decay_t<decltype(all)> points("GALE::piece_points", vertices.all.size());
        for (std::size_t i = 0; i < vertices.all.size(); ++i) {
          for (int axis = 0; axis < 3; ++axis) points(i, axis) = all(vertices.all[i], axis);
        }
        piece.mesh.points = points;
      },
      on.local.points);
  piece.mesh.tetrahedra = decltype(piece.mesh.tetrahedra)("GALE::piece_tetrahedra", tetrahedra.size());
  for (std::size_t i = 0; i < tetrahedra.size(); ++i) {
    for (int corner = 0; corner < 4; ++corner)
      piece.mesh.tetrahedra(i, corner) = vertices.place[on.mesh.corners()(tetrahedra[i], corner)];
  }
  auto& arrays = piece.mesh.arrays;
  for (const io::PointArray& array : on.local.arrays) arrays.push_back(io::gather(array, vertices.all));
  if (wanted.ascending_manifolds) arrays.push_back(ids_of("AscendingManifold", manifolds.ascending, vertices.all));
  if (wanted.descending_manifolds) arrays.push_back(ids_of("DescendingManifold", manifolds.descending, vertices.all));
  if (wanted.ascending_manifolds && wanted.descending_manifolds)
    arrays.push_back(ids_of("MorseSmaleManifold", manifolds.morse_smale, vertices.all));
  std::vector<std::uint8_t> ghosts;
  for (const Id v : vertices.all) ghosts.push_back(on.mesh.owners()(v) != on.mesh.ranks().rank());
  arrays.push_back({"vtkGhostType", 1, std::move(ghosts)});
  if (!on.has_ids) arrays.push_back(ids_of(io::global_point_ids, on.mesh.vertex_ids(), vertices.all));
  piece.cell_arrays.push_back(ids_of(io::global_cell_ids, on.mesh.tetrahedron_ids(), tetrahedra));
  return piece;
}

}  // namespace gale::app
