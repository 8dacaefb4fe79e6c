#include <algorithm>
#include <iterator>
#include <utility>

#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/runtime/explicit/explicit_relations.hpp>

namespace gale::detail {

namespace {

/// A relation and what it is computed from.
struct Recipe {
  Relation relation;
  RelationSet from;
};

/// In an order in which each comes after what it is from, and little is held for later: vertices, then edges, then
/// triangles.
constexpr Recipe recipes[] = {
    {Relation::TV, {}},
    {Relation::VT, Relation::TV},
    {Relation::VV, Relation::VT | Relation::TV},
    {Relation::TE, Relation::TV},
    {Relation::EV, Relation::TE | Relation::TV},
    {Relation::VE, Relation::EV},
    {Relation::EE, Relation::EV | Relation::VE},
    {Relation::ET, Relation::TE},
    {Relation::TF, Relation::TE | Relation::TV},
    {Relation::FV, Relation::TF | Relation::TV},
    {Relation::FE, Relation::TF | Relation::TE},
    {Relation::VF, Relation::FV},
    {Relation::EF, Relation::FE},
    {Relation::FF, Relation::FE | Relation::EF},
    {Relation::FT, Relation::TF},
    {Relation::TT, Relation::TF | Relation::FT},
};

/// The relations wanted and all that they are computed from.
RelationSet needed_for(RelationSet wanted) {
  if (wanted.has_links()) wanted = wanted | Relation::VT | Relation::VV;
  for (auto recipe = std::rbegin(recipes); recipe != std::rend(recipes); ++recipe) {
    if (wanted.has(recipe->relation)) wanted = wanted | recipe->from;
  }
  return wanted;
}

/// Refuses those of whose entries a tetrahedron has so many.
void refuse_too_many(RelationSet relations, Id tetrahedra) {
  constexpr Offset faces[] = {4, 6, 4};
  for (const Relation relation : members_of(relations & (face_relations | coboundary_relations))) {
    const int rows = row_dimension(relation), entries = entry_dimension(relation);
    if (rows == 3 || entries == 3) require_countable(relation, faces[std::min(rows, entries)] * tetrahedra);
  }
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

/// Looks the vertices of each tetrahedron up in the VV rows of the others, on all our threads.
template <class Place>
void look_up_links(const EncodedMesh<HostMemory>& mesh, const Rows& vt, const Rows& vv, Place* places) {
  parallel_for("GALE::link", HostExecutionSpace(), vt.count, [&](Offset i) {
    const Id v = static_cast<Id>(i);
    const Row neighbours = vv[v];
    Place* to = places + Offset(3) * vt.offsets[v];
    for (const Id t : vt[v]) {
      for (int corner = 0; corner < 4; ++corner) {
        const Id other = mesh.tetrahedra(t, corner);
        if (other == v) continue;
        *to++ = static_cast<Place>(std::lower_bound(neighbours.begin(), neighbours.end(), other) - neighbours.begin());
      }
    }
  });
}

class ExplicitBuild {
 public:
  ExplicitBuild(const Mesh& mesh, RelationSet wanted) : mesh_(mesh), wanted_(wanted), needed_(needed_for(wanted)) {
    result_.count[0] = mesh.vertices();
    result_.count[3] = mesh.tetrahedra();
    for (const int dimension : {0, 3}) result_.segment_begin[dimension] = mesh.interval_begin(dimension);
  }

  ExplicitRelations run() {
    for (const Recipe& recipe : recipes) {
      if (!needed_.has(recipe.relation)) continue;
      make(recipe);
      if (recipe.relation == Relation::VV && needed_.has_links()) make_links();
      release_after(recipe);
    }
    return std::move(result_);
  }

 private:
  EvenRows<WorkerMemory>& even(Relation relation) { return even_[static_cast<int>(relation)]; }
  WorkerRows& cofaces(Relation relation) { return cofaces_[static_cast<int>(relation)]; }
  HostRows& kept(Relation relation) { return result_.kept[static_cast<int>(relation)]; }

  void make(const Recipe& recipe) {
    const Relation relation = recipe.relation;
    if (face_relations.has(relation)) {
      keep(relation, even(relation) = faces_of(relation));
    } else if (coboundary_relations.has(relation)) {
      const Id rows = result_.count[row_dimension(relation)];
      keep(relation, cofaces(relation) = transpose(relation, graph(members_of(recipe.from).front()), rows));
    } else {
      keep(relation, adjacency_of(recipe));
    }
  }

  template <class All>
  void keep(Relation relation, const All& all) {
    const bool for_links = needed_.has_links() && (Relation::VT | Relation::VV).has(relation);
    if (wanted_.has(relation) || for_links) kept(relation) = to_host(all);
  }

  /// What a relation is computed from, with offsets.
  WorkerRows graph(Relation relation) {
    return face_relations.has(relation) ? with_offsets(WorkerSpace(), even(relation)) : cofaces(relation);
  }

  EvenRows<WorkerMemory> faces_of(Relation relation) {
    if (relation == Relation::TV) return tetrahedron_vertices(mesh_);
    if (relation == Relation::TE) return of_tetrahedra(1, number_edges(even(Relation::TV)));
    if (relation == Relation::TF) return of_tetrahedra(2, number_triangles(even(Relation::TV), even(Relation::TE)));
    return faces(relation, simplices_[row_dimension(relation)],
                 even(entry_dimension(relation) == 0 ? Relation::TV : Relation::TE));
  }

  /// Keeps the simplices as long as others are from them.
  EvenRows<WorkerMemory> of_tetrahedra(int dimension, const SortedSimplices& simplices) {
    result_.count[dimension] = simplices.count();
    result_.segment_begin[dimension] = segment_begin(mesh_, dimension, simplices);
    simplices_[dimension] = simplices;
    return simplices.of_tetrahedra;
  }

  WorkerRows adjacency_of(const Recipe& recipe) {
    const auto factors = members_of(recipe.from);
    const bool in_order = row_dimension(factors[0]) == row_dimension(recipe.relation);
    return neighbours(recipe.relation, graph(factors[in_order ? 0 : 1]), graph(factors[in_order ? 1 : 0]));
  }

  void make_links() {
    const Rows vt = result_.rows(Relation::VT), vv = result_.rows(Relation::VV);
    result_.link_width = width_for(longest_row(vv));
    const Offset entries = kept(Relation::VT).entries.extent(0);
    result_.link_places = allocate<Array<std::uint8_t, HostMemory>>("GALE::link", 3 * entries * result_.link_width);
    void* const places = result_.link_places.data();
    const auto& encoded = mesh_.encoded();
    if (result_.link_width == 1) look_up_links(encoded, vt, vv, static_cast<std::uint8_t*>(places));
    if (result_.link_width == 2) look_up_links(encoded, vt, vv, static_cast<std::uint16_t*>(places));
    if (result_.link_width == 4) look_up_links(encoded, vt, vv, static_cast<Id*>(places));
    if (!wanted_.has(Relation::VV)) kept(Relation::VV) = {};
    if (!wanted_.has(Relation::VT)) kept(Relation::VT).entries = {};
  }

  /// Lets go of what no later one is from.
  void release_after(const Recipe& done) {
    RelationSet sources;
    std::array<bool, 4> numbered{};
    for (const Recipe* later = &done + 1; later != std::end(recipes); ++later) {
      if (!needed_.has(later->relation)) continue;
      sources = sources | later->from;
      if (face_relations.has(later->relation)) numbered[row_dimension(later->relation)] = true;
    }
    for (const Relation relation : members_of(needed_ - sources)) {
      even(relation) = {};
      cofaces(relation) = {};
    }
    for (int dimension = 0; dimension < 4; ++dimension) {
      if (!numbered[dimension]) simplices_[dimension] = {};
    }
  }

  const Mesh& mesh_;
  const RelationSet wanted_, needed_;
  std::array<EvenRows<WorkerMemory>, relation_count> even_;
  std::array<WorkerRows, relation_count> cofaces_;
  std::array<SortedSimplices, 4> simplices_;  // edges and triangles
  ExplicitRelations result_;
};

}  // namespace

ExplicitRelations explicit_relations(const Mesh& mesh, RelationSet wanted) {
  require_kokkos_kernels();
  refuse_too_many(wanted, mesh.tetrahedra());  // first, so that it names what the caller knows
  refuse_too_many(needed_for(wanted), mesh.tetrahedra());
  return ExplicitBuild(mesh, wanted).run();
}

}  // namespace gale::detail
