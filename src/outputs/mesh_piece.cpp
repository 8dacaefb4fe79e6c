#include <algorithm>

#include <gale/io/dataset.hpp>
#include <gale/outputs/mesh_piece.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

namespace {

/// The tetrahedra whose highest vertices this rank owns: input ids, ascending.
std::vector<Id> tetrahedra_of_piece(const VertexOrder& order) {
  const Mesh& mesh = order.mesh();
  const auto tetrahedra = mesh.encoded().cells;
  const std::uint64_t* const keys = order.keys();
  std::vector<Id> owned;
  for (Id t = 0; t < mesh.cells(); ++t) {
    Id highest = tetrahedra(t, 0);
    for (int corner = 1; corner < 4; ++corner) {
      if (keys[tetrahedra(t, corner)] > keys[highest]) highest = tetrahedra(t, corner);
    }
    if (highest < mesh.owned_vertices()) owned.push_back(mesh.cell_input()(t));
  }
  std::sort(owned.begin(), owned.end());
  return owned;
}

/// Which vertices are in the piece, and where there.
struct VerticesOfPiece {
  std::vector<Id> all;    ///< input ids, ascending
  std::vector<Id> place;  ///< by input id; no_id for one that isn't
};

VerticesOfPiece vertices_of_piece(const Mesh& mesh, const io::Dataset& dataset, const std::vector<Id>& tetrahedra) {
  VerticesOfPiece vertices{{}, std::vector<Id>(mesh.vertices(), no_id)};
  const auto& input = mesh.vertex_input();
  for (Id v = 0; v < mesh.owned_vertices(); ++v) vertices.place[input(v)] = 0;
  for (const Id t : tetrahedra) {
    for (int corner = 0; corner < 4; ++corner) vertices.place[dataset.tetrahedra(t, corner)] = 0;
  }
  for (Id v = 0; v < mesh.vertices(); ++v) {
    if (vertices.place[v] == no_id) continue;
    vertices.place[v] = static_cast<Id>(vertices.all.size());
    vertices.all.push_back(v);
  }
  return vertices;
}

template <class IdOf>
io::PointArray array_of_ids(const char* name, const std::vector<Id>& some, const IdOf& id_of) {
  std::vector<std::int64_t> ids;
  for (const Id i : some) ids.push_back(id_of(i));
  return {name, 1, std::move(ids)};
}

}  // namespace

io::MeshPiece piece_of(const VertexOrder& order, const io::Dataset& dataset, const std::vector<io::PointArray>& more,
                       bool has_ids) {
  const Mesh& mesh = order.mesh();
  const std::vector<Id> tetrahedra = tetrahedra_of_piece(order);
  const VerticesOfPiece vertices = vertices_of_piece(mesh, dataset, tetrahedra);
  io::MeshPiece piece;
  std::visit([&](const auto& all) { piece.mesh.points = detail::points_at(all, vertices.all); }, dataset.points);
  piece.mesh.tetrahedra = decltype(piece.mesh.tetrahedra)("GALE::piece_tetrahedra", tetrahedra.size());
  for (std::size_t i = 0; i < tetrahedra.size(); ++i) {
    for (int corner = 0; corner < 4; ++corner)
      piece.mesh.tetrahedra(i, corner) = vertices.place[dataset.tetrahedra(tetrahedra[i], corner)];
  }
  auto& arrays = piece.mesh.arrays;
  for (const io::PointArray& array : dataset.arrays) arrays.push_back(io::gather(array, vertices.all));
  for (const io::PointArray& array : more) arrays.push_back(io::gather(array, vertices.all));
  std::vector<std::uint8_t> ghosts;
  for (const Id v : vertices.all) ghosts.push_back(mesh.vertex_internal()(v) >= mesh.owned_vertices());
  arrays.push_back({"vtkGhostType", 1, std::move(ghosts)});
  if (!has_ids) {
    arrays.push_back(array_of_ids(io::global_point_ids, vertices.all, [&](Id v) { return mesh.vertex_id(v); }));
  }
  for (const io::PointArray& array : dataset.cell_arrays) piece.cell_arrays.push_back(io::gather(array, tetrahedra));
  if (piece.cell_arrays.empty()) {
    piece.cell_arrays.push_back(array_of_ids(io::global_cell_ids, tetrahedra, [&](Id t) { return mesh.cell_id(t); }));
  }
  return piece;
}

}  // namespace gale::outputs
