#include <algorithm>
#include <functional>
#include <memory>
#include <queue>

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/algorithms/morse_smale/edge_star.hpp>
#include <gale/algorithms/morse_smale/gathered_separatrices.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>
#include <gale/base/hash_table.hpp>

namespace gale::detail {

namespace {

using Edge = std::array<Id, 2>;

/// An edge of a wall, and where its tetrahedra are among those that a thread has found.
struct Cell {
  Edge edge;
  int thread;
  Id star_size;
  Offset star_begin;
};

/// Edges of a wall that are still to be crossed. They are taken in passes over the mesh, each by ascending id of the
/// higher end, so that those of one segment come together, however a wall winds.
class Pending {
 public:
  bool empty() const { return ahead_.empty() && behind_.empty(); }

  void add(const Edge& edge) { (edge < last_ ? behind_ : ahead_).push(edge); }

  Edge take() {
    if (ahead_.empty()) ahead_.swap(behind_);
    last_ = ahead_.top();
    ahead_.pop();
    return last_;
  }

 private:
  using Queue = std::priority_queue<Edge, std::vector<Edge>, std::greater<Edge>>;

  Edge last_{};
  Queue ahead_, behind_;
};

/// One thread's part.
class WallTracer {
 public:
  WallTracer(Structure& structure, const DiscreteGradient& gradient, int thread)
      : thread_(thread),
        gradient_(gradient),
        keys_(gradient.order().keys()),
        vertex_input_(structure.mesh().vertices_in_input()),
        consumer_(structure.consumer()),
        star_(structure.mesh()) {}

  void follow(Id source, const Edge& critical) {
    seen_.clear();
    seen_.insert(pair_key(critical[0], critical[1]));
    const auto first = static_cast<std::ptrdiff_t>(walls.cells.size());
    for (Edge edge = critical;; edge = pending_.take()) {
      stop_if_asked();
      const auto [high, low] = edge;
      star_.find(high, low, consumer_->row(Relation::VT, high));
      walls.cells.push_back({edge, thread_, static_cast<Id>(star_.around().size()), static_cast<Offset>(stars.size())});
      stars.insert(stars.end(), star_.around().begin(), star_.around().end());
      for (const Id third : star_.thirds()) cross({high, low, third});
      if (pending_.empty()) break;
    }
    std::sort(walls.cells.begin() + first + 1, walls.cells.end(), [this](const Cell& a, const Cell& b) {
      return written(vertex_input_, a.edge) < written(vertex_input_, b.edge);
    });
    walls.sources.push_back(source);
    walls.begin.push_back(static_cast<Offset>(walls.cells.size()));
  }

  Separatrices<Cell> walls;
  std::vector<Id> stars;

 private:
  /// Goes on to the edge that a triangle is paired with, if there is one.
  void cross(TriangleVertices triangle) {
    std::sort(triangle.begin(), triangle.end(), [this](Id a, Id b) { return keys_[a] > keys_[b]; });
    for (int i = 1; i < 3; ++i) {
      if (gradient_.triangle_of_lower_edge(triangle[0], triangle[i]) != triangle[3 - i]) continue;
      if (seen_.insert(pair_key(triangle[0], triangle[i])).second) pending_.add({triangle[0], triangle[i]});
    }
  }

  struct Nothing {};

  int thread_;
  const DiscreteGradient& gradient_;
  const std::uint64_t* keys_;
  OtherIds vertex_input_;
  std::unique_ptr<Consumer> consumer_;
  EdgeStar star_;
  HashTable<Nothing> seen_;
  Pending pending_;
};

}  // namespace

AscendingWalls ascending_walls(Structure& structure, const DiscreteGradient& gradient, const std::vector<Id>& sources,
                               int threads) {
  if (!sources.empty()) {  // what tracers read comes to the host here, on all threads
    gradient.order().keys();
    gradient.store().pairs();
  }
  std::vector<Edge> edges;
  for (const Id place : sources) edges.push_back(gradient.critical().edges[place]);
  const auto tracers = traced(
      edges, threads, [&](int thread) { return std::make_unique<WallTracer>(structure, gradient, thread); },
      [&](WallTracer& tracer, Id place) { tracer.follow(place, edges[place]); });
  auto all = gathered(tracers, &WallTracer::walls, &Separatrices<Cell>::sources, static_cast<Id>(edges.size()));
  AscendingWalls walls;
  for (const Id i : all.sources) walls.walls.sources.push_back(sources[i]);
  walls.walls.begin = std::move(all.begin);
  const Offset count = static_cast<Offset>(all.cells.size());
  walls.walls.cells.resize(count);
  walls.star_begin.resize(count + 1);
  for (Offset i = 0; i < count; ++i) walls.star_begin[i + 1] = walls.star_begin[i] + all.cells[i].star_size;
  walls.star.resize(walls.star_begin[count]);
  parallel_for("GALE::gather_stars", HostExecutionSpace(), count, [&](Offset i) {
    const Cell& cell = all.cells[i];
    walls.walls.cells[i] = cell.edge;
    const Id* const star = tracers[cell.thread]->stars.data() + cell.star_begin;
    std::copy(star, star + cell.star_size, walls.star.data() + walls.star_begin[i]);
  });
  return walls;
}

}  // namespace gale::detail
