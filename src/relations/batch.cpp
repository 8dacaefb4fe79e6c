#include <gale/relations/batch.hpp>

namespace gale {

template <class Memory>
IntervalTables<Memory> interval_tables(const Mesh& mesh) {
  IntervalTables<Memory> tables;
  for (int dimension = 0; dimension < 4; ++dimension) {
    const bool enumerated =
        (dimension != 1 || mesh.known_edges() != no_id) && (dimension != 2 || mesh.known_triangles() != no_id);
    if (enumerated) tables.begin[dimension] = mesh.interval_begin<Memory>(dimension).data();
  }
  return tables;
}

#define GALE_INSTANTIATE(Space) \
  template GALE_EXPORT IntervalTables<MemoryOf<Space>> interval_tables<MemoryOf<Space>>(const Mesh&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

void add_rows(const Batch<HostMemory>& batch, Id slot, SegmentRows& rows) {
  for (const Relation relation : members_of(batch.relations)) rows.set(relation, batch.rows(slot, relation));
  if (batch.relations.has_links()) rows.set(batch.links(slot));
}

}  // namespace gale
