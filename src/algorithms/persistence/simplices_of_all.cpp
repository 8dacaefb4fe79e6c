#include <algorithm>
#include <utility>

#include <gale/algorithms/persistence/simplices_of_all.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>

namespace gale::detail {

namespace {

/// Writes a rank's critical simplices as they are sent.
class Sender {
 public:
  explicit Sender(const DiscreteGradient& gradient)
      : gradient_(gradient),
        exchange_(gradient.mesh().exchange()),
        vertex_input_(gradient.mesh().vertices_in_input()),
        cell_input_(gradient.mesh().cells_in_input()) {}

  /// A simplex with its vertices from the highest to the lowest.
  template <std::size_t N>
  SentSimplex operator()(const std::array<Id, N>& vertices, Id rank) const {
    std::array<GlobalId, N> ids;
    for (std::size_t i = 0; i < N; ++i) ids[i] = id(vertices[i]);
    const std::array<GlobalId, N> name = ascending(ids);
    SentSimplex sent{{}, gradient_.order().value_key(vertices[0]), rank, 0};
    for (std::size_t i = 0; i < N; ++i) {
      sent.name[i] = name[i];
      if (name[i] == ids[0]) sent.place_of_highest = static_cast<Id>(i);
    }
    return sent;
  }

  SentSimplex of_cell(Id cell, Id rank) const {
    const Id vertex = highest_corner(gradient_, cell);
    return {{exchange_.cell_id(cell_input_[cell]), id(vertex), 0}, gradient_.order().value_key(vertex), rank, 1};
  }

 private:
  GlobalId id(Id vertex) const { return exchange_.vertex_id(vertex_input_[vertex]); }

  const DiscreteGradient& gradient_;
  const Exchange& exchange_;
  const OtherIds vertex_input_, cell_input_;
};

/// Entries of all ranks, which ascend by `is_less` on each, in that order.
template <class T, class IsLess>
std::vector<Id> merged(const EntriesByRank<T>& all, std::vector<Id> order, const IsLess& is_less) {
  merge_runs(order.begin(), all.begin, [&](Id a, Id b) { return is_less(all.entries(a), all.entries(b)); });
  return order;
}

}  // namespace

std::array<std::vector<SentSimplex>, 4> simplices_to_send(const DiscreteGradient& gradient,
                                                          const Filtration& filtration) {
  const Sender sender(gradient);
  const CriticalSimplices& critical = gradient.critical();
  std::array<std::vector<SentSimplex>, 4> own;
  const auto add = [&](int dimension, const auto& simplices, const auto& sent_as) {
    const std::vector<Id>& rank = filtration.rank[dimension];
    own[dimension] = std::vector<SentSimplex>(simplices.size());
    parallel_for("GALE::own_simplices", HostExecutionSpace(), simplices.size(),
                 [&](Offset i) { own[dimension][i] = sent_as(simplices[i], rank[i]); });
  };
  add(0, critical.vertices, [&](Id vertex, Id rank) { return sender(std::array<Id, 1>{vertex}, rank); });
  add(1, critical.edges, sender);
  add(2, critical.triangles, sender);
  add(gradient.mesh().dimension(), critical.cells, [&](Id cell, Id rank) { return sender.of_cell(cell, rank); });
  return own;
}

std::vector<SentSimplex> highest_to_send(const DiscreteGradient& gradient) {
  const Id highest = gradient.order().highest(gradient.mesh().owned_vertices());
  if (highest == no_id) return {};
  return {Sender(gradient)(std::array<Id, 1>{highest}, 0)};
}

SimplicesOfAll::SimplicesOfAll(EntriesByRank<SentSimplex> from) : sent(std::move(from)), place{{}, sent.begin} {
  const Offset count = sent.count();
  auto order = unwritten<Id>(count);
  const auto for_each = [&](const auto& body) {
    parallel_for("GALE::places_of_all", HostExecutionSpace(), count, body);
  };
  for_each([&](Offset i) { order[i] = static_cast<Id>(i); });
  place.entries = allocate<Array<Id, HostMemory>>("GALE::places_of_all", count);
  const auto by_name = merged(sent, order, [](const auto& a, const auto& b) { return a.name < b.name; });
  for_each([&](Offset i) { place.entries(by_name[i]) = static_cast<Id>(i); });
  for (std::size_t r = 0; r + 1 < sent.begin.size(); ++r) {
    parallel_for("GALE::own_order", HostExecutionSpace(), sent.count(static_cast<int>(r)), [&](Offset k) {
      const Offset i = sent.begin[r] + k;
      order[sent.begin[r] + sent.entries(i).rank] = static_cast<Id>(i);
    });
  }
  from_rank = merged(sent, std::move(order), [](const auto& a, const auto& b) {
    return a.value != b.value ? a.value < b.value : a.highest() < b.highest();
  });
}

}  // namespace gale::detail
