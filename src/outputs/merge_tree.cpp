#include <algorithm>
#include <cmath>
#include <utility>

#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/base/bits.hpp>
#include <gale/base/error.hpp>
#include <gale/base/hash_table.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/mesh/positions.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/merge_tree.hpp>
#include <gale/outputs/values.hpp>

namespace gale::outputs {

namespace {

using gale::detail::Point;

Point position(const io::Dataset& dataset, Id vertex) {
  return std::visit([&](const auto& points) { return gale::detail::point_of(points, vertex); }, dataset.points);
}

/// Values in the type of the dataset's points.
io::PointArray::Values values_as_points(const io::Dataset& dataset, std::vector<double> values) {
  if (std::holds_alternative<io::Dataset::Points<float>>(dataset.points))
    return std::vector<float>(values.begin(), values.end());
  return values;
}

io::Dataset::Positions positions_like(const io::Dataset& dataset, const std::vector<Point>& points) {
  return std::visit(
      [&](const auto& like) -> io::Dataset::Positions {
        using Coordinate = typename std::decay_t<decltype(like)>::non_const_value_type;
        const io::Dataset::Points<Coordinate> positions("GALE::tree_points", points.size());
        for (std::size_t i = 0; i < points.size(); ++i) gale::detail::store(points[i], positions, i);
        return positions;
      },
      dataset.points);
}

/// The distance of each arc's ends.
std::vector<double> spans_of(const io::Dataset& dataset, const MergeTree& tree) {
  std::vector<double> spans;
  for (const MergeArc& arc : tree.arcs) {
    const Point a = position(dataset, tree.vertices[arc.lower]), b = position(dataset, tree.vertices[arc.upper]);
    spans.push_back(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  return spans;
}

std::int8_t region_type(const MergeTree& tree, const MergeArc& arc) {
  const CriticalType ends[2] = {tree.types[arc.lower], tree.types[arc.upper]};
  const auto one_is = [&](CriticalType type) { return ends[0] == type || ends[1] == type; };
  const auto both_are = [&](CriticalType type) { return ends[0] == type && ends[1] == type; };
  if (one_is(CriticalType::minimum)) return 0;
  if (one_is(CriticalType::maximum)) return 1;
  return both_are(CriticalType::saddle1) ? 2 : both_are(CriticalType::saddle2) ? 3 : 4;
}

/// The last arc of each node; no_id where it has none.
std::vector<Id> arcs_of_nodes(const MergeTree& tree) {
  std::vector<Id> arc_of(tree.vertices.size(), no_id);
  for (std::size_t i = 0; i < tree.arcs.size(); ++i)
    arc_of[tree.arcs[i].lower] = arc_of[tree.arcs[i].upper] = static_cast<Id>(i);
  return arc_of;
}

/// Sums over the vertices of equally high parts of arcs, for the parts that have any.
class ArcSamples {
 public:
  ArcSamples(const io::Dataset& dataset, const io::PointArray& field, const MergeTree& tree, int samples,
             const std::vector<ArcVertex>& gathered)
      : samples_(samples) {
    if (samples == 0) return;
    for (const ArcVertex& vertex : gathered) add(field, tree, vertex);
    if (!tree.excerpt) {
      std::vector<bool> is_node(tree.arc_of.size(), false);
      for (const Id vertex : tree.vertices) is_node[vertex] = true;
      for (std::size_t v = 0; v < is_node.size(); ++v) {
        const Id vertex = static_cast<Id>(v);
        if (!is_node[v]) add(field, tree, {vertex, tree.arc_of[v], value_at(field, vertex), position(dataset, vertex)});
      }
    }
    parallel_sort("GALE::sort_arc_samples", sums_.begin(), sums_.end(),
                  [](const Sum& a, const Sum& b) { return a.part < b.part; });
  }

  /// Calls visit(position, value) for the parts of an arc that have vertices, upwards.
  template <class Visit>
  void for_each(Id arc, const Visit& visit) const {
    auto sum = std::lower_bound(sums_.begin(), sums_.end(), pair_key(arc, 0),
                                [](const Sum& one, std::uint64_t part) { return one.part < part; });
    for (; sum != sums_.end() && pair_first(sum->part) == arc; ++sum)
      visit(Point{sum->at[0] / sum->count, sum->at[1] / sum->count, sum->at[2] / sum->count}, sum->value / sum->count);
  }

 private:
  struct Sum {
    std::uint64_t part;  ///< of an arc, as pair_key has them
    Point at{};
    double value = 0;
    Id count = 0;
  };

  void add(const io::PointArray& field, const MergeTree& tree, const ArcVertex& vertex) {
    const MergeArc& arc = tree.arcs[vertex.arc];
    const double low = value_at(field, tree.vertices[arc.lower]), high = value_at(field, tree.vertices[arc.upper]);
    if (vertex.value < low || vertex.value > high) return;                 // as in meshes with holes
    const double height = (vertex.value - low) / (high - low) * samples_;  // NaN where nothing has a height
    const std::uint64_t part = pair_key(vertex.arc, height > 0 ? static_cast<Id>(std::min(height, samples_ - 1.0)) : 0);
    const auto [place, is_new] = places_.insert(part);
    if (is_new) {
      place = static_cast<Id>(sums_.size());
      sums_.push_back({part});
    }
    Sum& sum = sums_[place];
    for (int axis = 0; axis < 3; ++axis) sum.at[axis] += vertex.at[axis];
    sum.value += vertex.value;
    ++sum.count;
  }

  const int samples_;
  HashTable<Id> places_;  ///< of parts among the sums
  std::vector<Sum> sums_;
};

}  // namespace

Tree tree_named(const std::string& name) {
  const auto at = std::find(std::begin(tree_names), std::end(tree_names), name);
  if (at == std::end(tree_names)) throw Error("there is no tree '" + name + "'");
  return static_cast<Tree>(at - std::begin(tree_names));
}

io::PointSet tree_nodes(const io::Dataset& dataset, const io::PointArray& field, const MergeTree& tree) {
  const std::vector<double> all_spans = spans_of(dataset, tree);
  const std::vector<Id> arc_of = arcs_of_nodes(tree);
  const Exchange& exchange = tree.excerpt ? tree.excerpt->exchange() : Exchange::of_whole_mesh();
  std::vector<GlobalId> ids;
  for (const Id vertex : tree.vertices) ids.push_back(exchange.vertex_id(vertex));
  std::vector<Point> points;
  std::vector<Id> numbers, sizes;
  std::vector<double> values, spans;
  std::vector<std::int8_t> types;
  for (std::size_t i = 0; i < tree.vertices.size(); ++i) {
    const Id vertex = tree.vertices[i], arc = arc_of[i];
    points.push_back(position(dataset, vertex));
    numbers.push_back(static_cast<Id>(i));
    values.push_back(value_at(field, vertex));
    types.push_back(static_cast<std::int8_t>(tree.types[i]));
    sizes.push_back(arc == no_id ? 0 : tree.arcs[arc].size);
    spans.push_back(arc == no_id ? 0 : all_spans[arc]);
  }
  io::PointSet set;
  set.points = positions_like(dataset, points);
  for (const auto& array : dataset.arrays) set.arrays.push_back(io::gather(array, tree.vertices));
  set.arrays.push_back({"NodeId", 1, std::move(numbers)});
  set.arrays.push_back({"Scalar", 1, detail::values_as(field, std::move(values))});
  set.arrays.push_back({"VertexId", 1, detail::ids_as(exchange, std::move(ids))});
  set.arrays.push_back({"CriticalType", 1, std::move(types)});
  set.arrays.push_back({"RegionSize", 1, std::move(sizes)});
  set.arrays.push_back({"RegionSpan", 1, values_as_points(dataset, std::move(spans))});
  return set;
}

std::vector<ArcVertex> gather_arc_vertices(const Mesh& mesh, const io::Dataset& dataset, const io::PointArray& field,
                                           const MergeTree& tree, int samples) {
  if (!tree.excerpt || samples == 0) return {};
  const Ranks& ranks = mesh.exchange().ranks();
  std::vector<Id> inner;  // of the vertices, those that are no nodes
  const OtherIds input = mesh.vertices_in_input();
  gale::detail::together(ranks, [&] {
    std::vector<bool> is_node(mesh.vertices(), false);
    for (const Id vertex : tree.vertices) {
      const Id here = mesh.vertex_of(tree.excerpt->vertex_id(vertex));
      if (here != no_id) is_node[here] = true;
    }
    for (const Id v : mesh.owned_vertices())
      if (!is_node[input[v]]) inner.push_back(input[v]);
  });
  std::vector<std::int64_t> bytes(ranks.size(), 0);
  bytes[0] = static_cast<std::int64_t>(inner.size() * sizeof(ArcVertex));
  gale::detail::require_room(ranks, "what arcs are sampled at", bytes, 0);
  const auto received = gale::detail::exchange(
      ranks, "GALE::arc_vertices_of_all",
      gale::detail::collect_by_rank<ArcVertex>(
          ranks, "GALE::arc_vertices", static_cast<Offset>(inner.size()), [](Id) { return 0; },
          [&](Id i) -> ArcVertex {
            const Id vertex = inner[i];
            return {mesh.vertex_id(vertex), tree.arc_of[vertex], value_at(field, vertex), position(dataset, vertex)};
          }));
  std::vector<ArcVertex> all;
  gale::detail::together(ranks, [&] {
    all.assign(received.entries.data(), received.entries.data() + received.count());
    parallel_sort("GALE::sort_arc_vertices", all.begin(), all.end(),
                  [](const ArcVertex& a, const ArcVertex& b) { return a.id < b.id; });
  });
  return all;
}

io::Surface tree_arcs(const io::Dataset& dataset, const io::PointArray& field, const MergeTree& tree, int samples,
                      const std::vector<ArcVertex>& gathered) {
  const ArcSamples between(dataset, field, tree, samples, gathered);
  std::vector<Point> points;
  std::vector<double> values;
  for (const Id vertex : tree.vertices) {
    points.push_back(position(dataset, vertex));
    values.push_back(value_at(field, vertex));
  }
  io::Surface lines;
  std::vector<Id> numbers, upper, lower, sizes;
  for (std::size_t i = 0; i < tree.arcs.size(); ++i) {
    const MergeArc& arc = tree.arcs[i];
    lines.lines.points.push_back(arc.lower);
    between.for_each(static_cast<Id>(i), [&](const Point& at, double value) {
      lines.lines.points.push_back(static_cast<Id>(points.size()));
      points.push_back(at);
      values.push_back(value);
    });
    lines.lines.points.push_back(arc.upper);
    lines.lines.begin.push_back(static_cast<std::int64_t>(lines.lines.points.size()));
    numbers.push_back(static_cast<Id>(i));
    upper.push_back(arc.upper);
    lower.push_back(arc.lower);
    sizes.push_back(arc.size);
  }
  std::vector<std::int8_t> mask(points.size(), 1);
  std::fill_n(mask.begin(), tree.vertices.size(), std::int8_t(0));
  lines.points = positions_like(dataset, points);
  lines.point_arrays.push_back({"Scalar", 1, detail::values_as(field, std::move(values))});
  lines.point_arrays.push_back({"RegularMask", 1, std::move(mask)});
  lines.cell_arrays.push_back({"SegmentationId", 1, std::move(numbers)});
  lines.cell_arrays.push_back({"upNodeId", 1, std::move(upper)});
  lines.cell_arrays.push_back({"downNodeId", 1, std::move(lower)});
  lines.cell_arrays.push_back({"RegionSize", 1, std::move(sizes)});
  lines.cell_arrays.push_back({"RegionSpan", 1, values_as_points(dataset, spans_of(dataset, tree))});
  return lines;
}

std::vector<io::PointArray> tree_segmentation(const io::Dataset& dataset, const MergeTree& tree) {
  const std::vector<double> all_spans = spans_of(dataset, tree);
  std::vector<std::int8_t> all_types;
  for (const MergeArc& arc : tree.arcs) all_types.push_back(region_type(tree, arc));
  const std::size_t count = tree.arc_of.size();
  std::vector<std::int8_t> types(count, -1);
  std::vector<Id> sizes(count, 0);
  std::vector<double> spans(count, 0);
  for (std::size_t v = 0; v < count; ++v) {
    const Id arc = tree.arc_of[v];
    if (arc == no_id) continue;
    types[v] = all_types[arc];
    sizes[v] = tree.arcs[arc].size;
    spans[v] = all_spans[arc];
  }
  return {{"SegmentationId", 1, tree.arc_of},
          {"RegionType", 1, std::move(types)},
          {"RegionSize", 1, std::move(sizes)},
          {"RegionSpan", 1, values_as_points(dataset, std::move(spans))}};
}

}  // namespace gale::outputs
