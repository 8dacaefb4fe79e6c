#include <algorithm>

#include <gale/algorithms/order/ordered_bits.hpp>
#include <gale/app/ranks/complex_pieces.hpp>
#include <gale/distributed/sums_by_id.hpp>
#include <gale/mesh/positions.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/line_arrays.hpp>

namespace gale::app {

namespace {

enum Type : std::int8_t { falling = 0, rising = 2 };

/// A vertex in the order of all ranks, and the field's value there.
struct Height {
  std::uint64_t order = 0;  ///< compares as what the order was made from
  GlobalId vertex = -1;
  double value = 0;

  bool operator<(const Height& other) const {
    return order != other.order ? order < other.order : vertex < other.vertex;
  }
};

/// What a separatrix says of a critical simplex at one of its ends.
struct End {
  Height highest, lowest;
  std::int8_t on_surface = 0;
};

std::vector<End> ends_of(const FieldOnRanks& on, const std::vector<outputs::CriticalSimplex>& simplices) {
  const auto height = [&](Id vertex) {
    return std::visit(
        [&](const auto& order) -> Height {
          return {detail::ordered_bits(order[vertex]), on.mesh.vertex_id(vertex), outputs::value_at(on.field, vertex)};
        },
        on.order_from.values);
  };
  std::vector<End> ends;
  for (const auto& simplex : simplices)
    ends.push_back({height(simplex.highest()), height(simplex.lowest()), simplex.on_surface});
  return ends;
}

/// The separatrices of one kind, and what is known of both their ends. `ids` are the CellIds of what precedes cells.
struct Kind {
  Type type;
  int dimension;  ///< of the cells
  const DistributedSeparatrices& paths;
  const GlobalId* between_ids;
  std::vector<End> sources;         ///< by place among this rank's
  Array<End, HostMemory> last;      ///< of each path
  Array<GlobalId, HostMemory> ids;  ///< the number of each source's first path, among those of the kind; then how many
};

/// Asks what is known of the critical simplices where the paths end, which may be of any rank. Collective.
Kind kind_of(const FieldOnRanks& on, Type type, const DistributedSeparatrices& paths, const GlobalId* between_ids,
             const std::vector<outputs::CriticalSimplex>& sources,
             const std::vector<outputs::CriticalSimplex>& destinations, const std::vector<GlobalId>& destination_ids) {
  using Ids = Array<const GlobalId, HostMemory>;
  const Communicator& ranks = on.mesh.ranks();
  Kind kind{type, type == falling ? 0 : 3, paths, between_ids, {}, {}, {}};
  std::vector<End> ends;
  std::vector<GlobalId> wanted, source_places, source_paths;
  detail::together(ranks, [&] {
    kind.sources = ends_of(on, sources);
    ends = ends_of(on, destinations);
    for (Offset i = 0; i < paths.count(); ++i) {
      wanted.push_back(paths.cells[paths.begin[i + 1] - 1]);
      if (source_places.empty() || source_places.back() != paths.sources[i]) {
        source_places.push_back(paths.sources[i]);
        source_paths.push_back(0);
      }
      ++source_paths.back();
    }
  });
  const detail::HomeTable<End> table(
      ranks, Ids(destination_ids.data(), destination_ids.size()), [&](Id i) { return ends[i]; },
      [](int, const End& end) { return end; });
  kind.last = table.find(ranks, Ids(wanted.data(), wanted.size()));
  kind.ids = detail::sums_before(ranks, Ids(source_places.data(), source_places.size()),
                                 Ids(source_paths.data(), source_paths.size()));
  return kind;
}

/// Collects the lines of one kind after the other.
template <class Coordinate>
class Lines {
 public:
  Lines(const io::PointArray& field, Offset cells, Offset paths) : field_(field), arrays_(cells, paths) {}

  /// The paths of all ranks are numbered from `first` on.
  void add(const Kind& kind, GlobalId first) {
    const DistributedSeparatrices& paths = kind.paths;
    GlobalId number = 0;
    Offset sources = 0;
    for (Offset i = 0; i < paths.count(); ++i) {
      const Offset begin = paths.begin[i], end = paths.begin[i + 1];
      const bool is_new = i == 0 || paths.sources[i] != paths.sources[i - 1];
      number = is_new ? kind.ids(sources++) : number + 1;
      for (Offset k = begin; k < end; ++k) {
        add_point(paths.between_points[k], kind.between_ids[k], kind.dimension == 0 ? 1 : 2, k == begin);
        add_point(paths.points[k], paths.cells[k], kind.dimension, k + 1 == end);
      }
      add_lines(kind, i, first + number);
    }
  }

  io::Surface take() { return arrays_.take(field_); }

 private:
  void add_point(const detail::Point& at, GlobalId id, int dimension, bool is_end) {
    arrays_.set_point(points_++, at, id, dimension, is_end);
  }

  /// Between the points of the i-th path, which were added last.
  void add_lines(const Kind& kind, Offset i, GlobalId number) {
    const DistributedSeparatrices& paths = kind.paths;
    const Offset points = 2 * (paths.begin[i + 1] - paths.begin[i]), begin = points_ - points;
    const End &source = kind.sources[paths.sources_here[i]], &last = kind.last(i);
    arrays_.set_lines(lines_, points - 1, begin, arrays_.id(points_ - 1),
                      {arrays_.id(begin), number, kind.type, std::max(source.highest, last.highest).value,
                       std::min(source.lowest, last.lowest).value, source.on_surface + last.on_surface});
    lines_ += points - 1;
  }

  const io::PointArray& field_;
  outputs::detail::LineArrays<Coordinate, GlobalId> arrays_;
  Offset points_ = 0, lines_ = 0;  ///< so far
};

}  // namespace

io::Surface separatrices1(const FieldOnRanks& on, const DistributedGradient& gradient,
                          const DistributedSeparatrices& descending, const DistributedSeparatrices& ascending,
                          const DistributedNumbers& numbers) {
  const DistributedCriticalSimplices critical = gradient.critical();
  const outputs::KnownSimplices known = known_simplices(gradient, numbers);
  const Kind down = kind_of(on, falling, descending, numbers.edges.data() + critical.edges.size(), known[1], known[0],
                            critical.vertices);
  const Kind up = kind_of(on, rising, ascending, numbers.triangles.data() + critical.triangles.size(), known[2],
                          known[3], critical.tetrahedra);
  io::Surface surface;
  detail::together(on.mesh.ranks(), [&] {
    const auto cells = static_cast<Offset>(descending.cells.size() + ascending.cells.size());
    const Offset paths = descending.count() + ascending.count();
    const auto fill = [&](auto lines) {
      lines.add(down, 0);
      lines.add(up, down.ids(down.ids.extent(0) - 1));
      surface = lines.take();
    };
    std::holds_alternative<io::Dataset::Points<float>>(on.local.points) ? fill(Lines<float>(on.field, cells, paths))
                                                                        : fill(Lines<double>(on.field, cells, paths));
  });
  return surface;
}

}  // namespace gale::app
