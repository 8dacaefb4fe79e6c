#include <array>
#include <string>
#include <utility>

#include <gale/algorithms/excerpt/excerpt_mesh.hpp>
#include <gale/algorithms/excerpt/whole_mesh.hpp>
#include <gale/algorithms/order/require.hpp>
#include <gale/algorithms/simplify_field/field_on_ranks.hpp>
#include <gale/base/error.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>

namespace gale::detail {

namespace {

constexpr const char* gathered = "the mesh of a simplified field";

/// Gives each rank what simplify(computed) has found on the first one. Collective.
template <class Simplify>
SimplifiedField given_back(const WholeMesh& whole, const Mesh& mesh, Computed* computed, const Simplify& simplify) {
  const Ranks& ranks = mesh.exchange().ranks();
  SimplifiedField all, here;
  std::vector<GlobalId> value_ids;
  std::array<std::int64_t, 3> counts{};
  together(ranks, [&] {
    if (ranks.rank() != 0) return;
    Computed of_whole;
    all = simplify(of_whole);
    if (computed != nullptr) {
      computed->on_device = of_whole.on_device;
      computed->notices.insert(computed->notices.end(), of_whole.notices.begin(), of_whole.notices.end());
    }
    counts = {all.minima, all.maxima, all.kept_below};
    value_ids.resize(all.value_of.size());
    parallel_for("GALE::ids_of_values", HostExecutionSpace(), value_ids.size(),
                 [&](Offset v) { value_ids[v] = whole.mesh().vertex_id(all.value_of[v]); });
  });
  ranks.sum(counts.data(), 3);
  here.minima = static_cast<Id>(counts[0]);
  here.maxima = static_cast<Id>(counts[1]);
  here.kept_below = static_cast<Id>(counts[2]);
  here.rank = whole.given_back(all.rank);
  value_ids = whole.given_back(value_ids);
  together(ranks, [&] {
    const auto count = static_cast<Offset>(value_ids.size());
    const GlobalIds ids = distinct_of("GALE::ids_of_values", value_ids);
    const GlobalIndex index(ids);
    here.value_of.resize(count);
    parallel_for("GALE::value_of", HostExecutionSpace(), count,
                 [&](Offset v) { here.value_of[v] = index.find(value_ids[v]); });
    here.excerpt = excerpt_mesh<4>(ids, GlobalIds(), CellCorners<4, Id, HostMemory>());
  });
  return here;
}

/// The places in the whole of vertices that ranks name by input ids of theirs; on the first rank. Collective.
std::vector<Id> named_by_all(const WholeMesh& whole, const Mesh& mesh, const std::vector<Id>& vertices) {
  const Ranks& ranks = mesh.exchange().ranks();
  EntriesByRank<GlobalId> sent;
  together(ranks, [&] {
    std::vector<std::int64_t> counts(ranks.size(), 0);
    counts[0] = static_cast<std::int64_t>(vertices.size());
    sent = room_by_rank<GlobalId>("GALE::staying", counts);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (vertices[i] < 0 || vertices[i] >= mesh.vertices())
        throw Error("vertex " + std::to_string(vertices[i]) + ", which is to stay, is none of the part's " +
                    std::to_string(mesh.vertices()));
      sent.entries(i) = mesh.vertex_id(vertices[i]);
    }
  });
  const EntriesByRank<GlobalId> received = exchange(ranks, "GALE::staying_of_all", sent);
  std::vector<Id> places;
  for (Offset i = 0; i < received.count(); ++i) places.push_back(whole.mesh().vertex_of(received.entries(i)));
  return places;
}

}  // namespace

SimplifiedField simplified_on_ranks(const VertexOrder& order, const std::function<double(Id)>& value, double threshold,
                                    const ComputeOptions& options, Computed* computed) {
  const Mesh& mesh = order.mesh();
  const Computing timed(mesh, options, computed);
  const WholeMesh whole(order, gathered);
  const std::vector<double> values =
      values_at(whole.mesh(), mesh, [&](Id vertex) { return known_value(value(vertex), mesh.vertex_id(vertex)); });
  return given_back(whole, mesh, computed, [&](Computed& of_whole) {
    return simplify_field(
        whole.order(), [&](Id vertex) { return values[vertex]; }, threshold, options, &of_whole);
  });
}

SimplifiedField simplified_on_ranks(const VertexOrder& order, const StayingExtrema& staying,
                                    const ComputeOptions& options, Computed* computed) {
  const Mesh& mesh = order.mesh();
  const Computing timed(mesh, options, computed);
  const WholeMesh whole(order, gathered);
  StayingExtrema all;
  all.minima = named_by_all(whole, mesh, staying.minima);
  all.maxima = named_by_all(whole, mesh, staying.maxima);
  return given_back(whole, mesh, computed,
                    [&](Computed& of_whole) { return simplify_field(whole.order(), all, options, &of_whole); });
}

}  // namespace gale::detail
