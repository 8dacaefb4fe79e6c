#include <array>
#include <memory>
#include <utility>

#include <gale/algorithms/excerpt/excerpt_mesh.hpp>
#include <gale/algorithms/excerpt/gathering.hpp>
#include <gale/algorithms/excerpt/whole_mesh.hpp>
#include <gale/base/error.hpp>

namespace gale::detail {

namespace {

/// The grid that all ranks have layers of, if it has all its cubes. Collective.
std::optional<std::array<Id, 3>> shared_grid(const Ranks& ranks, const Mesh& mesh) {
  const Grid* const grid = mesh.grid();
  const bool has_any = mesh.owned_vertices().size() > 0, is_one = grid != nullptr && grid->is_whole();
  if (ranks.least(std::int64_t(is_one || !has_any)) == 0) return std::nullopt;
  std::array<Id, 3> points{1, 1, 1};
  const int slowest = mesh.dimension() - 1;
  GlobalId layer = 1;
  for (int axis = 0; axis < slowest; ++axis) {
    points[axis] = static_cast<Id>(-ranks.least(-std::int64_t(has_any ? grid->points()[axis] : 0)));
    layer *= points[axis];
  }
  points[slowest] = static_cast<Id>(mesh.all_vertices() / layer);
  return points;
}

/// Sends what each rank has to the first one.
class WholeGathering {
 public:
  WholeGathering(const VertexOrder& order, bool with_cells) : mesh_(order.mesh()), ranks_(mesh_.exchange().ranks()) {
    together(ranks_, [&] {
      const OtherIds input = mesh_.vertices_in_input();
      vertices = to_first<ReceivedVertex>(mesh_.vertices(), [&](Offset v) {
        return ReceivedVertex{mesh_.vertex_id(input[static_cast<Id>(v)]), order.value_key(static_cast<Id>(v))};
      });
      // Where owned vertices begin and where each of their segments ends; of a grid nobody asks.
      const Interval owned = mesh_.owned_segments();
      const auto& begin = mesh_.vertex_begin();
      segments = to_first<Id>(with_cells && owned.size() > 0 ? owned.size() + 1 : 0,
                              [&](Offset i) { return begin(owned.first + static_cast<Id>(i)); });
      cells = with_cells ? owned_cells() : to_first<ReceivedCell>(0, [](Offset) { return ReceivedCell{}; });
    });
  }

  void gather(const char* what, std::size_t most_bytes) {
    const auto bytes = [](const auto& some) { return some.count() * std::int64_t(sizeof(some.entries(0))); };
    std::vector<std::int64_t> to(ranks_.size(), 0);
    to[0] = bytes(vertices) + bytes(segments) + bytes(cells);
    require_room(ranks_, what, to, most_bytes);
    vertices = exchange(ranks_, "GALE::vertices_of_all", vertices);
    segments = exchange(ranks_, "GALE::segments_of_all", segments);
    cells = exchange(ranks_, "GALE::cells_of_all", cells);
  }

  EntriesByRank<ReceivedVertex> vertices;
  EntriesByRank<Id> segments;
  EntriesByRank<ReceivedCell> cells;

 private:
  template <class T, class EntryOf>
  EntriesByRank<T> to_first(Offset count, const EntryOf& entry_of) const {
    std::vector<std::int64_t> counts(ranks_.size(), 0);
    counts[0] = count;
    EntriesByRank<T> all = room_by_rank<T>("GALE::told_to_first", counts);
    parallel_for("GALE::told_to_first", HostExecutionSpace(), count, [&](Offset i) { all.entries(i) = entry_of(i); });
    return all;
  }

  /// A cell is sent by the owner of its corner of the lowest global id, and so of the lowest input id.
  EntriesByRank<ReceivedCell> owned_cells() const {
    const CellReader cell = mesh_.cell_reader();
    const OtherIds input = mesh_.vertices_in_input(), cell_input = mesh_.cells_in_input();
    const Interval owned = mesh_.owned_vertices();
    const EntriesByRank<Id> groups = group_by_rank(2, mesh_.cells(), [&](Id t, const auto& visit) {
      const Quad corners = cell(t);
      Id lowest = corners.a;
      for (int k = 1; k < 4; ++k) {
        if (input[corners[k]] < input[lowest]) lowest = corners[k];
      }
      visit(owned.has(lowest) ? 0 : 1);
    });
    return to_first<ReceivedCell>(groups.begin[1], [&](Offset i) {
      const Id t = groups.entries(i);
      const Quad corners = cell(t);
      return ReceivedCell{mesh_.cell_id(cell_input[t]), {corners.a, corners.b, corners.c, corners.d}};
    });
  }

  const Mesh mesh_;
  const Ranks& ranks_;
};

/// The ranks' segments, one after the other.
Segmentation segmentation_of(const ReceivedNumbers<ReceivedVertex>& vertices, const EntriesByRank<Id>& segments) {
  const auto input = allocate<Array<Id, HostMemory>>("GALE::whole_vertices", vertices.count());
  std::vector<Id> begin{0};
  for (std::size_t rank = 0; rank + 1 < segments.begin.size(); ++rank) {
    for (Offset i = segments.begin[rank]; i + 1 < segments.begin[rank + 1]; ++i) {
      Id next = begin.back();
      for (Id v = segments.entries(i); v < segments.entries(i + 1); ++v)
        input(next++) = vertices.of(static_cast<int>(rank), v);
      begin.push_back(next);
    }
  }
  Segmentation segmentation;
  segmentation.vertex_input = input;
  segmentation.vertex_begin = array_of("GALE::whole_segments", begin);
  segmentation.owned_segments = static_cast<Id>(begin.size()) - 1;
  return segmentation;
}

template <int corners>
Mesh mesh_of(const ReceivedNumbers<ReceivedVertex>& vertices, const WholeGathering& gathered) {
  const ReceivedNumbers<ReceivedCell> cells(gathered.cells);
  return Mesh(received_corners<corners>(vertices, cells, gathered.cells), segmentation_of(vertices, gathered.segments),
              std::make_shared<ExcerptExchange>(vertices.ids, cells.ids));
}

}  // namespace

WholeMesh::WholeMesh(const VertexOrder& order, const char* what, std::size_t most_bytes)
    : part_(order.mesh()), ranks_(part_.exchange().ranks()) {
  const auto grid = shared_grid(ranks_, part_);
  std::optional<WholeGathering> gathered;
  gathered.emplace(order, !grid);
  gathered->gather(what, most_bytes);
  together(ranks_, [&] {
    require_ids("vertices that ranks hold of a mesh", gathered->vertices.count());
    require_ids("cells of a mesh", gathered->cells.count());
    numbers_.emplace(gathered->vertices);
    const Mesh whole = grid && ranks_.rank() == 0 ? Mesh(Grid(*grid))
                       : part_.dimension() == 3   ? mesh_of<4>(*numbers_, *gathered)
                                                  : mesh_of<3>(*numbers_, *gathered);
    order_ = excerpt_order(whole, [&](Id v) { return gathered->vertices.entries(numbers_->first(v)).value; });
  });
}

}  // namespace gale::detail
