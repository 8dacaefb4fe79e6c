#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/relations/preconditioning.hpp>
#include <gale/runtime/explicit/explicit_relations.hpp>

namespace gale::detail {

namespace {

/// A relation to faces and what is computed from it: the one the other way round and, as a product of the two, which
/// simplices are adjacent: those that share such a face or, of vertices, a cell.
struct RelationFamily {
  Relation faces, cofaces;
  std::optional<Relation> adjacency;
};

/// Those of which something is wanted.
std::vector<RelationFamily> families_of(RelationSet wanted, int dimension) {
  if (wanted.has_links()) wanted = wanted | vertex_cells(dimension) | Relation::VV;
  std::vector<RelationFamily> families;
  for (const Relation faces : members_of(face_relations & relations_of_dimension(dimension))) {
    const int rows = row_dimension(faces), entries = entry_dimension(faces);
    RelationFamily family{faces, relation_between(entries, rows), {}};
    if (entries == rows - 1) family.adjacency = relation_between(rows, rows);
    if (entries == 0 && rows == dimension) family.adjacency = Relation::VV;
    RelationSet all = faces | family.cofaces;
    if (family.adjacency) all = all | *family.adjacency;
    if (!(all & wanted).empty()) families.push_back(family);
  }
  return families;
}

using HostRows = Csr<const Id, HostMemory, Id>;
using WorkerRows = Csr<const Id, WorkerMemory>;

HostRows to_host(const EvenRows<WorkerMemory>& even) {
  return with_offsets<Id>(Kokkos::DefaultHostExecutionSpace(),
                          EvenRows<HostMemory>{even.length, on_host(even.entries)});
}

HostRows to_host(const WorkerRows& all) {
  const auto begin = all.offsets;
  const auto offsets = allocate<Array<Id, WorkerMemory>>("GALE::row_begin", begin.extent(0));
  parallel_for(
      "GALE::row_begin", WorkerSpace(), begin.extent(0),
      KOKKOS_LAMBDA(Offset i) { offsets(i) = static_cast<Id>(begin(i)); });
  return {on_host(offsets), on_host(all.entries)};
}

Id longest_row(const Rows& rows) {
  return -reduce_min("GALE::longest_row", HostExecutionSpace(), rows.count, Id(0),
                     [&](Offset v) { return -rows[static_cast<Id>(v)].size(); });
}

/// Looks the vertices of each cell up in the VV rows of the others, on all our threads.
template <class Place>
void look_up_links(const EncodedMesh<HostMemory>& mesh, const Rows& stars, const Rows& vv, Place* places) {
  parallel_for("GALE::link", HostExecutionSpace(), stars.count, [&](Offset i) {
    const Id v = static_cast<Id>(i);
    const Row neighbours = vv[v];
    Place* to = places + Offset(mesh.dimension) * stars.offsets[v];
    for (const Id t : stars[v]) {
      for (int corner = 0; corner <= mesh.dimension; ++corner) {
        const Id other = mesh.cells(t, corner);
        if (other == v) continue;
        *to++ = static_cast<Place>(std::lower_bound(neighbours.begin(), neighbours.end(), other) - neighbours.begin());
      }
    }
  });
}

class ExplicitBuild {
 public:
  ExplicitBuild(const Mesh& mesh, RelationSet wanted) : mesh_(mesh), wanted_(wanted) {
    result_.dimension = mesh.dimension();
  }

  ExplicitRelations run() {
    const auto families = families_of(wanted_, mesh_.dimension());
    RelationSet all_faces;
    for (const RelationFamily& family : families) all_faces = all_faces | family.faces;
    const SimplexNeeds needs = needs_of(all_faces, mesh_.dimension());
    mesh_.simplices<WorkerMemory>(needs);  // all are numbered at once
    for (int dimension = 0; dimension <= mesh_.dimension(); ++dimension) {
      const bool is_numbered = dimension <= static_cast<int>(needs.upto);
      if (!is_numbered && dimension < mesh_.dimension()) continue;
      result_.count[dimension] = count_of(mesh_, dimension);
      result_.segment_begin[dimension] = mesh_.interval_begin(dimension);
    }
    for (const RelationFamily& family : families) refuse_too_many(family);
    for (const RelationFamily& family : families) make(family);
    return std::move(result_);
  }

 private:
  Relation stars() const { return vertex_cells(mesh_.dimension()); }
  HostRows& kept(Relation relation) { return result_.kept[static_cast<int>(relation)]; }

  /// Names the one that the caller wants, if it is one of the two.
  void refuse_too_many(const RelationFamily& family) const {
    const bool names_faces = wanted_.has(family.faces) || !wanted_.has(family.cofaces);
    require_countable(names_faces ? family.faces : family.cofaces,
                      Offset(face_count(family.faces)) * result_.count[row_dimension(family.faces)]);
  }

  void make(const RelationFamily& family) {
    const bool for_links = wanted_.has_links() && family.cofaces == stars();
    const auto keep = [&](Relation relation, const auto& rows) {
      if (wanted_.has(relation) || (for_links && relation != family.faces)) kept(relation) = to_host(rows);
    };
    const EvenRows<WorkerMemory> even = faces_of(family.faces);
    keep(family.faces, even);
    const bool joins = family.adjacency && (wanted_.has(*family.adjacency) || for_links);
    if (!joins && !wanted_.has(family.cofaces)) return;
    const WorkerRows faces = with_offsets(WorkerSpace(), even);
    const WorkerRows cofaces = transpose(family.cofaces, faces, result_.count[row_dimension(family.cofaces)]);
    keep(family.cofaces, cofaces);
    if (!joins) return;
    const bool of_vertices = *family.adjacency == Relation::VV;
    keep(*family.adjacency,
         neighbours(*family.adjacency, of_vertices ? cofaces : faces, of_vertices ? faces : cofaces));
    if (for_links) make_links();
  }

  /// Those of tetrahedra are the mesh's own array.
  EvenRows<WorkerMemory> faces_of(Relation relation) const {
    if (relation != Relation::TV) return kernel_face_rows(WorkerSpace(), mesh_, relation, {});
    return {4, Array<const Id, WorkerMemory>(mesh_.encoded<WorkerMemory>().cells.data(), 4 * Offset(mesh_.cells()))};
  }

  void make_links() {
    const Rows of_cells = result_.rows(stars()), vv = result_.rows(Relation::VV);
    result_.link_width = width_for(longest_row(vv));
    const Offset entries = kept(stars()).entries.extent(0);
    result_.link_places =
        allocate<Array<std::uint8_t, HostMemory>>("GALE::link", mesh_.dimension() * entries * result_.link_width);
    void* const places = result_.link_places.data();
    const auto& encoded = mesh_.encoded();
    if (result_.link_width == 1) look_up_links(encoded, of_cells, vv, static_cast<std::uint8_t*>(places));
    if (result_.link_width == 2) look_up_links(encoded, of_cells, vv, static_cast<std::uint16_t*>(places));
    if (result_.link_width == 4) look_up_links(encoded, of_cells, vv, static_cast<Id*>(places));
    if (!wanted_.has(Relation::VV)) kept(Relation::VV) = {};
    if (!wanted_.has(stars())) kept(stars()).entries = {};
  }

  const Mesh& mesh_;
  const RelationSet wanted_;
  ExplicitRelations result_;
};

}  // namespace

ExplicitRelations explicit_relations(const Mesh& mesh, RelationSet wanted) {
  require_kokkos_kernels();
  return ExplicitBuild(mesh, wanted).run();
}

}  // namespace gale::detail
