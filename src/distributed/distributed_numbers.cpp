#include <algorithm>
#include <memory>

#include <gale/algorithms/numbers/numbering_sweep.hpp>
#include <gale/distributed/distributed_numbers.hpp>
#include <gale/distributed/sums_by_id.hpp>

namespace gale {

namespace {

using detail::Dealt;
using Ids = Array<GlobalId, HostMemory>;

/// Global ids of the vertices that this rank owns, by GALE's id.
Ids owned_ids(const DistributedMesh& mesh) {
  const Id* const input = mesh.local().vertex_input().data();
  const auto ids = allocate<Ids>("GALE::owned_ids", mesh.local().owned_vertices());
  parallel_for("GALE::owned_ids", HostExecutionSpace(), ids.extent(0),
               [&](Offset v) { ids(v) = mesh.vertex_id(input[v]); });
  return ids;
}

/// Which rank owns each vertex.
detail::HomeTable<int> owners_of(const DistributedMesh& mesh, const Ids& owned) {
  struct Nothing {};
  return {mesh.ranks(), owned, [](Id) { return Nothing(); }, [](int rank, Nothing) { return rank; }};
}

/// Simplices of N vertices on their way to the owners of their first vertices, and back with numbers.
template <std::size_t N>
class Asked {
 public:
  using Simplex = std::array<GlobalId, N>;

  Asked(const DistributedMesh& mesh, const detail::HomeTable<int>& owners, std::vector<Simplex> simplices)
      : mesh_(mesh) {
    const Communicator& ranks = mesh.ranks();
    Ids first;
    detail::together(ranks, [&] {
      first = allocate<Ids>("GALE::first_vertices", simplices.size());
      parallel_for("GALE::first_vertices", HostExecutionSpace(), simplices.size(), [&](Offset i) {
        std::sort(simplices[i].begin(), simplices[i].end());
        first(i) = simplices[i][0];
      });
    });
    const auto owner = owners.find(ranks, first, -1);
    detail::together(ranks, [&] {
      for (std::size_t i = 0; i < simplices.size(); ++i) {
        if (owner(i) < 0) throw Error("no vertex " + std::to_string(first(i)) + " to number a simplex of");
      }
    });
    sent_ = detail::deal<Simplex>(
        ranks, "GALE::named_simplices", static_cast<Offset>(simplices.size()), [&](Id i) { return owner(i); },
        [&](Id i) { return simplices[i]; }, &members_);
    received_ = detail::exchange(ranks, "GALE::simplices_to_number", sent_);
  }

  /// What others ask of this rank, in GALE's ids of its local mesh.
  std::vector<std::array<Id, N>> local() const {
    const Id* const internal = mesh_.local().vertex_internal().data();
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
    Dealt<GlobalId> told, found;
    std::vector<GlobalId> numbers;
    detail::together(mesh_.ranks(), [&] {
      told = detail::dealt<GlobalId>("GALE::told_numbers", detail::counts_of(received_));
      parallel_for("GALE::told_numbers", HostExecutionSpace(), told.count(),
                   [&](Offset i) { told.entries(i) = number_of(i); });
      found = detail::dealt<GlobalId>("GALE::found_numbers", detail::counts_of(sent_));
      numbers.resize(sent_.count());
    });
    detail::exchange(mesh_.ranks(), told, found);
    for (Offset i = 0; i < found.count(); ++i) numbers[members_(i)] = found.entries(i);
    return numbers;
  }

  GlobalId first_vertex(Offset i) const { return received_.entries(i)[0]; }

 private:
  const DistributedMesh& mesh_;
  Dealt<Simplex> sent_, received_;
  Array<Id, HostMemory> members_;
};

/// For each vertex that this rank owns, by GALE's id, the number of the first simplex whose first vertex it is, of the
/// simplices that `counts` counts by input id.
Ids first_numbers(const DistributedMesh& mesh, const Ids& owned, const Array<Id, HostMemory>& counts) {
  Ids of_owned;
  detail::together(mesh.ranks(), [&] {
    const Id* const input = mesh.local().vertex_input().data();
    of_owned = allocate<Ids>("GALE::owned_counts", owned.extent(0));
    parallel_for("GALE::owned_counts", HostExecutionSpace(), owned.extent(0),
                 [&](Offset v) { of_owned(v) = counts(input[v]); });
  });
  return detail::sums_before(mesh.ranks(), owned, of_owned);
}

}  // namespace

DistributedNumbers number_simplices(Structure& structure, const DistributedMesh& mesh,
                                    const DistributedNamedSimplices& named, const SweepOptions& options) {
  const Communicator& ranks = mesh.ranks();
  const ThreadLimit limit(options.threads);
  Ids owned;
  detail::together(ranks, [&] { owned = owned_ids(mesh); });
  const auto owners = owners_of(mesh, owned);
  const Asked<2> edges(mesh, owners, named.edges);
  const Asked<3> triangles(mesh, owners, named.triangles);
  NamedSimplices local;
  std::unique_ptr<detail::NumberingSweep> found;
  detail::together(ranks, [&] {
    local = {edges.local(), triangles.local()};
    found = std::make_unique<detail::NumberingSweep>(structure, local, options);
  });
  const Ids first_edges = first_numbers(mesh, owned, found->edge_counts());
  const Ids first_triangles = first_numbers(mesh, owned, found->triangle_counts());
  const Id* const internal = mesh.local().vertex_internal().data();
  const auto at = [&](GlobalId vertex) { return internal[mesh.vertex_of(vertex)]; };
  DistributedNumbers numbers;
  numbers.edges =
      edges.answers([&](Offset i) { return first_edges(at(edges.first_vertex(i))) + found->edges().place(i); });
  numbers.triangles = triangles.answers(
      [&](Offset i) { return first_triangles(at(triangles.first_vertex(i))) + found->triangles().place(i); });
  numbers.on_surface = found->on_surface();
  return numbers;
}

}  // namespace gale
