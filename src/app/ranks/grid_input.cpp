#include <algorithm>
#include <sstream>
#include <utility>

#include <gale/app/ranks/shared_input.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

namespace {

/// How a grid is dealt out: the layers of rank r are those from begin[r] on, before begin[r + 1].
struct DealtLayers {
  std::array<Id, 3> points;
  bool is_whole;
  std::vector<Id> begin;         ///< the first layer of each rank, and one past the last
  std::vector<Offset> vertices;  ///< how many vertices come before that layer

  int axis() const { return points[2] == 1 ? 1 : 2; }
  Id rows_of_layer() const { return axis() == 2 ? points[1] : 1; }
  Interval of(int rank) const { return {begin[rank], begin[rank + 1]}; }

  /// Layers that a rank knows the vertices of.
  Interval around(int rank) const {
    const Interval own = of(rank);
    if (own.size() == 0) return own;
    return {std::max(own.first - 1, 0), std::min(own.last + 1, points[axis()])};
  }
};

DealtLayers deal(const Grid& grid, int ranks) {
  const GridView view = grid.in<HostMemory>();
  DealtLayers dealt{grid.points(), grid.is_whole(), {}, {}};
  const Id layers = dealt.points[dealt.axis()];
  const auto before = [&](Id layer) -> Offset {
    if (layer == layers) return grid.vertices();
    return dealt.axis() == 2 ? view.vertex_at(0, 0, layer) : view.vertex_at(0, layer, 0);
  };
  dealt.begin = detail::shared_layers(layers, ranks, before);
  for (const Id layer : dealt.begin) dealt.vertices.push_back(before(layer));
  return dealt;
}

/// What the first rank says, to all. Collective.
DealtLayers tell(const Ranks& ranks, const DealtLayers& said) {
  std::ostringstream out;
  for (const Id points : said.points) out << points << ' ';
  out << said.is_whole << ' ';
  for (const Id layer : said.begin) out << layer << ' ';
  for (const Offset vertex : said.vertices) out << vertex << ' ';
  std::istringstream in(ranks.broadcast(out.str(), 0));
  DealtLayers heard{{}, false, std::vector<Id>(ranks.size() + 1), std::vector<Offset>(ranks.size() + 1)};
  for (Id& points : heard.points) in >> points;
  in >> heard.is_whole;
  for (Id& layer : heard.begin) in >> layer;
  for (Offset& vertex : heard.vertices) in >> vertex;
  return heard;
}

/// The bits of the vertices that this rank knows. Collective.
Array<std::uint64_t, HostMemory> bits_of(const Ranks& ranks, const DealtLayers& dealt,
                                         const std::optional<Grid>& grid) {
  detail::EntriesByRank<std::uint64_t> sent;
  detail::together(ranks, [&] {
    const Offset words = static_cast<Offset>(Grid::words_of_row(dealt.points[0])) * dealt.rows_of_layer();
    std::vector<std::int64_t> counts;
    for (int rank = 0; rank < ranks.size(); ++rank)
      counts.push_back(grid && !grid->is_whole() ? words * dealt.around(rank).size() : 0);
    sent = detail::room_by_rank<std::uint64_t>("GALE::dealt_bits", counts);
    for (int rank = 0; rank < ranks.size(); ++rank) {
      if (counts[rank] == 0) continue;
      const std::uint64_t* const from = grid->in<HostMemory>().vertices.words + words * dealt.around(rank).first;
      std::copy(from, from + counts[rank], sent.entries.data() + sent.begin[rank]);
    }
  });
  return detail::exchange(ranks, "GALE::bits_of_layers", sent).entries;
}

/// What this rank gets of values of all vertices, `width` each, which the first rank has. Collective.
template <class T>
detail::EntriesByRank<T> deal_values(const Ranks& ranks, const DealtLayers& dealt, T* all, int width) {
  detail::EntriesByRank<T> sent;
  sent.begin.assign(ranks.size() + 1, 0);
  if (ranks.rank() == 0) {
    for (int rank = 0; rank <= ranks.size(); ++rank) sent.begin[rank] = dealt.vertices[rank] * width;
    sent.entries = Array<T, HostMemory>(all, sent.begin.back());
  }
  return detail::exchange(ranks, "GALE::values_of_layers", sent);
}

void deal_array(const Ranks& ranks, const DealtLayers& dealt, io::PointArray& array) {
  std::visit(
      [&](auto& values) {
        const auto mine = deal_values(ranks, dealt, values.data(), array.components);
        values = {};
        detail::together(ranks, [&] { values.assign(mine.entries.data(), mine.entries.data() + mine.count()); });
      },
      static_cast<io::detail::AnyVector&>(array.values));
}

template <class Coordinate>
HostPoints deal_points(const Ranks& ranks, const DealtLayers& dealt, const io::Dataset::Positions& points) {
  const auto* const all = std::get_if<io::Dataset::Points<Coordinate>>(&points);
  const auto mine = deal_values(ranks, dealt, all == nullptr ? nullptr : all->data(), 3);
  return {Points<Coordinate, HostMemory>(mine.entries.data(), mine.count() / 3), mine.entries};
}

}  // namespace

SharedInput make_layers(const Ranks& ranks, const InputOptions& input, const std::array<Id, 3>& points,
                        const WantedOfInput& wanted) {
  const int axis = points[2] == 1 ? 1 : 2;
  const auto begin = detail::shared_layers(
      points[axis], ranks.size(), [&](Id layer) { return Offset(layer) * points[0] * (axis == 2 ? points[1] : 1); });
  GridLayers layers;
  layers.points = points;
  layers.layers = {begin[ranks.rank()], begin[ranks.rank() + 1]};
  io::Dataset made = io::make_layers(points, layers.layers, wanted.arrays || input.height);
  if (input.height) outputs::add_height(made, *input.height);
  if (wanted.arrays) layers.positions = Points<float, HostMemory>(std::get<io::Dataset::Points<float>>(made.points));
  SharedInput shared;
  shared.part = layers;
  const bool is_only_one =
      made.arrays.size() == 1 && (input.read.array.empty() || input.read.array == made.arrays[0].name);
  shared.order =
      is_only_one && !wanted.arrays ? std::move(made.arrays[0]) : outputs::select_field(made, input.read.array);
  if (wanted.arrays) shared.arrays = std::move(made.arrays);
  shared.field = wanted.values ? shared.order : io::PointArray{shared.order.name, 1, {}};
  return shared;
}

void deal_layers(const Ranks& ranks, const std::optional<Grid>& grid, const io::Dataset::Positions& points,
                 const WantedOfInput& wanted, SharedInput& shared) {
  DealtLayers dealt;
  detail::together(ranks, [&] {
    if (grid) dealt = deal(*grid, ranks.size());
  });
  dealt = tell(ranks, dealt);
  GridLayers layers;
  layers.points = dealt.points;
  layers.layers = dealt.of(ranks.rank());
  layers.inside = bits_of(ranks, dealt, grid);
  if (wanted.arrays) {
    layers.positions =
        shared.is_in_float ? deal_points<float>(ranks, dealt, points) : deal_points<double>(ranks, dealt, points);
    for (io::PointArray& array : shared.arrays) deal_array(ranks, dealt, array);
  }
  if (wanted.values) deal_array(ranks, dealt, shared.field);
  deal_array(ranks, dealt, shared.order);
  shared.part = layers;
}

}  // namespace gale::app
