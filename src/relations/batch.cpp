#include <gale/relations/batch.hpp>

namespace gale {

IntervalTables<HostMemory> interval_tables(const Mesh& mesh) {
  IntervalTables<HostMemory> tables;
  for (int dimension = 0; dimension < 4; ++dimension) {
    const bool enumerated =
        (dimension != 1 || mesh.known_edges() != no_id) && (dimension != 2 || mesh.known_triangles() != no_id);
    if (enumerated) tables.begin[dimension] = mesh.interval_begin(dimension).data();
  }
  return tables;
}

void add_rows(const Batch<HostMemory>& batch, Id slot, SegmentRows& rows) {
  for (const Relation relation : members_of(batch.relations)) rows.set(relation, batch.rows(slot, relation));
  if (batch.relations.has_links()) rows.set(batch.links(slot));
}

}  // namespace gale
