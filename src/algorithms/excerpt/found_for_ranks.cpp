#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <gale/algorithms/excerpt/found_for_ranks.hpp>
#include <gale/algorithms/excerpt/numbered_set.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>

namespace gale::detail {

namespace {

/// Calls visit(list) for each list of some.
template <class Lists, class Visit>
void for_each_list_of(Lists& lists, const Visit& visit) {
  std::apply([&](auto&... list) { (visit(list), ...); }, lists.all());
}

/// Calls visit(vertex) for each vertex in lists that call them by ids, on all threads.
template <class Visit>
void for_each_vertex_of(FoundFor& found, const Visit& visit) {
  const auto visit_all = [&](auto& list, int vertices, const auto& vertices_of) {
    parallel_for("GALE::reached_vertices", HostExecutionSpace(), list.size(), [&](Offset i) {
      Id* const of = vertices_of(list[i]);
      for (int k = 0; k < vertices; ++k) {
        if (of[k] >= 0) visit(of[k]);
      }
    });
  };
  const auto itself = [](auto& simplex) { return simplex.data(); };
  visit_all(found.vertex_steps, 2, itself);
  visit_all(found.edges, 3, itself);
  visit_all(found.critical_triangles, 3, itself);
  visit_all(found.critical_stars, 3, itself);
  visit_all(found.cells, 4, [](ReceivedCell& cell) { return cell.corners.data(); });
}

/// Takes the i-th lists for all ranks, and joins them.
template <std::size_t i>
void join(std::vector<FoundFor>& found, Reached& sent) {
  auto& to = std::get<i>(sent.all());
  std::vector<std::int64_t> counts;
  for (FoundFor& one : found) counts.push_back(static_cast<std::int64_t>(std::get<i>(one.all()).size()));
  to = room_by_rank<std::decay_t<decltype(to.entries(0))>>("GALE::reached", counts);
  for (std::size_t r = 0; r < found.size(); ++r) {
    auto& from = std::get<i>(found[r].all());
    auto* const place = to.entries.data() + to.begin[r];
    parallel_for("GALE::reached", HostExecutionSpace(), from.size(), [&](Offset k) { place[k] = from[k]; });
    from = {};
  }
}

template <std::size_t... i>
void join_all(std::vector<FoundFor>& found, Reached& sent, std::index_sequence<i...>) {
  (join<i>(found, sent), ...);
}

}  // namespace

void FoundFor::set_cell_steps(std::vector<std::array<Id, 2>> steps, const CellReader& corners_of,
                              const PathSimplices& simplices) {
  const Offset count = static_cast<Offset>(steps.size());
  std::vector<Id> ids = collected<Id>("GALE::reached_cells", count, [&](Offset i, const auto& add) {
    for (const Id cell : steps[i]) {
      if (cell >= 0) add(cell);
    }
  });
  sort_distinct("GALE::reached_cells", ids);
  cells = unwritten<ReceivedCell>(ids.size());
  parallel_for("GALE::reached_cells", HostExecutionSpace(), ids.size(), [&](Offset i) {
    const Quad corners = corners_of(ids[i]);
    cells[i] = {simplices.global(ids[i]), {corners.a, corners.b, corners.c, corners.d}};
  });
  const auto place_of = [&](Id cell) {
    return static_cast<Id>(std::lower_bound(ids.begin(), ids.end(), cell) - ids.begin());
  };
  cell_steps = std::move(steps);
  parallel_for("GALE::reached_cells", HostExecutionSpace(), count, [&](Offset i) {
    auto& [cell, next] = cell_steps[i];
    cell = place_of(cell);
    next = step_to(next, place_of);
  });
}

void FoundForRanks::number_vertices() {
  for (FoundFor& found : found_) {
    bool has_any = !found.more_vertices.empty();
    for_each_list_of(found, [&](auto& list) { has_any = has_any || !list.empty(); });
    if (has_any) number_vertices(found);
  }
}

/// Numbers vertices by ascending ids.
void FoundForRanks::number_vertices(FoundFor& found) const {
  const Mesh& mesh = order_.mesh();
  NumberedSet reached(mesh.vertices());
  for_each_vertex_of(found, [&](Id vertex) { reached.insert(vertex); });
  for (const Id vertex : found.more_vertices) reached.insert(vertex);
  reached.number();
  found.vertices.resize(reached.count());
  const OtherIds input = mesh.vertices_in_input();
  std::vector<Id> vertices(reached.count());
  reached.for_each("GALE::reached_vertices", [&](Id vertex, Id place) { vertices[place] = vertex; });
  const std::vector<std::uint64_t> values = order_.value_keys_of(vertices);
  parallel_for("GALE::reached_vertices", HostExecutionSpace(), vertices.size(), [&](Offset i) {
    found.vertices[i] = {mesh.vertex_id(input[vertices[i]]), values[i]};
  });
  for_each_vertex_of(found, [&](Id& vertex) { vertex = reached[vertex]; });
}

std::vector<std::int64_t> FoundForRanks::bytes() const {
  std::vector<std::int64_t> bytes;
  for (const FoundFor& found : found_) {
    std::int64_t all = 0;
    for_each_list_of(found, [&](auto& list) { all += static_cast<std::int64_t>(list.size() * sizeof(list[0])); });
    bytes.push_back(all);
  }
  return bytes;
}

Reached FoundForRanks::send() {
  const Ranks& ranks = order_.mesh().exchange().ranks();
  Reached sent;
  together(ranks, [&] { join_all(found_, sent, std::make_index_sequence<std::tuple_size_v<decltype(sent.all())>>()); });
  Reached reached;
  reached.all() = std::apply(
      [&](auto&... lists) { return exchange_lists(ranks, "GALE::received_reached", std::move(lists)...); }, sent.all());
  return reached;
}

}  // namespace gale::detail
