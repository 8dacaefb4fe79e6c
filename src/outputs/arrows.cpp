#include <algorithm>
#include <functional>
#include <limits>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/positions.hpp>
#include <gale/outputs/arrows.hpp>

namespace gale::outputs {

namespace {

template <class Coordinate>
class Arrows {
 public:
  Arrows(const io::Dataset::Points<Coordinate>& points, const DiscreteGradient& gradient)
      : points_(points), gradient_(gradient), mesh_(gradient.mesh()), input_(mesh_.vertices_in_input()) {}

  io::PointSet draw() {
    const OtherIds vertex = mesh_.vertices_of_input();
    const auto places_of_vertices =
        begin_at(0, mesh_.vertices(), [&](Offset i) { return gradient_.vertex_successor(vertex[i]) >= 0; });
    const Id edges = places_of_vertices(mesh_.vertices());
    mesh_.dimension() == 3 ? draw_of_tetrahedra(edges) : draw_edges_of_triangles(edges);
    parallel_for("GALE::arrows_of_vertices", HostExecutionSpace(), mesh_.vertices(), [&](Offset v) {
      const Id other = gradient_.vertex_successor(v), tail = input_[v];
      if (other >= 0) draw(places_of_vertices(tail), std::array<Id, 1>{tail}, input_[other]);
    });
    return {tails_, {{"CellDimension", 1, std::move(dimensions_)}, {"Vector", 3, std::move(vectors_)}}};
  }

 private:
  /// Where the arrows of each of `items` begin that has as many of them, and where those of all end; the first ones at
  /// `begin`.
  template <class Count>
  static Array<Id, HostMemory> begin_at(Id begin, Offset items, const Count& count) {
    const auto count_of = [&](Offset i) { return static_cast<Id>(count(i)); };
    require_ids("arrows", begin + reduce_sum("GALE::count_arrows", HostExecutionSpace(), items, count_of));
    const auto places = allocate<Array<Id, HostMemory>>("GALE::arrow_places", items + 1);
    exclusive_scan("GALE::place_arrows", HostExecutionSpace(), items, places, count_of);
    parallel_for("GALE::place_arrows", HostExecutionSpace(), items + 1, [&](Offset i) { places(i) += begin; });
    return places;
  }

  void make_room(Id count) {
    tails_ = allocate<io::Dataset::Points<Coordinate>>("GALE::tails", count);
    vectors_.resize(3 * std::size_t(count));
    dimensions_.resize(count);
  }

  /// Whether a cell is paired with one of its facets, as far as this rank knows.
  bool has_facet(Id cell) const {
    const Id next = gradient_.cell_successor(cell);
    return next != no_id && next != DiscreteGradient::elsewhere;
  }

  void draw_of_tetrahedra(Id begin) {
    const OtherIds vertex = mesh_.vertices_of_input();
    const Interval owned = mesh_.owned_vertices();
    const auto of_edges = begin_at(begin, mesh_.vertices(), [&](Offset i) {
      Id pairs = 0;
      if (owned.has(vertex[i])) gradient_.for_each_edge_pair(vertex[i], [&](Id, Id) { ++pairs; });
      return pairs;
    });
    const auto internal = allocate<Array<Id, HostMemory>>("GALE::cells_of_input", mesh_.cells());
    parallel_for("GALE::cells_of_input", HostExecutionSpace(), mesh_.cells(),
                 [&](Offset t) { internal(mesh_.cells_in_input()[t]) = static_cast<Id>(t); });
    const auto of_cells =
        begin_at(of_edges(mesh_.vertices()), mesh_.cells(), [&](Offset i) { return has_facet(internal(i)); });
    make_room(of_cells(mesh_.cells()));
    draw_edges(of_edges);
    draw_triangles(of_cells);
  }

  void draw_edges(const Array<Id, HostMemory>& places) {
    const Interval owned = mesh_.owned_vertices();
    parallel_for("GALE::arrows_of_edges", HostExecutionSpace(), owned.size(), [&](Offset i) {
      const Id high = owned.first + static_cast<Id>(i);
      std::vector<std::array<Id, 2>> pairs;
      gradient_.for_each_edge_pair(high, [&](Id low, Id third) { pairs.push_back({input_[low], input_[third]}); });
      std::sort(pairs.begin(), pairs.end());
      Id place = places(input_[high]);
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
      if (!has_facet(static_cast<Id>(t))) {
        pairs[t] = {std::numeric_limits<Id>::max(), 0, 0};
        return;
      }
      const Partner partner = gradient_.pair_of_cell(t);
      const Quad corners = cell(static_cast<Id>(t));
      Id edge[2] = {};
      for (int corner = 0, i = 0; corner < 3; ++corner) {
        if (corners[corner] != partner.vertex) edge[i++] = corners[corner];
      }
      if (keys[edge[0]] < keys[edge[1]]) std::swap(edge[0], edge[1]);
      pairs[t] = {input_[edge[0]], input_[edge[1]], input_[partner.vertex]};
    });
    parallel_sort("GALE::sort_arrows", pairs.begin(), pairs.end(), std::less<Pair>());
    while (!pairs.empty() && pairs.back().high == std::numeric_limits<Id>::max()) pairs.pop_back();
    require_ids("arrows", begin + static_cast<Offset>(pairs.size()));
    make_room(begin + static_cast<Id>(pairs.size()));
    parallel_for("GALE::draw_arrows", HostExecutionSpace(), pairs.size(), [&](Offset i) {
      draw(begin + static_cast<Id>(i), std::array<Id, 2>{pairs[i].high, pairs[i].low}, pairs[i].third);
    });
  }

  void draw_triangles(const Array<Id, HostMemory>& places) {
    const OtherIds cell_input = mesh_.cells_in_input();
    const CellReader cell = mesh_.cell_reader();
    parallel_for("GALE::arrows_of_triangles", HostExecutionSpace(), mesh_.cells(), [&](Offset t) {
      if (!has_facet(static_cast<Id>(t))) return;
      const Partner partner = gradient_.pair_of_cell(t);
      const Quad corners = cell(static_cast<Id>(t));
      std::array<Id, 3> triangle{};
      for (int corner = 0, i = 0; corner < 4; ++corner) {
        if (corners[corner] != partner.vertex) triangle[i++] = input_[corners[corner]];
      }
      draw(places(cell_input[t]), triangle, input_[partner.vertex]);
    });
  }

  /// An arrow from a simplex to its partner, which has the vertex `more` besides. Sums go by input ids, so that they
  /// don't depend on segments and ranks.
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
