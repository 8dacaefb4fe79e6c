#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/base/error.hpp>
#include <gale/base/fresh_memory.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/numbering/candidates.hpp>
#include <gale/mesh/numbering/enumerate.hpp>
#include <gale/mesh/numbering/local_order.hpp>

// All that the edges and triangles of a vertex to higher vertices are in touches its segment: its interval of
// tetrahedra and its row of T_ex have them, which a core's cache holds.

namespace gale::detail {

namespace {

/// Two vertices above one, in a tetrahedron of which that is the second; or the fourth twice, of which it is the third.
struct Above {
  Id low, high;
};

/// For each vertex of a segment the tetrahedra of which it is the second or third. For one thread.
class MiddleStarsOfSegment {
 public:
  explicit MiddleStarsOfSegment(const EncodedMesh<HostMemory>& mesh) : mesh_(mesh) {}

  void gather(Id segment) {
    first_ = mesh_.vertex_begin(segment);
    count_ = static_cast<std::uint32_t>(mesh_.vertex_begin(segment + 1) - first_);
    // Filling moves the start of each row to its end, which is the next row's start.
    begin_.assign(count_ + 2, 0);
    for_each(segment, [&](std::uint32_t vertex, const Above&) { ++begin_[vertex + 1]; });
    Id at = 0;
    for (Id& begin : begin_) at += std::exchange(begin, at);
    if (above_.size() < static_cast<std::size_t>(at)) above_.resize(at);
    for_each(segment, [&](std::uint32_t vertex, const Above& above) { above_[begin_[vertex + 1]++] = above; });
  }

  Span<const Above> of(Id vertex) const {
    const Id begin = begin_[vertex - first_];
    return {above_.data() + begin, begin_[vertex - first_ + 1] - begin};
  }

 private:
  template <class Visit>
  void for_each(Id segment, const Visit& visit) const {
    for (Id t = mesh_.internal_begin(segment); t < mesh_.internal_begin(segment + 1); ++t)
      visit_middle(mesh_.cell(t), visit);
    for (Offset i = mesh_.external_begin(segment); i < mesh_.external_begin(segment + 1); ++i)
      visit_middle(mesh_.cell(mesh_.external(i)), visit);
  }

  template <class Visit>
  void visit_middle(const Quad& quad, const Visit& visit) const {
    const auto second = static_cast<std::uint32_t>(quad.b - first_),
               third = static_cast<std::uint32_t>(quad.c - first_);
    if (second < count_) visit(second, Above{quad.c, quad.d});
    if (third < count_ && mesh_.dimension == 3) visit(third, Above{quad.d, quad.d});
  }

  const EncodedMesh<HostMemory> mesh_;
  Id first_ = 0;
  std::uint32_t count_ = 0;
  std::vector<Id> begin_;
  std::vector<Above> above_;
};

/// How many edges and triangles a part of the segments has.
struct SimplexCounts {
  Offset edges = 0, triangles = 0;

  SimplexCounts operator+(const SimplexCounts& other) const {
    return {edges + other.edges, triangles + other.triangles};
  }
  bool fits(const SimplexCounts& room) const { return edges <= room.edges && triangles <= room.triangles; }
};

/// Where one part writes. Tables that aren't wanted are null.
struct SimplexPlaces {
  Id *edge_low = nullptr, *edge_high = nullptr;            ///< of its first edge
  Id *triangle_begin = nullptr, *triangle_apex = nullptr;  ///< of its first edge and triangle; counted from that
  SimplexCounts room;
};

/// Finds the edges and triangles of vertices to higher ones, and writes them one vertex after the other, as long as
/// there is room. For one thread.
class SimplexFinder {
 public:
  explicit SimplexFinder(const SimplexPlaces& places) : to_(places) {}

  /// Takes the vertex's own tetrahedra and those of which it is in the middle.
  void find(Id vertex, const Quad* own, Id count, const Span<const Above>& middle) {
    collect(own, count, middle);
    find_ends(vertex);
    SimplexCounts all = found + SimplexCounts{static_cast<Offset>(ends_.size()), 0};
    if (to_.triangle_apex != nullptr) all.triangles += find_triangles(3 * count);
    if (all.fits(to_.room)) write(vertex);
    found = all;
  }

  SimplexCounts found;

 private:
  /// Edges of a vertex whose triangles are told by bits.
  static constexpr Id most_bits = 32;

