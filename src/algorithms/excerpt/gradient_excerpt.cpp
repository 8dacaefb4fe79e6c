#include <memory>
#include <optional>
#include <utility>

#include <gale/algorithms/excerpt/excerpt_mesh.hpp>
#include <gale/algorithms/excerpt/gradient_excerpt.hpp>
#include <gale/algorithms/excerpt/received_numbers.hpp>
#include <gale/algorithms/gathered_gradient.hpp>
#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>
#include <gale/base/error.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/exchange/global_index.hpp>
#include <gale/runtime/ways.hpp>

namespace gale::detail {

namespace {

/// Makes an excerpt of what was received.
class ExcerptMaker {
 public:
  ExcerptMaker(Reached reached, int dimension)
      : reached_(std::move(reached)), dimension_(dimension), vertices_(reached_.vertices), cells_(reached_.cells) {}

  DiscreteGradient make() {
    const Mesh mesh = make_mesh();
    const VertexOrder order = order_of(mesh);
    const auto store = std::make_shared<GradientStore>(mesh, order, 1);
    internal_cell_.resize(mesh.cells());
    for (Id t = 0; t < mesh.cells(); ++t) internal_cell_[mesh.cell_input()(t)] = t;
    fill(mesh, store->sink(0));
    store->finish();
    return DiscreteGradient(store);
  }

 private:
  Mesh make_mesh() const {
    const auto& cells = reached_.cells;
    return dimension_ == 3 ? excerpt_mesh(vertices_.ids, cells_.ids, received_corners<4>(vertices_, cells_, cells))
                           : excerpt_mesh(vertices_.ids, cells_.ids, received_corners<3>(vertices_, cells_, cells));
  }

  VertexOrder order_of(const Mesh& mesh) const {
    return excerpt_order(mesh, [&](Id v) { return reached_.vertices.entries(vertices_.first(v)).value; });
  }

  void fill(const Mesh& mesh, const ConsumerSink& sink) const {
    for (Id v = 0; v < mesh.vertices(); ++v) sink.vertex_successor[v] = DiscreteGradient::elsewhere;
    for (Id t = 0; t < mesh.cells(); ++t) sink.cell_successor[t] = DiscreteGradient::elsewhere;
    if (dimension_ == 3) fill_rows(mesh, sink);
    for_each_received(reached_.edges, [&](int rank, const auto& edge) {
      const Id high = vertices_.of(rank, edge[0]), low = vertices_.of(rank, edge[1]);
      if (edge[2] == edge_is_critical) sink.add_critical_edge(high, low);
      if (edge[2] == edge_has_vertex) sink.vertex_successor[high] = low;
    });
    for_each_received(reached_.vertex_steps, [&](int rank, const auto& step) {
      sink.set_vertex(vertices_.of(rank, step[0]), step[1] == no_id ? no_id : vertices_.of(rank, step[1]));
    });
    for_each_received(reached_.cell_steps, [&](int rank, const auto& step) { fill_cell(mesh, sink, rank, step); });
    for_each_received(reached_.cell_forks, [&](int rank, const auto& fork) {
      sink.add_successor(cell(rank, fork[0]), cell(rank, fork[1]));
    });
    for_each_received(reached_.critical_triangles,
                      [&](int rank, const auto& triangle) { sink.add_critical_triangle(simplex(rank, triangle)); });
    for_each_received(reached_.critical_stars, [&](int rank, const auto& in_star) {
      sink.add_to_star(simplex(rank, std::array<Id, 3>{in_star[0], in_star[1], in_star[2]}), cell(rank, in_star[3]));
    });
  }

  Id cell(int rank, Id place) const { return internal_cell_[cells_.of(rank, place)]; }

  std::array<Id, 3> simplex(int rank, std::array<Id, 3> places) const {
    for (Id& at : places) at = at == no_id ? no_id : vertices_.of(rank, at);
    return places;
  }

