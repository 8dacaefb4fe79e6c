#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/base/error.hpp>
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

/// What one thread finds, vertex after vertex.
struct FoundSimplices {
  /// Edges of a vertex whose triangles are told by bits.
  static constexpr Id most_bits = 32;

  std::vector<Id> ends;               ///< of edges
  std::vector<std::uint32_t> joined;  ///< of each edge, which edges of its vertex it makes a triangle with, of those
                                      ///< behind it; where these are more than `most_bits`, how many
  std::vector<Id> apexes;             ///< of the triangles of such vertices
  Offset triangles = 0;
};

/// Finds the edges and triangles of vertices to higher ones. For one thread.
class SimplexFinder {
 public:
  SimplexFinder(bool triangles, FoundSimplices& found) : triangles_(triangles), found_(found) {}

  /// Takes the vertex's own tetrahedra and those of which it is in the middle. Returns how many edges it has.
  Id find(Id vertex, const Quad* own, Id count, const Span<const Above>& middle) {
    collect(own, count, middle);
    find_ends(vertex);
    if (triangles_) find_triangles(3 * count);
    found_.ends.insert(found_.ends.end(), ends_.begin(), ends_.end());
    return static_cast<Id>(ends_.size());
  }

 private:
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

  /// `own` corners are of the vertex's own tetrahedra.
  void find_triangles(Id own) {
    const auto edges = static_cast<Id>(ends_.size());
    ranks_.begin(edges);
    std::copy(ends_.begin(), ends_.end(), ranks_.ids());
    ranks_.replace_by_ranks(corners_, count_);
    if (edges > FoundSimplices::most_bits) return find_many(own);
    std::array<std::uint32_t, FoundSimplices::most_bits> joined;
    std::fill(joined.begin(), joined.begin() + edges, 0);
    const auto bit = [](Id i) { return std::uint32_t(1) << i; };
    for (const Id *corner = corners_.data(), *const end = corner + own; corner < end; corner += 3) {
      joined[corner[0]] |= bit(corner[1]) | bit(corner[2]);
      joined[corner[1]] |= bit(corner[2]);
    }
    for (Id i = own; i < count_; i += 2) joined[corners_[i]] |= bit(corners_[i + 1]);
    for (Id i = 0; i < edges; ++i) {
      joined[i] &= ~bit(i);
      found_.triangles += count_bits(joined[i]);
    }
    found_.joined.insert(found_.joined.end(), joined.begin(), joined.begin() + edges);
  }

  void find_many(Id own) {
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
    const std::size_t first = found_.joined.size();
    found_.joined.resize(first + ends_.size(), 0);
    for (const std::uint64_t pair : pairs_) {
      ++found_.joined[first + pair_first(pair)];
      found_.apexes.push_back(ends_[pair_second(pair)]);
    }
    found_.triangles += static_cast<Offset>(pairs_.size());
  }

  const bool triangles_;
  FoundSimplices& found_;
  Id count_ = 0;
  std::vector<Id> corners_, ends_;
  std::vector<std::uint64_t> pairs_;
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
void find_simplices(const EncodedMesh<HostMemory>& mesh, const Id* cell_begin, Offset first, Offset last,
                    bool triangles, Id* edge_begin, FoundSimplices& found) {
  constexpr Offset usual = 8;
  const Offset vertices = mesh.vertex_begin(last) - mesh.vertex_begin(first);
  FoundSimplices mine;  // the ends of those of all parts share cache lines
  mine.ends.reserve(usual * vertices);
  if (triangles) mine.joined.reserve(usual * vertices);
  MiddleStarsOfSegment stars(mesh);
  SimplexFinder finder(triangles, mine);
  Id gathered = no_id;
  Offset edges = 0;
  for_vertices(mesh, first, last, [&](Id segment, Id v) {
    if (std::exchange(gathered, segment) != segment) stars.gather(segment);
    const Id begin = cell_begin[v];
    edge_begin[v] = static_cast<Id>(edges);
    edges += finder.find(v, reinterpret_cast<const Quad*>(mesh.cells.data()) + begin, cell_begin[v + 1] - begin,
                         stars.of(v));
  });
  found = std::move(mine);
}

/// Writes a part's triangles: the first has the number `at`, its first edge the number `edge`.
void write_triangles(const EncodedMesh<HostMemory>& mesh, const Id* edge_begin, Offset first, Offset last,
                     const FoundSimplices& found, Id at, Id* triangle_begin, Id* apex) {
  const std::uint32_t* joined = found.joined.data();
  const Id *ends = found.ends.data(), *of_many = found.apexes.data();
  for_vertices(mesh, first, last, [&](Id, Id v) {
    const Id edges = edge_begin[v + 1] - edge_begin[v];
    for (Id i = 0; i < edges; ++i) {
      triangle_begin[edge_begin[v] + i] = at;
      if (edges > FoundSimplices::most_bits) {
        const auto count = static_cast<Id>(joined[i]);
        std::copy(of_many, of_many + count, apex + at);
        of_many += count;
        at += count;
      } else {
        for (std::uint32_t rest = joined[i]; rest != 0; rest &= rest - 1) apex[at++] = ends[lowest_bit(rest)];
      }
    }
    joined += edges;
    ends += edges;
  });
}

}  // namespace

