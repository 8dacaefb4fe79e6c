#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/transfer.hpp>
#include <gale/runtime/explicit/explicit_relations.hpp>

namespace gale::detail {

namespace {

using SimplexIds = Array<Id, WorkerMemory>;
using Keys = Array<std::uint64_t, WorkerMemory>;

/// Which of a cell's vertices, or edges, bound its edges or triangles. A value, so that kernels take it along.
struct CellFaces {
  Id per_cell;
  Id length;
  Id at[6][3];
};

constexpr CellFaces edge_vertices{6, 2, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
constexpr CellFaces edge_vertices_of_triangle{3, 2, {{0, 1}, {0, 2}, {1, 2}}};
constexpr CellFaces triangle_vertices{4, 3, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
constexpr CellFaces triangle_edges{4, 3, {{0, 1, 3}, {0, 2, 4}, {1, 2, 5}, {3, 4, 5}}};

/// The vertices of the edges of a cell of so many corners.
const CellFaces& edge_vertices_of(Id corners) { return corners == 4 ? edge_vertices : edge_vertices_of_triangle; }

/// A key per place: the first of what bounds its simplex by `high`, and the last by `low`.
Keys keys_of(const EvenRows<WorkerMemory>& high_rows, const CellFaces& high, const EvenRows<WorkerMemory>& low_rows,
             const CellFaces& low) {
  const Offset places = Offset(high.per_cell) * high_rows.rows();
  const auto keys = allocate<Keys>("GALE::simplex_keys", places);
  const auto high_ids = high_rows.entries, low_ids = low_rows.entries;
  const Id high_length = high_rows.length, low_length = low_rows.length;
  parallel_for(
      "GALE::simplex_keys", WorkerSpace(), places, KOKKOS_LAMBDA(Offset i) {
        const Offset t = i / high.per_cell;
        const int face = static_cast<int>(i % high.per_cell);
        const auto first = static_cast<std::uint64_t>(high_ids(high_length * t + high.at[face][0]));
        const auto last = static_cast<std::uint64_t>(low_ids(low_length * t + low.at[face][low.length - 1]));
        keys(i) = first << 32 | last;
      });
  return keys;
}

/// before(i): how many different keys there are before the i-th, of keys that ascend. Returns how many there are.
Id count_different(const Keys& keys, const SimplexIds& before) {
  return exclusive_scan(
      "GALE::simplex_numbers", WorkerSpace(), keys.extent(0), before,
      KOKKOS_LAMBDA(Offset i) { return i == 0 || keys(i) != keys(i - 1) ? Id(1) : Id(0); });
}

/// Numbers the simplices by their keys, one a place. Its own copy of `keys` goes as soon as it may.
SortedSimplices number(Keys keys, Id per_cell) {
  const Offset places = keys.extent(0);
  const SimplexIds place = iota("GALE::simplex_places", WorkerSpace(), places);
  stable_sort_by_key(WorkerSpace(), keys, place);
  const auto before = allocate<SimplexIds>("GALE::simplex_numbers", places + 1);
  const Id count = count_different(keys, before);
  keys = Keys();
  const auto simplex = allocate<SimplexIds>("GALE::simplex_of_place", places);
  const auto any_place = allocate<SimplexIds>("GALE::place_of_simplex", count);
  parallel_for(
      "GALE::simplex_of_place", WorkerSpace(), places, KOKKOS_LAMBDA(Offset i) {
        const Id here = before(i + 1) - 1;
        simplex(place(i)) = here;
        if (here == before(i)) any_place(here) = place(i);
      });
  return {{per_cell, simplex}, any_place};
}

}  // namespace

EvenRows<WorkerMemory> cell_vertices(const Mesh& mesh) {
  const Offset rows = mesh.cells();
  const auto cells = mesh.encoded<WorkerMemory>().cells;
  if (mesh.dimension() == 3) return {4, Array<const Id, WorkerMemory>(cells.data(), 4 * rows)};
  const auto ids = allocate<SimplexIds>("GALE::FV", 3 * rows);
  parallel_for(
      "GALE::FV", WorkerSpace(), 3 * rows, KOKKOS_LAMBDA(Offset i) { ids(i) = cells(i / 3, i % 3); });
  return {3, ids};
}

SortedSimplices number_edges(const EvenRows<WorkerMemory>& cell_vertices) {
  const CellFaces& edges = edge_vertices_of(cell_vertices.length);
  require_countable(edges.per_cell == 6 ? Relation::TE : Relation::FE, Offset(edges.per_cell) * cell_vertices.rows());
  return number(keys_of(cell_vertices, edges, cell_vertices, edges), edges.per_cell);
}

SortedSimplices number_triangles(const EvenRows<WorkerMemory>& tv, const EvenRows<WorkerMemory>& te) {
  require_countable(Relation::TF, 4 * Offset(tv.rows()));
  return number(keys_of(te, triangle_edges, tv, triangle_vertices), 4);
}

EvenRows<WorkerMemory> faces(Relation relation, const SortedSimplices& simplices,
                             const EvenRows<WorkerMemory>& of_cells) {
  const CellFaces faces = relation == Relation::EV   ? edge_vertices_of(of_cells.length)
                          : relation == Relation::FV ? triangle_vertices
                                                     : triangle_edges;
  const Offset entries = Offset(faces.length) * simplices.count();
  require_countable(relation, entries);
  const auto ids = allocate<SimplexIds>(label_of(relation), entries);
  const auto any_place = simplices.any_place;
  const auto from = of_cells.entries;
  const Id from_length = of_cells.length;
  parallel_for(
      label_of(relation).c_str(), WorkerSpace(), entries, KOKKOS_LAMBDA(Offset i) {
        const Id place = any_place(i / faces.length);
        const Id corner = faces.at[place % faces.per_cell][i % faces.length];
        ids(i) = from(Offset(from_length) * (place / faces.per_cell) + corner);
      });
  return {faces.length, ids};
}

Array<const Id, HostMemory> segment_begin(const Mesh& mesh, int dimension, const SortedSimplices& simplices) {
  const CellFaces faces = dimension == 1 ? edge_vertices_of(mesh.dimension() + 1) : triangle_vertices;
  const auto begin = allocate<SimplexIds>("GALE::segment_begin", Offset(mesh.segments()) + 1);
  const auto any_place = simplices.any_place;
  const Id count = simplices.count();
  const auto cells = mesh.encoded<WorkerMemory>().cells;
  const auto vertex_begin = mesh.encoded<WorkerMemory>().vertex_begin;
  parallel_for(
      "GALE::segment_begin", WorkerSpace(), Offset(mesh.segments()) + 1, KOKKOS_LAMBDA(Offset s) {
        // The lowest vertices of the simplices ascend: skip those below the segment's.
        begin(s) = bisect(Id(0), count, [&](Id simplex) {
          const Id place = any_place(simplex);
          return cells(place / faces.per_cell, faces.at[place % faces.per_cell][0]) < vertex_begin(s);
        });
      });
  return on_host(begin);
}

}  // namespace gale::detail