  /// The higher vertices of each tetrahedron: three of own ones, then two of the others.
  void collect(const Quad* own, Id count, const Span<const Above>& middle) {
    count_ = 3 * count + static_cast<Id>(2 * middle.size());
    InputIdRanks::make_room(corners_, count_);
    Id* to = corners_.data();
    for (Id t = 0; t < count; ++t) {
      *to++ = own[t].b;
      *to++ = own[t].c;
      *to++ = own[t].d;
    }
    for (const Above& above : middle) {
      *to++ = above.low;
      *to++ = above.high;
    }
  }

  void find_ends(Id vertex) {
    FewDistinct few;
    for (Id i = 0; i < count_; ++i) {
      if (seen_.is_new(vertex, corners_[i])) few.insert(corners_[i]);
    }
    if (few.size() != FewDistinct::too_many) {
      ends_.resize(few.size());
      for (Id i = 0; i < few.size(); ++i) ends_[i] = few[i];
    } else {
      ends_.assign(corners_.begin(), corners_.begin() + count_);
      std::sort(ends_.begin(), ends_.end());
      ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
    }
  }

  /// `own` corners are of the vertex's own tetrahedra. Returns how many there are.
  Offset find_triangles(Id own) {
    const auto edges = static_cast<Id>(ends_.size());
    ranks_.begin(edges);
    std::copy(ends_.begin(), ends_.end(), ranks_.ids());
    ranks_.replace_by_ranks(corners_, count_);
    if (edges > most_bits) return find_many(own);
    std::fill(joined_.begin(), joined_.begin() + edges, 0);
    const auto bit = [](Id i) { return std::uint32_t(1) << i; };
    for (const Id *corner = corners_.data(), *const end = corner + own; corner < end; corner += 3) {
      joined_[corner[0]] |= bit(corner[1]) | bit(corner[2]);
      joined_[corner[1]] |= bit(corner[2]);
    }
    for (Id i = own; i < count_; i += 2) joined_[corners_[i]] |= bit(corners_[i + 1]);
    Offset triangles = 0;
    for (Id i = 0; i < edges; ++i) {
      joined_[i] &= ~bit(i);
      triangles += count_bits(joined_[i]);
    }
    return triangles;
  }

  Offset find_many(Id own) {
    pairs_.clear();
    const auto add = [&](Id low, Id high) {
      if (low != high) pairs_.push_back(pair_key(low, high));
    };
    for (Id i = 0; i < own; i += 3) {
      add(corners_[i], corners_[i + 1]);
      add(corners_[i], corners_[i + 2]);
      add(corners_[i + 1], corners_[i + 2]);
    }
    for (Id i = own; i < count_; i += 2) add(corners_[i], corners_[i + 1]);
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    return static_cast<Offset>(pairs_.size());
  }

  void write(Id vertex) const {
    const auto edges = static_cast<Id>(ends_.size());
    if (to_.edge_high != nullptr) {
      std::copy(ends_.begin(), ends_.end(), to_.edge_high + found.edges);
      std::fill_n(to_.edge_low + found.edges, edges, vertex);
    }
    if (to_.triangle_apex == nullptr) return;
    Id* const begin = to_.triangle_begin + found.edges;
    Id* apex = to_.triangle_apex + found.triangles;
    const auto here = [&] { return static_cast<Id>(apex - to_.triangle_apex); };
    if (edges <= most_bits) {
      for (Id i = 0; i < edges; ++i) {
        begin[i] = here();
        for (std::uint32_t rest = joined_[i]; rest != 0; rest &= rest - 1) *apex++ = ends_[lowest_bit(rest)];
      }
    } else {
      auto pair = pairs_.begin();
      for (Id i = 0; i < edges; ++i) {
        begin[i] = here();
        for (; pair != pairs_.end() && pair_first(*pair) == i; ++pair) *apex++ = ends_[pair_second(*pair)];
      }
    }
  }

  const SimplexPlaces to_;
  Id count_ = 0;
  std::vector<Id> corners_, ends_;
  std::array<std::uint32_t, most_bits> joined_;  ///< of each edge, which of those behind it it makes a triangle with
  std::vector<std::uint64_t> pairs_;             ///< of too many edges for bits: those that make triangles
  LastSeen seen_;
  InputIdRanks ranks_;
};

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
