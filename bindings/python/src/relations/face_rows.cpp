#include "face_rows.hpp"

#include <gale/relations/faces.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/runtime/sweep.hpp>

#include "entries.hpp"

namespace gale::python {

namespace {

/// Writes a row's ids, no two of them alike, in ascending order: each where as many are smaller. No step waits for a
/// branch, nor for ids that were put into memory one by one and are read several at once.
template <int size>
void write_ascending(const FaceRow<size>& row, Id* to) {
  for (int i = 0; i < size; ++i) {
    int smaller = 0;
    for (int k = 0; k < size; ++k) smaller += row.ids[k] < row.ids[i] ? 1 : 0;
    to[smaller] = row.ids[i];
  }
}

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
      ac = detail::find_in(s.edge_high, ac, s.edge_begin(a + 1), c);
      bc = detail::find_in(s.edge_high, bc, s.edge_begin(b + 1), c);
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
void write_rows(const Mesh& mesh, const Simplices<HostMemory>& simplices, const Numbers& numbers, Id* to,
                const SweepOptions& options) {
  constexpr int size = face_count(relation);
  constexpr Id ahead = 32;
  detail::sweep(mesh.owned_segments(), options, [&](int, Id segment) {
    const Intervals all = mesh.intervals_of(segment);
    const Id last = all[row_dimension(relation)].last;
    const auto place_of = [&](Id simplex) { return to + Offset(size) * numbers.rows[simplex]; };
    for_each_row_of<relation>(simplices, all, [&](Id simplex, FaceRow<size> row) {
      if (last - simplex > ahead) __builtin_prefetch(place_of(simplex + ahead), 1);
      for (Id& id : row.ids) id = numbers.entries[id];
      write_ascending(row, place_of(simplex));
    });
  });
}

template <Relation relation>
FaceRows rows_of(const Mesh& mesh, const NumbersOf& numbers_of, const SweepOptions& options) {
  SimplexNeeds needs = needs_of(relation);
  needs.triangle_edge = false;  // since edges are gone through
  const Simplices<HostMemory> simplices = mesh.simplices(needs);
  FaceRows all;
  all.size = face_count(relation);
  all.rows = known_simplices(mesh, row_dimension(relation));
  all.columns = known_simplices(mesh, entry_dimension(relation));
  const Numbers numbers = numbers_of(relation);
  Entries faces(all.size * Offset(all.rows), options.threads);
  write_rows<relation>(mesh, simplices, numbers, faces.ids(), options);
  all.faces = faces.release();
  return all;
}

}  // namespace

FaceRows face_rows(const Mesh& mesh, Relation relation, const NumbersOf& numbers_of, const SweepOptions& options) {
  switch (relation) {
    case Relation::EV:
      return rows_of<Relation::EV>(mesh, numbers_of, options);
    case Relation::FV:
      return rows_of<Relation::FV>(mesh, numbers_of, options);
    case Relation::FE:
      return rows_of<Relation::FE>(mesh, numbers_of, options);
    case Relation::TV:
      return rows_of<Relation::TV>(mesh, numbers_of, options);
    case Relation::TE:
      return rows_of<Relation::TE>(mesh, numbers_of, options);
    default:
      return rows_of<Relation::TF>(mesh, numbers_of, options);
  }
}

}  // namespace gale::python
