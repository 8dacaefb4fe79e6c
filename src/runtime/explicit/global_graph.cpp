#include <limits>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/runtime/explicit/global_graph.hpp>

namespace gale::detail {

namespace {

/// Where rows of one length begin, for whoever reads them in `Space`.
template <class T, class Space>
Array<T, typename Space::memory_space> even_begin(const Space& space, Id rows, Id length) {
  const auto begin = allocate<Array<T, typename Space::memory_space>>("GALE::row_begin", Offset(rows) + 1);
  parallel_for(
      "GALE::row_begin", space, Offset(rows) + 1, KOKKOS_LAMBDA(Offset i) { begin(i) = static_cast<T>(length * i); });
  return begin;
}

}  // namespace

GlobalGraph::Offsets row_begin(const GlobalGraph& graph) {
  return graph.length == 0 ? graph.begin : even_begin<Offset>(WorkerSpace(), graph.rows, graph.length);
}

GlobalRows to_host(const GlobalGraph& graph) {
  if (graph.length != 0)
    return {even_begin<Id>(Kokkos::DefaultHostExecutionSpace(), graph.rows, graph.length), on_host(graph.ids)};
  const auto begin = graph.begin;
  const auto offsets = allocate<Array<Id, WorkerMemory>>("GALE::row_begin", begin.extent(0));
  parallel_for(
      "GALE::row_begin", WorkerSpace(), begin.extent(0),
      KOKKOS_LAMBDA(Offset i) { offsets(i) = static_cast<Id>(begin(i)); });
  return {on_host(offsets), on_host(graph.ids)};
}

std::string label_of(Relation relation) { return "GALE::" + name_of(relation); }

void require_countable(Relation relation, Offset entries) {
  constexpr Offset most = std::numeric_limits<Id>::max();
  if (entries <= most) return;
  throw Error("the explicit structure can't hold the " + std::to_string(entries) + " entries of " + name_of(relation) +
              ": at most " + std::to_string(most) + " fit");
}

}  // namespace gale::detail
