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

/// Recipes for triangle meshes.
constexpr Recipe triangle_recipes[] = {
    {Relation::FV, {}},
    {Relation::VF, Relation::FV},
    {Relation::VV, Relation::VF | Relation::FV},
    {Relation::FE, Relation::FV},
    {Relation::EV, Relation::FE | Relation::FV},
    {Relation::VE, Relation::EV},
    {Relation::EE, Relation::EV | Relation::VE},
    {Relation::EF, Relation::FE},
    {Relation::FF, Relation::FE | Relation::EF},
};

Span<const Recipe> recipes_for(int dimension) {
  return dimension == 3 ? Span<const Recipe>{recipes, std::size(recipes)}
                        : Span<const Recipe>{triangle_recipes, std::size(triangle_recipes)};
}

/// The relations wanted and all that they are computed from.
RelationSet needed_for(RelationSet wanted, int dimension) {
  if (wanted.has_links()) wanted = wanted | vertex_cells(dimension) | Relation::VV;
  const auto all = recipes_for(dimension);
  for (const Recipe* recipe = all.end(); recipe-- != all.begin();) {
    if (wanted.has(recipe->relation)) wanted = wanted | recipe->from;
  }
  return wanted;
}

/// Refuses those of whose entries a cell has so many.
void refuse_too_many(RelationSet relations, const Mesh& mesh) {
  constexpr Offset faces_of_tetrahedron[] = {4, 6, 4}, faces_of_triangle[] = {3, 3};
  const int cell = mesh.dimension();
  const Offset* const faces = cell == 3 ? faces_of_tetrahedron : faces_of_triangle;
  for (const Relation relation : members_of(relations & (face_relations | coboundary_relations))) {
    const int rows = row_dimension(relation), entries = entry_dimension(relation);
    if (rows == cell || entries == cell) require_countable(relation, faces[std::min(rows, entries)] * mesh.cells());
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
  ExplicitBuild(const Mesh& mesh, RelationSet wanted)
      : mesh_(mesh), wanted_(wanted), needed_(needed_for(wanted, mesh.dimension())) {
    result_.dimension = mesh.dimension();
    result_.count[0] = mesh.vertices();
    result_.count[mesh.dimension()] = mesh.cells();
    for (const int dimension : {0, mesh.dimension()}) result_.segment_begin[dimension] = mesh.interval_begin(dimension);
  }

  ExplicitRelations run() {
    for (const Recipe& recipe : recipes_for(mesh_.dimension())) {
      if (!needed_.has(recipe.relation)) continue;
      make(recipe);
      if (recipe.relation == Relation::VV && needed_.has_links()) make_links();
      release_after(recipe);
    }
    return std::move(result_);
  }

 private:
  Relation stars() const { return vertex_cells(mesh_.dimension()); }
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
    const bool for_links = needed_.has_links() && (Relation::VV | stars()).has(relation);
    if (wanted_.has(relation) || for_links) kept(relation) = to_host(all);
  }

  /// What a relation is computed from, with offsets.
  WorkerRows graph(Relation relation) {
    return face_relations.has(relation) ? with_offsets(WorkerSpace(), even(relation)) : cofaces(relation);
  }

  EvenRows<WorkerMemory> faces_of(Relation relation) {
    const bool tetrahedra = mesh_.dimension() == 3;
    const Relation vertices = tetrahedra ? Relation::TV : Relation::FV,
                   edges = tetrahedra ? Relation::TE : Relation::FE;
    if (relation == vertices) return cell_vertices(mesh_);
    if (relation == edges) return of_cells(1, number_edges(even(vertices)));
    if (relation == Relation::TF) return of_cells(2, number_triangles(even(vertices), even(edges)));
    return faces(relation, simplices_[row_dimension(relation)],
                 even(entry_dimension(relation) == 0 ? vertices : edges));
  }

  /// Keeps the simplices as long as others are from them.
  EvenRows<WorkerMemory> of_cells(int dimension, const SortedSimplices& simplices) {
    result_.count[dimension] = simplices.count();
    result_.segment_begin[dimension] = segment_begin(mesh_, dimension, simplices);
    simplices_[dimension] = simplices;
    return simplices.of_cells;
  }

  WorkerRows adjacency_of(const Recipe& recipe) {
    const auto factors = members_of(recipe.from);
    const bool in_order = row_dimension(factors[0]) == row_dimension(recipe.relation);
    return neighbours(recipe.relation, graph(factors[in_order ? 0 : 1]), graph(factors[in_order ? 1 : 0]));
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

  /// Lets go of what no later one is from.
  void release_after(const Recipe& done) {
    RelationSet sources;
    std::array<bool, 4> numbered{};
    for (const Recipe* later = &done + 1; later != recipes_for(mesh_.dimension()).end(); ++later) {
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
  refuse_too_many(wanted, mesh);  // first, so that it names what the caller knows
  refuse_too_many(needed_for(wanted, mesh.dimension()), mesh);
  return ExplicitBuild(mesh, wanted).run();
}

}  // namespace gale::detail
