#include <gale/base/memory.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/runtime/sweep.hpp>
#include <gale/runtime/whole/whole_rows.hpp>

namespace gale::detail {

namespace {

/// Calls visit(triangle, its row of FV or FE) for each triangle over an edge. Their apexes ascend, and so do the edges
/// to them.
template <Relation relation, class Visit>
void for_each_triangle_row(const Simplices<HostMemory>& simplices, Id edge, const Visit& visit) {
  const auto& s = simplices;
  const Id a = s.edge_low(edge), b = s.edge_high(edge);
  Id ac = edge, bc = s.edge_begin(b);
  for (Id triangle = s.triangle_begin(edge); triangle < s.triangle_begin(edge + 1); ++triangle) {
    const Id c = s.triangle_apex(triangle);
    if constexpr (relation == Relation::FV) {
      visit(triangle, FaceRow<3>{{a, b, c}});
    } else {
      ac = find_in(s.edge_high, ac, s.edge_begin(a + 1), c);
      bc = find_in(s.edge_high, bc, s.edge_begin(b + 1), c);
      visit(triangle, FaceRow<3>{{edge, ac, bc}});
    }
  }
}

/// Calls visit(simplex, its row) for each of a segment; triangles are gone through edge by edge.
template <Relation relation, class Visit>
void for_each_row_of(const Simplices<HostMemory>& simplices, const Intervals& segment, const Visit& visit) {
  if constexpr (row_dimension(relation) == 2) {
    for (const Id edge : segment[1]) for_each_triangle_row<relation>(simplices, edge, visit);
  } else {
    for (const Id simplex : segment[row_dimension(relation)]) visit(simplex, face_row<relation>(simplices, simplex));
  }
}

/// Writes the rows of a mesh that has the simplices. Where a row goes is fetched some rows before.
template <Relation relation>
void write_rows(const Mesh& mesh, const Simplices<HostMemory>& simplices, const RelationNames& names, Id* to,
                const SweepOptions& options) {
  constexpr int size = face_count(relation);
  constexpr Id ahead = 32;
  sweep(mesh.owned_segments(), options, [&](int, Id segment) {
    const Intervals all = mesh.intervals_of(segment);
    const Id last = all[row_dimension(relation)].last;
    const auto place_of = [&](Id simplex) { return to + Offset(size) * names.rows[simplex]; };
    for_each_row_of<relation>(simplices, all, [&](Id simplex, FaceRow<size> row) {
      if (last - simplex > ahead) __builtin_prefetch(place_of(simplex + ahead), 1);
      for (Id& id : row.ids) id = names.entries[id];
      write_ascending(row, place_of(simplex));
    });
  });
}

template <Relation relation>
EvenRows<HostMemory> rows_of(const Mesh& mesh, const NamesOf& names_of, const SweepOptions& options) {
  SimplexNeeds needs = needs_of(relation);  // triangles by their edges, also where they are cells
  needs.triangle_edge = false;              // since edges are gone through
  const Simplices<HostMemory> simplices = mesh.simplices(needs);
  const RelationNames names = names_of(relation);
  constexpr int size = face_count(relation);
  const auto faces = array_to_write<Id>("GALE::face_rows", size * std::size_t(count_of(mesh, row_dimension(relation))),
                                        options.threads);
  write_rows<relation>(mesh, simplices, names, faces.data(), options);
  return {size, faces};
}

}  // namespace

EvenRows<HostMemory> face_rows(const Mesh& mesh, Relation relation, const NamesOf& names_of,
                               const SweepOptions& options) {
  return with_faces_of(relation, [&](auto known) { return rows_of<decltype(known)::value>(mesh, names_of, options); });
}

}  // namespace gale::detail