void enumerate_by_segments(const EncodedMesh<HostMemory>& mesh, const Borrowed<Id, HostMemory>& cell_begin,
                           bool triangles, SimplexTables& tables) {
  using Ids = Array<Id, HostMemory>;
  const Offset vertices = cell_begin.extent(0) - 1, segments = mesh.vertex_begin.extent(0) - 1;
  const auto edge_begin = allocate<Ids>("GALE::edge_begin", vertices + 1);
  std::vector<FoundSimplices> found(threads_for(vertices));
  const int parts = static_cast<int>(found.size());
  for_parts("GALE::find_simplices", segments, parts, [&](int part, Offset first, Offset last) {
    find_simplices(mesh, cell_begin.data(), first, last, triangles, edge_begin.data(), found[part]);
  });
  std::vector<Offset> first_edge(1, 0), first_triangle(1, 0);
  for (const FoundSimplices& part : found) {
    first_edge.push_back(first_edge.back() + static_cast<Offset>(part.ends.size()));
    first_triangle.push_back(first_triangle.back() + part.triangles);
  }
  require_ids("edges", first_edge[parts]);
  require_ids("triangles", first_triangle[parts]);
  const bool edges_too = tables.edge_begin.size() == 0;
  Ids low, high;
  if (edges_too) {
    low = allocate<Ids>("GALE::edge_low", first_edge[parts]);
    high = allocate<Ids>("GALE::edge_high", first_edge[parts]);
  }
  edge_begin(vertices) = static_cast<Id>(first_edge[parts]);
  for_parts("GALE::write_edges", segments, parts, [&](int part, Offset first, Offset last) {
    const auto shift = static_cast<Id>(first_edge[part]);
    if (edges_too) std::copy(found[part].ends.begin(), found[part].ends.end(), high.data() + shift);
    const Id last_vertex = mesh.vertex_begin(last) - 1;
    for_vertices(mesh, first, last, [&](Id, Id v) {
      const Id begin = edge_begin(v) += shift;
      const Id end = v < last_vertex ? edge_begin(v + 1) + shift : static_cast<Id>(first_edge[part + 1]);
      if (edges_too) std::fill(low.data() + begin, low.data() + end, v);
    });
  });
  Ids triangle_begin, apex;
  if (triangles) {
    triangle_begin = allocate<Ids>("GALE::triangle_begin", first_edge[parts] + 1);
    apex = allocate<Ids>("GALE::triangle_apex", first_triangle[parts]);
    triangle_begin(first_edge[parts]) = static_cast<Id>(first_triangle[parts]);
    for_parts("GALE::write_triangles", segments, parts, [&](int part, Offset first, Offset last) {
      write_triangles(mesh, edge_begin.data(), first, last, found[part], static_cast<Id>(first_triangle[part]),
                      triangle_begin.data(), apex.data());
    });
    tables.triangle_begin = triangle_begin;
    tables.triangle_apex = apex;
  }
  if (!edges_too) return;
  tables.edge_begin = edge_begin;
  tables.edge_low = low;
  tables.edge_high = high;
}

}  // namespace gale::detail
