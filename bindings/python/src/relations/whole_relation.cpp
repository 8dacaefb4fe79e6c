#include "whole_relation.hpp"

#include <algorithm>

#include <gale/base/parallel.hpp>
#include <gale/runtime/make_structure.hpp>

#include "entries.hpp"
#include "face_rows.hpp"
#include "joined_rows.hpp"
#include "rows_in_slots.hpp"
#include "transposed_rows.hpp"

namespace gale::python {

namespace {

/// The relation from simplices of a dimension to those of a lower one.
Relation to_faces(int dimension, int face_dimension) {
  const auto all = members_of(face_relations);
  return *std::find_if(all.begin(), all.end(), [&](Relation one) {
    return row_dimension(one) == dimension && entry_dimension(one) == face_dimension;
  });
}

WholeRelation with_begins(const FaceRows& faces, int threads) {
  const WholeRelation all = {faces.rows, faces.columns, new_begins(faces.rows + std::size_t(1), threads), faces.faces};
  parallel_for("GALE::row_begin", HostExecutionSpace(), faces.rows + Offset(1),
               [&](Offset i) { all.begin[i] = faces.size * i; });
  return all;
}

}  // namespace

Id known_simplices(const Mesh& mesh, int dimension) {
  const Id counts[] = {mesh.vertices(), mesh.known_edges(), mesh.known_triangles(), mesh.tetrahedra()};
  return counts[dimension];
}

WholeRelation whole_relation(const Mesh& mesh, Relation relation, const NumbersOf& numbers_of,
                             const SweepOptions& options) {
  const int rows = row_dimension(relation), entries = entry_dimension(relation);
  const auto faces = [&](Relation one) { return face_rows(mesh, one, numbers_of, options); };
  if (mesh.on_device() || relation == Relation::VV || relation == Relation::TT) {
    const auto structure = make_structure(mesh, relation);
    return rows_in_slots(*structure, relation, numbers_of(relation), options);
  }
  if (entries < rows) return with_begins(faces(relation), options.threads);
  if (entries > rows) return transposed_rows(faces(to_faces(entries, rows)), options.threads);
  const FaceRows own = faces(to_faces(rows, rows - 1));
  return joined_rows(own, transposed_rows(own, options.threads), options);
}

}  // namespace gale::python
