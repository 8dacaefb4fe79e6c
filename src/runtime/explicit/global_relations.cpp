#include <algorithm>
#include <iterator>
#include <utility>

#include <gale/runtime/explicit/global_faces.hpp>
#include <gale/runtime/explicit/global_relations.hpp>
#include <gale/runtime/explicit/global_rows.hpp>

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

class Build {
 public:
  Build(const Mesh& mesh, RelationSet wanted) : mesh_(mesh), wanted_(wanted), needed_(needed_for(wanted)) {
    result_.count[0] = mesh.vertices();
    result_.count[3] = mesh.tetrahedra();
    for (const int dimension : {0, 3}) result_.segment_begin[dimension] = mesh.interval_begin(dimension);
  }

  GlobalRelations run() {
    for (const Recipe& recipe : recipes) {
      if (!needed_.has(recipe.relation)) continue;
      make(recipe);
      if (recipe.relation == Relation::VV && needed_.has_links()) make_links();
      release_after(recipe);
    }
    return std::move(result_);
  }

 private:
  GlobalGraph& graph(Relation relation) { return graphs_[static_cast<int>(relation)]; }
  GlobalRows& rows(Relation relation) { return result_.rows[static_cast<int>(relation)]; }

  void make(const Recipe& recipe) {
    const Relation relation = recipe.relation;
    graph(relation) = graph_of(recipe);
    const bool for_links = needed_.has_links() && (Relation::VT | Relation::VV).has(relation);
    if (wanted_.has(relation) || for_links) rows(relation) = to_host(graph(relation));
  }

  GlobalGraph graph_of(const Recipe& recipe) {
    if (face_relations.has(recipe.relation)) return faces_of(recipe.relation);
    if (coboundary_relations.has(recipe.relation)) return coboundary_of(recipe);
    return adjacency_of(recipe);
  }

  GlobalGraph faces_of(Relation relation) {
    if (relation == Relation::TV) return tetrahedron_vertices(mesh_);
    if (relation == Relation::TE) return of_tetrahedra(1, number_edges(graph(Relation::TV)));
    if (relation == Relation::TF) return of_tetrahedra(2, number_triangles(graph(Relation::TV), graph(Relation::TE)));
    return faces(relation, simplices_[row_dimension(relation)],
                 graph(entry_dimension(relation) == 0 ? Relation::TV : Relation::TE));
  }

  /// Keeps the simplices as long as others are from them.
  GlobalGraph of_tetrahedra(int dimension, const GlobalSimplices& simplices) {
    result_.count[dimension] = simplices.count();
    result_.segment_begin[dimension] = segment_begin(mesh_, dimension, simplices);
    simplices_[dimension] = simplices;
    return simplices.of_tetrahedra;
  }

  GlobalGraph coboundary_of(const Recipe& recipe) {
    const Relation of = members_of(recipe.from).front();
    return transpose(recipe.relation, graph(of), result_.count[row_dimension(recipe.relation)]);
  }

  GlobalGraph adjacency_of(const Recipe& recipe) {
    const auto factors = members_of(recipe.from);
    const bool in_order = row_dimension(factors[0]) == row_dimension(recipe.relation);
    return neighbours(recipe.relation, graph(factors[in_order ? 0 : 1]), graph(factors[in_order ? 1 : 0]));
  }

  void make_links() {
    result_.links = global_links(mesh_, rows(Relation::VT), rows(Relation::VV));
    if (!wanted_.has(Relation::VV)) rows(Relation::VV) = {};
    if (!wanted_.has(Relation::VT)) rows(Relation::VT).ids = {};
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
    for (const Relation relation : members_of(needed_ - sources)) graph(relation) = {};
    for (int dimension = 0; dimension < 4; ++dimension) {
      if (!numbered[dimension]) simplices_[dimension] = {};
    }
  }

  const Mesh& mesh_;
  const RelationSet wanted_, needed_;
  std::array<GlobalGraph, relation_count> graphs_;
  std::array<GlobalSimplices, 4> simplices_;  // edges and triangles
  GlobalRelations result_;
};

}  // namespace

GlobalRelations global_relations(const Mesh& mesh, RelationSet wanted) {
  require_kokkos_kernels();
  refuse_too_many(wanted, mesh.tetrahedra());  // first, so that it names what the caller knows
  refuse_too_many(needed_for(wanted), mesh.tetrahedra());
  return Build(mesh, wanted).run();
}

}  // namespace gale::detail
