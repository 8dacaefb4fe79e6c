#include <functional>
#include <limits>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/positions.hpp>
#include <gale/outputs/arrows.hpp>

namespace gale::outputs {

namespace {

/// How many simplices of `sorted`, which are by ascending input id, have a lower one than `id`.
Id count_before(const std::vector<Id>& sorted, const OtherIds& input, Id id) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), id,
                                   [input](Id simplex, Id other) { return input[simplex] < other; });
  return static_cast<Id>(at - sorted.begin());
}

template <class Coordinate>
class Arrows {
 public:
  Arrows(const io::Dataset::Points<Coordinate>& points, const DiscreteGradient& gradient)
      : points_(points),
        gradient_(gradient),
        mesh_(gradient.mesh()),
        input_(mesh_.vertices_in_input()),
        edge_begin_(allocate<Array<Id, HostMemory>>("GALE::arrows_of_edges", mesh_.vertices() + 1)) {}

  io::PointSet draw() {
    const Id of_vertices = mesh_.vertices() - static_cast<Id>(gradient_.critical().vertices.size());
    const Id of_cells = mesh_.cells() - static_cast<Id>(gradient_.critical().cells.size());
    const Id of_edges = mesh_.dimension() == 3 ? place_edges() : 0;
    const Offset count = Offset(of_vertices) + of_edges + of_cells;
    require_ids("arrows", count);
    tails_ = allocate<io::Dataset::Points<Coordinate>>("GALE::tails", count);
    vectors_.resize(3 * count);
    dimensions_.resize(count);
    draw_vertices();
    if (mesh_.dimension() == 3) {
      draw_edges(of_vertices);
      draw_triangles(of_vertices + of_edges);
    } else {
      draw_edges_of_triangles(of_vertices);
    }
    return {tails_, {{"CellDimension", 1, std::move(dimensions_)}, {"Vector", 3, std::move(vectors_)}}};
  }

 private:
  /// Finds where the arrows of each vertex's lower edges begin among those of all edges, by input id. Returns how many
  /// arrows edges have.
  Id place_edges() {
    const OtherIds internal = mesh_.vertices_of_input();
    const auto count = [&](Offset i) {
      Id pairs = 0;
      gradient_.for_each_edge_pair(internal[i], [&](Id, Id) { ++pairs; });
      return pairs;
    };
    require_ids("arrows", reduce_sum("GALE::count_arrows", HostExecutionSpace(), mesh_.vertices(), count));
    return exclusive_scan("GALE::place_arrows", HostExecutionSpace(), mesh_.vertices(), edge_begin_, count);
  }

  void draw_vertices() {
    parallel_for("GALE::arrows_of_vertices", HostExecutionSpace(), mesh_.vertices(), [&](Offset v) {
      const Id other = gradient_.vertex_successor(v);
      if (other == no_id) return;
      const Id tail = input_[v];
      draw(tail - count_before(gradient_.critical().vertices, input_, tail), std::array<Id, 1>{tail}, input_[other]);
    });
  }

  void draw_edges(Id begin) {
    parallel_for("GALE::arrows_of_edges", HostExecutionSpace(), mesh_.vertices(), [&](Offset high) {
      std::vector<std::array<Id, 2>> pairs;
      gradient_.for_each_edge_pair(high, [&](Id low, Id third) { pairs.push_back({input_[low], input_[third]}); });
      std::sort(pairs.begin(), pairs.end());
      Id place = begin + edge_begin_(input_[high]);
      for (const auto& [low, third] : pairs) draw(place++, std::array<Id, 2>{input_[high], low}, third);
    });
  }

  /// On a triangle mesh, where triangles know their edges.
  void draw_edges_of_triangles(Id begin) {
    struct Pair {
      Id high, low, third;
      bool operator<(const Pair& other) const { return high < other.high || (high == other.high && low < other.low); }
    };
    const std::uint64_t* const keys = gradient_.order().keys();
    const CellReader cell = mesh_.cell_reader();
    std::vector<Pair> pairs(mesh_.cells());
    parallel_for("GALE::arrows_of_edges", HostExecutionSpace(), mesh_.cells(), [&](Offset t) {
      const Partner partner = gradient_.pair_of_cell(t);
      if (partner.is_critical()) {
        pairs[t] = {std::numeric_limits<Id>::max(), 0, 0};
        return;
      }
      const Quad corners = cell(static_cast<Id>(t));
      Id edge[2] = {};
      for (int corner = 0, i = 0; corner < 3; ++corner) {
        if (corners[corner] != partner.vertex) edge[i++] = corners[corner];
      }
      if (keys[edge[0]] < keys[edge[1]]) std::swap(edge[0], edge[1]);
      pairs[t] = {input_[edge[0]], input_[edge[1]], input_[partner.vertex]};
    });
    parallel_sort("GALE::sort_arrows", pairs.begin(), pairs.end(), std::less<Pair>());
    pairs.resize(pairs.size() - gradient_.critical().cells.size());
    parallel_for("GALE::draw_arrows", HostExecutionSpace(), pairs.size(), [&](Offset i) {
      draw(begin + static_cast<Id>(i), std::array<Id, 2>{pairs[i].high, pairs[i].low}, pairs[i].third);
    });
  }

  void draw_triangles(Id begin) {
    const OtherIds cell_input = mesh_.cells_in_input();
    const CellReader cell = mesh_.cell_reader();
    parallel_for("GALE::arrows_of_triangles", HostExecutionSpace(), mesh_.cells(), [&](Offset t) {
      const Partner partner = gradient_.pair_of_cell(t);
      if (partner.is_critical()) return;
      const Quad corners = cell(static_cast<Id>(t));
      std::array<Id, 3> triangle{};
      for (int corner = 0, i = 0; corner < 4; ++corner) {
        if (corners[corner] != partner.vertex) triangle[i++] = input_[corners[corner]];
      }
      const Id tetrahedron = cell_input[t];
      draw(begin + tetrahedron - count_before(gradient_.critical().cells, cell_input, tetrahedron), triangle,
           input_[partner.vertex]);
    });
  }

  /// An arrow from a simplex to its partner, which has the vertex `more` besides.
  template <std::size_t N>
  void draw(Id place, const std::array<Id, N>& simplex, Id more) {
    std::array<Id, N + 1> partner;
    std::copy(simplex.begin(), simplex.end(), partner.begin());
    partner[N] = more;
    const gale::detail::Point tail = gale::detail::barycentre(points_, simplex),
                              head = gale::detail::barycentre(points_, partner);
    for (int axis = 0; axis < 3; ++axis) {
      tails_(place, axis) = static_cast<Coordinate>(tail[axis]);
      vectors_[3 * std::size_t(place) + axis] = static_cast<Coordinate>(head[axis] - tail[axis]);
    }
    dimensions_[place] = static_cast<std::int8_t>(N - 1);
  }

  const io::Dataset::Points<Coordinate>& points_;
  const DiscreteGradient& gradient_;
  const Mesh& mesh_;
  OtherIds input_;
  Array<Id, HostMemory> edge_begin_;
  io::Dataset::Points<Coordinate> tails_;
  std::vector<Coordinate> vectors_;
  std::vector<std::int8_t> dimensions_;
};

}  // namespace

io::PointSet arrows_of(const io::Dataset& dataset, const DiscreteGradient& gradient) {
  return std::visit(
      [&](const auto& points) {
        using Coordinate = typename std::decay_t<decltype(points)>::non_const_value_type;
        return Arrows<Coordinate>(points, gradient).draw();
      },
      dataset.points);
}

}  // namespace gale::outputs
