#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/numbering/enumerate.hpp>
#include <gale/mesh/numbering/simplex_finder.hpp>

// All that the edges and triangles of a vertex to higher vertices are in touches its segment: its interval of
// tetrahedra and its row of T_ex have them, which a core's cache holds.

namespace gale::detail {

namespace {

/// Calls visit(segment, vertex) for the vertices of segments.
template <class Visit>
void for_vertices(const EncodedMesh<HostMemory>& mesh, Offset first, Offset last, const Visit& visit) {
  for (auto segment = static_cast<Id>(first); segment < last; ++segment) {
    stop_if_asked();
    for (Id v = mesh.vertex_begin(segment); v < mesh.vertex_begin(segment + 1); ++v) visit(segment, v);
  }
}

/// Finds what a part of the segments has, and writes where each vertex's edges begin, counted from the part's first.
SimplexCounts find_simplices(const EncodedMesh<HostMemory>& mesh, const Id* cell_begin, Offset first, Offset last,
                             Id* edge_begin, const SimplexPlaces& places) {
  MiddleStarsOfSegment stars(mesh);
  SimplexFinder finder(places);
  Id gathered = no_id;
  for_vertices(mesh, first, last, [&](Id segment, Id v) {
    if (std::exchange(gathered, segment) != segment) stars.gather(segment);
    const Id begin = cell_begin[v];
    edge_begin[v] = static_cast<Id>(finder.found.edges);
    finder.find(v, reinterpret_cast<const Quad*>(mesh.cells.data()) + begin, cell_begin[v + 1] - begin, stars.of(v));
  });
  return finder.found;
}

/// Moves entries down to where an array has room before them, or leaves them there, each with `shift` added to it: on
/// all threads, as many at a time as don't overlap with their places.
void move_down(Id* to, const Id* from, Offset count, Id shift) {
  constexpr Offset few = Offset(1) << 16;
  const Offset apart = from - to, at_once = apart == 0 ? count : apart;
  for (Offset moved = 0; moved < count;) {
    const Offset now = at_once < few ? count - moved : std::min(at_once, count - moved);
    const auto move = [&](Offset i) { to[moved + i] = from[moved + i] + shift; };
    if (at_once < few) {
      for (Offset i = 0; i < now; ++i) move(i);
    } else {
      parallel_for("GALE::close_gaps", HostExecutionSpace(), now, move);
    }
    moved += now;
  }
}

/// The tables as parts write them, each with room of its own, until the gaps between these are closed.
class TablesInParts {
 public:
  using Ids = Array<Id, HostMemory>;

  TablesInParts(std::vector<SimplexCounts> rooms, bool edges_too, bool triangles) : rooms_(std::move(rooms)) {
    first_.resize(1);
    for (const SimplexCounts& room : rooms_) first_.push_back(first_.back() + room);
    const SimplexCounts all = first_.back();
    if (edges_too) {
      low = allocate<Ids>("GALE::edge_low", all.edges);
      high = allocate<Ids>("GALE::edge_high", all.edges);
    }
    if (!triangles) return;
    triangle_begin = allocate<Ids>("GALE::triangle_begin", all.edges + 1);
    apex = allocate<Ids>("GALE::triangle_apex", all.triangles);
  }

  SimplexPlaces places(int part) const {
    const auto at = [](const Ids& ids, Offset first) { return ids.data() == nullptr ? nullptr : ids.data() + first; };
    const SimplexCounts& first = first_[part];
    return {at(low, first.edges), at(high, first.edges), at(triangle_begin, first.edges), at(apex, first.triangles),
            rooms_[part]};
  }

  /// Whether each part had room for what it has.
  bool hold(const std::vector<SimplexCounts>& found) const {
    for (std::size_t part = 0; part < found.size(); ++part) {
      if (!found[part].fits(rooms_[part])) return false;
    }
    return true;
  }

