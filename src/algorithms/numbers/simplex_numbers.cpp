#include <algorithm>
#include <memory>

#include <gale/algorithms/numbers/numbering_sweep.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/base/ordered.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/mesh/exchange/places.hpp>

namespace gale {

namespace {

SimplexNumbers number_of_whole(Structure& structure, const NamedSimplices& named, const SweepOptions& options) {
  using detail::number_first_simplices;
  detail::NumberingSweep found(structure, named, options);
  return {found.edges().take_numbers(number_first_simplices("edges", found.edge_counts())),
          found.triangles().take_numbers(number_first_simplices("triangles", found.triangle_counts())),
          found.on_surface()};
}

using NumbersOfRanks = Array<GlobalId, HostMemory>;

/// The global ids of a simplex's vertices, ascending.
template <std::size_t N>
std::array<GlobalId, N> global_ids(const Mesh& mesh, const std::array<Id, N>& simplex) {
  const OtherIds input = mesh.vertices_in_input();
  std::array<GlobalId, N> ids;
  for (std::size_t k = 0; k < N; ++k) {
    const Id v = simplex[k];
    if (v < 0 || v >= mesh.vertices()) throw Error("no vertex " + std::to_string(v) + " to number a simplex of");
    ids[k] = mesh.vertex_id(input[v]);
  }
  return ascending(ids);
}

/// Simplices of N vertices on their way to the owners of their first vertices, and back with numbers.
template <std::size_t N>
class AskedSimplices {
 public:
  using Simplex = std::array<GlobalId, N>;

  /// `named_in` has their vertices.
  AskedSimplices(const Mesh& mesh, const std::vector<std::array<Id, N>>& named, const Mesh& named_in) : mesh_(mesh) {
    const Ranks& ranks = mesh.exchange().ranks();
    std::vector<Simplex> simplices(named.size());
    NumbersOfRanks first;
    detail::together(ranks, [&] {
      first = allocate<NumbersOfRanks>("GALE::first_vertices", simplices.size());
      parallel_for("GALE::first_vertices", HostExecutionSpace(), simplices.size(), [&](Offset i) {
        simplices[i] = global_ids(named_in, named[i]);
        first(i) = simplices[i][0];
      });
    });
    const auto owner = mesh.exchange().owners_of(first);
    detail::together(ranks, [&] {
      for (std::size_t i = 0; i < simplices.size(); ++i) {
        if (owner(i) < 0) throw Error("no vertex " + std::to_string(first(i)) + " to number a simplex of");
      }
    });
    sent_ = detail::collect_by_rank<Simplex>(
        ranks, "GALE::named_simplices", static_cast<Offset>(simplices.size()), [&](Id i) { return owner(i); },
        [&](Id i) { return simplices[i]; }, &members_);
    received_ = detail::exchange_packed(ranks, "GALE::simplices_to_number", sent_);
  }

  /// What others ask of this rank, in GALE's ids of its local mesh.
  std::vector<std::array<Id, N>> local() const {
    const OtherIds internal = mesh_.vertices_of_input();
    std::vector<std::array<Id, N>> simplices(received_.count());
    for (Offset i = 0; i < received_.count(); ++i) {
      for (std::size_t k = 0; k < N; ++k) {
        const Id at = mesh_.vertex_of(received_.entries(i)[k]);
        if (at == no_id)
          throw Error("no simplex of the mesh has the vertices " + std::to_string(received_.entries(i)[0]) + " and " +
                      std::to_string(received_.entries(i)[k]));
        simplices[i][k] = internal[at];
      }
    }
    return simplices;
  }

  /// Tells number_of(i) of the i-th of these to who asked, and returns what others tell. Collective.
  template <class NumberOf>
  std::vector<GlobalId> answers(const NumberOf& number_of) const {
    detail::EntriesByRank<GlobalId> told;
    std::vector<GlobalId> numbers;
    detail::together(mesh_.exchange().ranks(), [&] {
      told = detail::room_by_rank<GlobalId>("GALE::told_numbers", detail::counts_of(received_));
      parallel_for("GALE::told_numbers", HostExecutionSpace(), told.count(),
                   [&](Offset i) { told.entries(i) = number_of(i); });
      numbers.resize(sent_.count());
    });
    const auto found = detail::exchange_packed(mesh_.exchange().ranks(), "GALE::found_numbers", told);
    for (Offset i = 0; i < found.count(); ++i) numbers[members_(i)] = found.entries(i);
    return numbers;
  }

  GlobalId first_vertex(Offset i) const { return received_.entries(i)[0]; }

