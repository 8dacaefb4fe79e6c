#include <gale/base/group_by.hpp>
#include <gale/base/sort.hpp>
#include <gale/base/stop.hpp>
#include <gale/base/transfer.hpp>
#include <gale/relations/faces.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/runtime/whole/whole_rows.hpp>

namespace gale::detail {

namespace {

/// Writes the row of a simplex where its name says.
template <Relation relation, class Memory>
struct WriteFaceRow {
  Simplices<Memory> simplices;
  OtherIds rows, entries;
  Id* to;

  KOKKOS_FUNCTION void operator()(Offset simplex) const {
    constexpr int size = face_count(relation);
    FaceRow<size> row = face_row<relation>(simplices, static_cast<Id>(simplex));
    for (Id& id : row.ids) id = entries[id];
    write_ascending(row, to + Offset(size) * rows[static_cast<Id>(simplex)]);
  }
};

template <Relation relation, class Space>
EvenRows<MemoryOf<Space>> faces_in(const Space& space, const Mesh& mesh, const RelationNames& names) {
  using Memory = MemoryOf<Space>;
  constexpr int size = face_count(relation);
  const auto simplices = mesh.simplices<Memory>(needs_of(relation, mesh.dimension()));
  const Offset rows = count_of(mesh, row_dimension(relation));
  const auto faces = allocate<Array<Id, Memory>>("GALE::face_rows", size * rows);
  parallel_for("GALE::face_rows", space, rows,
               WriteFaceRow<relation, Memory>{simplices, {names.rows}, {names.entries}, faces.data()});
  return {size, faces};
}

/// Visits the entries of an even row.
struct EvenKeys {
  const Id* entries;
  int length;

  GALE_CALLS_ANY
  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id row, const Visit& visit) const {
    for (int k = 0; k < length; ++k) visit(entries[Offset(length) * row + k]);
  }
};

}  // namespace

template <class Space>
Csr<const Id, HostMemory> kernel_rows(const Space& space, const Mesh& mesh, Relation down, bool transposed,
                                      const RelationNames& names) {
  stop_if_asked();
  auto faces = with_faces_of(down, [&](auto known) { return faces_in<decltype(known)::value>(space, mesh, names); });
  if (!transposed)
    return with_offsets(HostExecutionSpace(), EvenRows<HostMemory>{faces.length, on_host(faces.entries)});
  const auto cofaces = group_by("GALE::coface_rows", space, faces.rows(), count_of(mesh, entry_dimension(down)),
                                EvenKeys{faces.entries.data(), faces.length});
  faces = {};
  sort_rows(space, "GALE::coface_rows", cofaces);
  return {on_host(cofaces.offsets), on_host(cofaces.entries)};
}

#define GALE_INSTANTIATE(Space) \
  template Csr<const Id, HostMemory> kernel_rows(const Space&, const Mesh&, Relation, bool, const RelationNames&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