  /// What is outside is behind a vertex: corners are in another order here.
  void fill_cell(const Mesh& mesh, const ConsumerSink& sink, int rank, const std::array<Id, 2>& step) const {
    const Id from = cell(rank, step[0]);
    if (step[1] == no_id) return sink.add_critical_cell(from);
    if (step[1] >= 0) return sink.set_cell(from, cell(rank, step[1]));
    const auto& corners = reached_.cells.entries(reached_.cells.begin[rank] + step[0]).corners;
    const Id opposite = vertices_.of(rank, corners[corner_of_step(step[1])]);
    const auto& encoded = mesh.encoded().cells;
    int corner = 0;
    while (corner < 3 && encoded(from, corner) != opposite) ++corner;
    sink.set_cell(from, outside(corner));
  }

  /// A row has the lower ends of edges, and what these are paired with.
  void fill_rows(const Mesh& mesh, const ConsumerSink& sink) const {
    std::vector<std::uint64_t> in_rows;
    std::vector<std::pair<std::uint64_t, Id>> pairs;
    for_each_received(reached_.edges, [&](int rank, const auto& edge) {
      const Id high = vertices_.of(rank, edge[0]), low = vertices_.of(rank, edge[1]);
      in_rows.push_back(pair_key(high, low));
      if (edge[2] < 0) return;
      const Id third = vertices_.of(rank, edge[2]);
      in_rows.push_back(pair_key(high, third));
      pairs.emplace_back(pair_key(high, low), third);
    });
    sort_distinct("GALE::sort_rows", in_rows);
    parallel_sort("GALE::sort_pairs", pairs.begin(), pairs.end());
    auto at = in_rows.begin();
    auto next = pairs.begin();
    for (Id high = 0; high < mesh.vertices(); ++high) {
      auto end = at;
      while (end != in_rows.end() && pair_first(*end) == high) ++end;
      EdgePairRow row = sink.begin_edges(high, static_cast<Id>(end - at));
      for (Id i = 0; i < row.size(); ++i) row.set_id(i, pair_second(at[i]));
      for (; next != pairs.end() && pair_first(next->first) == high; ++next)
        row.pair(row.find(pair_second(next->first)), row.find(next->second));
      at = end;
    }
  }

  const Reached reached_;
  const int dimension_;
  const ReceivedNumbers<ReceivedVertex> vertices_;
  const ReceivedNumbers<ReceivedCell> cells_;
  std::vector<Id> internal_cell_;
};

}  // namespace

DiscreteGradient gathered_with_walls(const DiscreteGradient& gradient, bool rising_walls, std::size_t most_bytes) {
  const Mesh& mesh = gradient.mesh();
  WantedWays ways;
  ways.all_for_first = ways.falling_paths = ways.rising_paths = true;
  ways.falling_walls = mesh.dimension() == 3;
  ways.rising_walls = rising_walls;
  std::unique_ptr<Structure> rows;
  together(mesh.exchange().ranks(), [&] {
    if (rising_walls) rows = std::make_unique<InlineStructure>(mesh, discrete_gradient_relations);
  });
  return excerpt_of(gradient, ways, rows.get(), most_bytes);
}

DiscreteGradient excerpt_of(const DiscreteGradient& gradient, const WantedWays& ways, Structure* rows,
                            std::size_t most_bytes) {
  Reached reached = reach(gradient, ways, rows, most_bytes);
  std::optional<DiscreteGradient> excerpt;
  together(gradient.mesh().exchange().ranks(),
           [&] { excerpt = ExcerptMaker(std::move(reached), gradient.mesh().dimension()).make(); });
  return *excerpt;
}

}  // namespace gale::detail

namespace gale {

DiscreteGradient gather_gradient(const DiscreteGradient& gradient, std::size_t most_bytes) {
  if (gradient.mesh().exchange().ranks().size() == 1) return gradient;
  return detail::gathered_with_walls(gradient, false, most_bytes);
}

}  // namespace gale