 private:
  const Mesh& mesh_;
  detail::EntriesByRank<Simplex> sent_, received_;
  Array<Id, HostMemory> members_;
};

/// For each vertex that this rank owns, from the first one on, the number of the first simplex whose first vertex it
/// is, of the simplices that `counts` counts by input id. Collective.
NumbersOfRanks first_numbers(const Mesh& mesh, const Array<Id, HostMemory>& counts) {
  const Ranks& ranks = mesh.exchange().ranks();
  NumbersOfRanks owned, of_owned;
  detail::together(ranks, [&] {
    const OtherIds input = mesh.vertices_in_input();
    owned = allocate<NumbersOfRanks>("GALE::owned_ids", mesh.owned_vertices().size());
    of_owned = allocate<NumbersOfRanks>("GALE::owned_counts", mesh.owned_vertices().size());
    const Id first = mesh.owned_vertices().first;
    parallel_for("GALE::owned_counts", HostExecutionSpace(), owned.extent(0), [&](Offset v) {
      const Id vertex = input[first + static_cast<Id>(v)];
      owned(v) = mesh.vertex_id(vertex);
      of_owned(v) = counts(vertex);
    });
  });
  return detail::sums_before(ranks, owned, of_owned).places;
}

/// What owners know of their vertices, by GALE's id, for the vertices of an excerpt. Collective.
Array<std::uint8_t, HostMemory> values_in(const Mesh& excerpt, const Mesh& mesh,
                                          const Array<const std::uint8_t, HostMemory>& values) {
  const Ranks& ranks = mesh.exchange().ranks();
  Array<std::uint8_t, HostMemory> by_input, found, in_order;
  detail::together(ranks, [&] {
    by_input = allocate<decltype(by_input)>("GALE::by_input", mesh.vertices());
    for (Id v = 0; v < mesh.vertices(); ++v) by_input(mesh.vertices_in_input()[v]) = values(v);
    found = allocate<decltype(found)>("GALE::values_in_excerpt", excerpt.vertices());
    in_order = allocate<decltype(found)>("GALE::values_in_excerpt", excerpt.vertices());
  });
  detail::plan_to(excerpt, mesh)(ranks, by_input.data(), found.data());
  for (Id v = 0; v < excerpt.vertices(); ++v) in_order(v) = found(excerpt.vertex_input()(v));
  return in_order;
}

SimplexNumbers number_of_part(Structure& structure, const NamedSimplices& named, const SweepOptions& options) {
  const Mesh& mesh = structure.mesh();
  const Mesh& named_in = named.excerpt ? *named.excerpt : mesh;
  const AskedSimplices<2> edges(mesh, named.edges, named_in);
  const AskedSimplices<3> triangles(mesh, named.triangles, named_in);
  NamedSimplices local;
  std::unique_ptr<detail::NumberingSweep> found;
  detail::together(mesh.exchange().ranks(), [&] {
    local = {edges.local(), triangles.local()};
    found = std::make_unique<detail::NumberingSweep>(structure, local, options);
  });
  const NumbersOfRanks first_edges = first_numbers(mesh, found->edge_counts());
  const NumbersOfRanks first_triangles = first_numbers(mesh, found->triangle_counts());
  const OtherIds internal = mesh.vertices_of_input();
  const auto at = [&](GlobalId vertex) { return internal[mesh.vertex_of(vertex)] - mesh.owned_vertices().first; };
  SimplexNumbers numbers;
  numbers.edges =
      edges.answers([&](Offset i) { return first_edges(at(edges.first_vertex(i))) + found->edges().place(i); });
  numbers.triangles = triangles.answers(
      [&](Offset i) { return first_triangles(at(triangles.first_vertex(i))) + found->triangles().place(i); });
  numbers.on_surface = named.excerpt ? values_in(*named.excerpt, mesh, found->on_surface()) : found->on_surface();
  return numbers;
}

void require_no_cells(const Mesh& mesh, const NamedSimplices& named) {
  if (mesh.dimension() == 2 && !named.triangles.empty())
    throw Error(std::to_string(named.triangles.size()) +
                " triangles of a mesh of triangles are to be numbered: these are its cells, and have their input ids");
}

}  // namespace

SimplexNumbers number_simplices(const Mesh& mesh, const NamedSimplices& named, const ComputeOptions& options,
                                Computed* computed) {
  detail::Computing computing(mesh, options, computed);
  require_no_cells(mesh, named);
  if (mesh.grid() != nullptr && !mesh.is_part()) return detail::number_on_grid(mesh, named);
  return number_simplices(computing.structure(simplex_numbers_relations), named, options);
}

SimplexNumbers number_simplices(Structure& structure, const NamedSimplices& named, const SweepOptions& options) {
  require_no_cells(structure.mesh(), named);
  const ThreadLimit limit(options.threads);
  return structure.mesh().is_part() ? number_of_part(structure, named, options)
                                    : number_of_whole(structure, named, options);
}

}  // namespace gale
