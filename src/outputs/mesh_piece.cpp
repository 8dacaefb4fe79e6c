#include <algorithm>

#include <gale/io/dataset.hpp>
#include <gale/outputs/mesh_piece.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

namespace {

/// Which cells and vertices are in the piece: input ids, ascending.
struct SimplicesOfPiece {
  std::vector<Id> cells;     ///< cells whose highest vertices this rank owns
  std::vector<Id> vertices;  ///< theirs, and all others that the rank owns
  std::vector<Id> place;     ///< among these, by input id; no_id for one that isn't there
};

SimplicesOfPiece simplices_of_piece(const VertexOrder& order) {
  const Mesh& mesh = order.mesh();
  const CellReader cell = mesh.cell_reader();
  const OtherIds input = mesh.vertices_in_input();
  const std::uint64_t* const keys = order.keys();
  SimplicesOfPiece of_piece{{}, {}, std::vector<Id>(mesh.vertices(), no_id)};
  for (const Id v : mesh.owned_vertices()) of_piece.place[input(v)] = 0;
  for (Id t = 0; t < mesh.cells(); ++t) {
    const Quad corners = cell(t);
    Id highest = corners.a;
    for (int corner = 1; corner < 4; ++corner) {
      if (keys[corners[corner]] > keys[highest]) highest = corners[corner];
    }
    if (!mesh.owned_vertices().has(highest)) continue;
    of_piece.cells.push_back(mesh.cells_in_input()[t]);
    for (int corner = 0; corner < 4; ++corner) of_piece.place[input[corners[corner]]] = 0;
  }
  std::sort(of_piece.cells.begin(), of_piece.cells.end());
  for (Id v = 0; v < mesh.vertices(); ++v) {
    if (of_piece.place[v] == no_id) continue;
    of_piece.place[v] = static_cast<Id>(of_piece.vertices.size());
    of_piece.vertices.push_back(v);
  }
  return of_piece;
}

template <class IdOf>
io::PointArray array_of_ids(const char* name, const std::vector<Id>& some, const IdOf& id_of) {
  std::vector<std::int64_t> ids;
  for (const Id i : some) ids.push_back(id_of(i));
  return {name, 1, std::move(ids)};
}

}  // namespace

io::Dataset piece_of(const VertexOrder& order, const io::Dataset& dataset, const std::vector<io::PointArray>& more,
                     bool has_ids) {
  const Mesh& mesh = order.mesh();
  const SimplicesOfPiece of_piece = simplices_of_piece(order);
  const std::vector<Id>&cells = of_piece.cells, &vertices = of_piece.vertices;
  io::Dataset piece;
  std::visit([&](const auto& all) { piece.points = detail::points_at(all, vertices); }, dataset.points);
  const auto take_cells = [&](const auto& from, auto& to) {
    to = std::decay_t<decltype(to)>("GALE::piece_cells", cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (std::size_t k = 0; k < from.extent(1); ++k) to(i, k) = of_piece.place[from(cells[i], k)];
    }
  };
  mesh.dimension() == 3 ? take_cells(dataset.tetrahedra, piece.tetrahedra)
                        : take_cells(dataset.triangles, piece.triangles);
  auto& arrays = piece.arrays;
  for (const io::PointArray& array : dataset.arrays) arrays.push_back(io::gather(array, vertices));
  for (const io::PointArray& array : more) arrays.push_back(io::gather(array, vertices));
  std::vector<std::uint8_t> ghosts;
  for (const Id v : vertices) ghosts.push_back(!mesh.owned_vertices().has(mesh.vertices_of_input()[v]));
  arrays.push_back({"vtkGhostType", 1, std::move(ghosts)});
  if (!has_ids) {
    arrays.push_back(array_of_ids(io::global_point_ids, vertices, [&](Id v) { return mesh.vertex_id(v); }));
  }
  for (const io::PointArray& array : dataset.cell_arrays) piece.cell_arrays.push_back(io::gather(array, cells));
  if (piece.cell_arrays.empty()) {
    piece.cell_arrays.push_back(array_of_ids(io::global_cell_ids, cells, [&](Id t) { return mesh.cell_id(t); }));
  }
  return piece;
}

}  // namespace gale::outputs
