#include <gale/algorithms/detail/ascending_walls.hpp>

#include <memory>

#include <gale/algorithms/detail/edge_star.hpp>
#include <gale/algorithms/detail/edge_table.hpp>
#include <gale/algorithms/detail/gathered_separatrices.hpp>
#include <gale/base/threads.hpp>

namespace gale::detail {

namespace {

using Edge = std::array<Id, 2>;

/// An edge of a wall, and the tetrahedra around it.
struct Cell {
  Edge edge;
  std::vector<Id> star;
};

/// One thread's part.
class Tracer {
 public:
  Tracer(Structure& structure, const DiscreteGradient& gradient)
      : gradient_(gradient), keys_(gradient.order().keys()), consumer_(structure.consumer()), star_(structure.mesh()) {}

  void follow(Id source, const Edge& critical) {
    seen_.clear();
    seen_.insert(critical[0], critical[1]);
    std::vector<Cell>& cells = walls.cells;
    const std::size_t first = cells.size();
    cells.push_back({critical, {}});
    for (std::size_t i = first; i < cells.size(); ++i) {
      const auto [high, low] = cells[i].edge;
      star_.find(high, low, consumer_->row(Relation::VT, high));
      cells[i].star = star_.around();
      for (const Id third : star_.thirds()) cross({high, low, third});
    }
    walls.sources.push_back(source);
    walls.begin.push_back(static_cast<Offset>(cells.size()));
  }

  Separatrices<Cell> walls;

 private:
  /// To the edge that a triangle is paired with, if it is with one.
  void cross(TriangleVertices triangle) {
    std::sort(triangle.begin(), triangle.end(), [this](Id a, Id b) { return keys_[a] > keys_[b]; });
    for (int i = 1; i < 3; ++i) {
      if (gradient_.triangle_of_lower_edge(triangle[0], triangle[i]) != triangle[3 - i]) continue;
      if (seen_.insert(triangle[0], triangle[i]).second) walls.cells.push_back({{triangle[0], triangle[i]}, {}});
    }
  }

  struct Nothing {};

  const DiscreteGradient& gradient_;
  const std::uint64_t* keys_;
  std::unique_ptr<Consumer> consumer_;
  EdgeStar star_;
  EdgeTable<Nothing> seen_;
};

}  // namespace

AscendingWalls ascending_walls(Structure& structure, const DiscreteGradient& gradient, int threads) {
  const auto& edges = gradient.critical().edges;
  std::vector<std::unique_ptr<Tracer>> tracers(threads);
  in_turns(threads, static_cast<std::int64_t>(edges.size()), [&](int thread, std::int64_t i) {
    if (!tracers[thread]) tracers[thread] = std::make_unique<Tracer>(structure, gradient);
    tracers[thread]->follow(static_cast<Id>(i), edges[i]);
  });
  std::vector<Separatrices<Cell>> found;
  for (auto& tracer : tracers) {
    if (tracer) found.push_back(std::move(tracer->walls));
  }
  const auto all = gathered(found, false);
  AscendingWalls walls;
  walls.walls.sources = all.sources;
  walls.walls.begin = all.begin;
  for (const Cell& cell : all.cells) {
    walls.walls.cells.push_back(cell.edge);
    walls.star.insert(walls.star.end(), cell.star.begin(), cell.star.end());
    walls.star_begin.push_back(static_cast<Offset>(walls.star.size()));
  }
  return walls;
}

}  // namespace gale::detail
