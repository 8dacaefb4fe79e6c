#include "face_rows.hpp"

#include <algorithm>

#include <gale/relations/faces.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/runtime/sweep.hpp>

#include "entries.hpp"

namespace gale::python {

namespace {

/// Puts a row in ascending order by exchanging neighbours, every second pair in turn: no step waits for a branch.
template <int size>
void sort_row(FaceRow<size>& row) {
  for (int turn = 0; turn < size; ++turn) {
    for (int i = turn % 2; i + 1 < size; i += 2) {
      const auto [low, high] = std::minmax({row.ids[i], row.ids[i + 1]});
      row.ids[i] = low;
      row.ids[i + 1] = high;
    }
  }
}

/// Writes the rows of a mesh that has the simplices. Where a row goes is fetched some rows before.
template <Relation relation>
void write_rows(const Mesh& mesh, const Simplices<HostMemory>& simplices, const Numbers& numbers, Id* to,
                const SweepOptions& options) {
  constexpr int size = face_count(relation);
  constexpr Id ahead = 32;
  detail::sweep(mesh.owned_segments(), options, [&](int, Id segment) {
    const Interval all = mesh.intervals_of(segment)[row_dimension(relation)];
    const auto place_of = [&](Id simplex) { return to + Offset(size) * numbers.rows[simplex]; };
    for (const Id simplex : all) {
      if (all.last - simplex > ahead) __builtin_prefetch(place_of(simplex + ahead), 1);
      FaceRow<size> row = face_row<relation>(simplices, simplex);
      for (Id& id : row.ids) id = numbers.entries[id];
      sort_row(row);
      std::copy(row.begin(), row.end(), place_of(simplex));
    }
  });
}

template <Relation relation>
FaceRows rows_of(const Mesh& mesh, const NumbersOf& numbers_of, const SweepOptions& options) {
  const Simplices<HostMemory> simplices = mesh.simplices(needs_of(relation));
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