  /// Moves parts together, which have found so many, and gives the memory behind them back.
  void close_gaps(const std::vector<SimplexCounts>& found) {
    SimplexCounts at;
    for (std::size_t part = 0; part < found.size(); ++part) {
      const auto move = [&](const Ids& ids, Offset to, Offset from, Offset count, Offset shift) {
        if (ids.data() != nullptr && (to != from || shift != 0))
          move_down(ids.data() + to, ids.data() + from, count, static_cast<Id>(shift));
      };
      const auto [edges, triangles] = found[part];
      const SimplexCounts& from = first_[part];
      move(low, at.edges, from.edges, edges, 0);
      move(high, at.edges, from.edges, edges, 0);
      move(triangle_begin, at.edges, from.edges, edges, at.triangles);
      move(apex, at.triangles, from.triangles, triangles, 0);
      at = at + found[part];
    }
    const auto cut = [](Ids& ids, Offset count) {
      if (ids.data() == nullptr) return;
      give_back(ids.data() + count, (ids.extent(0) - static_cast<std::size_t>(count)) * sizeof(Id));
      ids = first_of(ids, static_cast<std::size_t>(count));
    };
    cut(low, at.edges);
    cut(high, at.edges);
    cut(triangle_begin, at.edges + 1);
    cut(apex, at.triangles);
    if (triangle_begin.data() != nullptr) triangle_begin(at.edges) = static_cast<Id>(at.triangles);
  }

  Ids low, high, triangle_begin, apex;

 private:
  std::vector<SimplexCounts> rooms_, first_;
};

/// How many simplices a part is expected to have at most. A manifold with V vertices, T tetrahedra, B triangles in its
/// surface and the Euler characteristic X has V + T + B / 2 - X edges and 2 T + B / 2 triangles.
SimplexCounts expected(Offset vertices, Offset cells) {
  constexpr Offset few = 4096;
  return {few + (vertices + cells) * 17 / 16, few + 2 * cells * 17 / 16};
}

}  // namespace

void enumerate_by_segments(const EncodedMesh<HostMemory>& mesh, const Borrowed<Id, HostMemory>& cell_begin,
                           bool triangles, SimplexTables& tables) {
  const Offset vertices = cell_begin.extent(0) - 1, segments = mesh.vertex_begin.extent(0) - 1;
  const int parts = threads_for(vertices);
  const auto edge_begin = allocate<Array<Id, HostMemory>>("GALE::edge_begin", vertices + 1);
  const auto first_vertex = [&](int part) { return mesh.vertex_begin(part_begin(segments, parts, part)); };
  std::vector<SimplexCounts> rooms, found(parts);
  for (int part = 0; part < parts; ++part) {
    const Id first = first_vertex(part), last = first_vertex(part + 1);
    rooms.push_back(expected(last - first, cell_begin(last) - cell_begin(first)));
  }
  const bool edges_too = tables.edge_begin.size() == 0;
  std::optional<TablesInParts> made;
  do {
    made.reset();
    made.emplace(std::move(rooms), edges_too, triangles);
    for_parts("GALE::find_simplices", segments, parts, [&](int part, Offset first, Offset last) {
      found[part] = find_simplices(mesh, cell_begin.data(), first, last, edge_begin.data(), made->places(part));
    });
    rooms = found;
  } while (!made->hold(found));
  SimplexCounts all;
  for (const SimplexCounts& part : found) all = all + part;
  require_ids("edges", all.edges);
  require_ids("triangles", all.triangles);
  made->close_gaps(found);
  if (triangles) {
    tables.triangle_begin = made->triangle_begin;
    tables.triangle_apex = made->apex;
  }
  if (!edges_too) return;
  SimplexCounts before = found[0];
  for (int part = 1; part < parts; ++part) {
    Id* const first = edge_begin.data() + first_vertex(part);
    move_down(first, first, first_vertex(part + 1) - first_vertex(part), static_cast<Id>(before.edges));
    before = before + found[part];
  }
  edge_begin(vertices) = static_cast<Id>(all.edges);
  tables.edge_begin = edge_begin;
  tables.edge_low = made->low;
  tables.edge_high = made->high;
}

}  // namespace gale::detail
