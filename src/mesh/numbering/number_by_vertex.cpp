#include <algorithm>
#include <array>
#include <vector>

#include <gale/base/group_by.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/numbering/local_order.hpp>
#include <gale/mesh/numbering/number.hpp>

// A vertex's own simplices here are those of which it has the least input id. GALE's tables have them by the least of
// GALE's ids; the two agree for most where vertices of a segment are in the order of the input.

namespace gale::detail {

namespace {

using HostTables = Simplices<HostMemory>;
using HostIds = Array<Id, HostMemory>;

/// What each vertex owns and another one has in the tables: edges (., x), and the edges (a, b) of triangles (a, b, x).
/// Triangles (a, x, .) are over those edges.
struct Elsewhere {
  Array<bool, HostMemory> has_all;  ///< vertex a -> whether it owns all that the tables have of it, (a, ...)
  Csr<Id, HostMemory, Id> edges, triangles;
};

Elsewhere find_elsewhere(const HostTables& tables, const Id* input, bool triangles) {
  const Offset vertices = tables.edge_begin.extent(0) - 1;
  Elsewhere elsewhere;
  elsewhere.has_all = tabulated<bool>("GALE::has_all", vertices, [&](Offset v) {
    const Id* const ends = tables.edge_high.data();
    return std::all_of(ends + tables.edge_begin(v), ends + tables.edge_begin(v + 1),
                       [&](Id end) { return input[end] > input[v]; });
  });
  // Empty where all vertices have all.
  const bool none = reduce_sum("GALE::has_all", HostExecutionSpace(), vertices, elsewhere.has_all) == vertices;
  const Offset edges = none ? 0 : tables.edge_high.extent(0);
  elsewhere.edges =
      group_by<Id>("GALE::edges_elsewhere", HostExecutionSpace(), edges, vertices, [&](Id edge, const auto& visit) {
        const Id low = tables.edge_low(edge), high = tables.edge_high(edge);
        if (!elsewhere.has_all(low) && input[high] < input[low]) visit(high);
      });
  if (triangles) {
    elsewhere.triangles = group_by<Id>(
        "GALE::triangles_elsewhere", HostExecutionSpace(), edges, vertices, [&](Id edge, const auto& visit) {
          if (elsewhere.has_all(tables.edge_low(edge))) return;
          const Id least = std::min(input[tables.edge_low(edge)], input[tables.edge_high(edge)]);
          for (Id f = tables.triangle_begin(edge); f < tables.triangle_begin(edge + 1); ++f) {
            const Id apex = tables.triangle_apex(f);
            if (input[apex] < least) visit(apex);
          }
        });
  }
  return elsewhere;
}

/// What a vertex owns.
class OwnSimplices {
 public:
  OwnSimplices(const HostTables& tables, const Id* input, const Elsewhere& elsewhere)
      : tables_(tables), input_(input), elsewhere_(elsewhere) {}

  /// Whether it owns what the tables have of it, and nothing else.
  bool is_as_in_tables(Id vertex) const {
    const auto& begin = elsewhere_.edges.offsets;
    return elsewhere_.has_all(vertex) && begin(vertex) == begin(vertex + 1);
  }

  /// Calls visit(edge, other end).
  template <class Visit>
  void for_each_edge(Id vertex, const Visit& visit) const {
    const Id here = input_[vertex];
    for (Id e = tables_.edge_begin(vertex); e < tables_.edge_begin(vertex + 1); ++e) {
      const Id high = tables_.edge_high(e);
      if (input_[high] > here) visit(e, high);
    }
    for (const Id edge : elsewhere_.edges.row(vertex)) visit(edge, tables_.edge_low(edge));
  }

  /// Calls visit(triangle, third corner) for those that the tables have over one of these edges.
  template <class Visit>
  void for_each_triangle_over(Id edge, Id vertex, const Visit& visit) const {
    const Id here = input_[vertex];
    for (Id f = tables_.triangle_begin(edge); f < tables_.triangle_begin(edge + 1); ++f) {
      const Id apex = tables_.triangle_apex(f);
      if (input_[apex] > here) visit(f, apex);
    }
  }

  /// Calls visit(edge) for the others: the vertex is their apex over that edge.
  template <class Visit>
  void for_each_triangle_below(Id vertex, const Visit& visit) const {
    for (const Id edge : elsewhere_.triangles.row(vertex)) visit(edge);
  }

 private:
  const HostTables& tables_;
  const Id* input_;
  const Elsewhere& elsewhere_;
};

/// Ids for edges, and for triangles where these are wanted.
struct IdsOfBoth {
  HostIds edges, triangles;
};

/// Where the numbers of what each vertex owns begin, by input id.
IdsOfBoth find_begins(const OwnSimplices& own, const HostTables& tables, const Id* input, Id vertices, bool triangles) {
  IdsOfBoth begins;
  begins.edges = allocate<HostIds>("GALE::edge_numbers_begin", vertices + 1);
  if (triangles) begins.triangles = allocate<HostIds>("GALE::triangle_numbers_begin", vertices + 1);
  parallel_for("GALE::count_own", HostExecutionSpace(), vertices, [&](Offset v) {
    const Id vertex = static_cast<Id>(v);
    if (own.is_as_in_tables(vertex)) {
      const Id first = tables.edge_begin(v), last = tables.edge_begin(v + 1);
      begins.edges(input[v]) = last - first;
      if (triangles) begins.triangles(input[v]) = tables.triangle_begin(last) - tables.triangle_begin(first);
      return;
    }
    Id edge_count = 0, triangle_count = 0;
    own.for_each_edge(vertex, [&](Id edge, Id) {
      ++edge_count;
      if (triangles) own.for_each_triangle_over(edge, vertex, [&](Id, Id) { ++triangle_count; });
    });
    begins.edges(input[vertex]) = edge_count;
    if (!triangles) return;
    own.for_each_triangle_below(vertex, [&](Id) { ++triangle_count; });
    begins.triangles(input[vertex]) = triangle_count;
  });
  for (const HostIds& begin : {begins.edges, begins.triangles}) {
    if (begin.extent(0) == 0) continue;
    exclusive_scan("GALE::scan_own", HostExecutionSpace(), vertices, begin, [&](Offset i) { return begin(i); });
  }
  return begins;
}

/// Numbers what one vertex after the other owns.
class OwnNumberer {
 public:
  OwnNumberer(const OwnSimplices& own, const HostTables& tables, const Id* input, const IdsOfBoth& numbers)
      : own_(own), tables_(tables), input_(input), numbers_(numbers) {}

  /// Goes to a vertex, which owns so many edges.
  void order_edges(Id vertex, Id edges_there) {
    count_ = edges_there;
    for (std::vector<Id>* ids : {&edges_, &ends_}) InputIdRanks::make_room(*ids, count_);
    neighbours_.begin(count_);
    Id* const ids = neighbours_.ids();
    Id count = 0;
    own_.for_each_edge(vertex, [&](Id edge, Id other) {
      edges_[count] = edge;
      ids[count++] = input_[other];
    });
    in_order_ = own_.is_as_in_tables(vertex) && std::is_sorted(ids, ids + count);
    if (in_order_) return;
    std::copy(ids, ids + count, ends_.begin());
    neighbours_.sort();
    neighbours_.replace_by_ranks(ends_, count);
  }

  /// Its edges, from `begin`.
  void number_edges(Id begin) {
    for (Id i = 0; i < count_; ++i) numbers_.edges(edges_[i]) = begin + (in_order_ ? i : ends_[i]);
  }

  /// Its triangles, from `begin` to before `end`.
  void number_triangles(Id vertex, Id begin, Id end) {
    if (in_order_) {
      for (Id f = tables_.triangle_begin(tables_.edge_begin(vertex)); begin < end; ++f) numbers_.triangles(f) = begin++;
      return;
    }
    const Id count = end - begin;
    find_triangles(vertex, count);
    const auto for_each = [&](const auto& visit) {
      for (Id i = 0; i < count; ++i)
        visit(std::min(corners_[i], others_[i]), std::max(corners_[i], others_[i]), triangles_[i]);
    };
    if (count_ <= TriangleOrder::most_neighbours) {
      few_.visit(count_, for_each, [&](Id triangle) { numbers_.triangles(triangle) = begin++; });
    } else {
      many_.clear();
      for_each([&](Id second, Id third, Id triangle) { many_.push_back({second, third, triangle}); });
      std::sort(many_.begin(), many_.end());
      for (const auto& triangle : many_) numbers_.triangles(triangle[2]) = begin++;
    }
  }

 private:
  /// Finds `count` triangles, and the ranks of their other two corners among the neighbours.
  void find_triangles(Id vertex, Id count) {
    for (std::vector<Id>* ids : {&triangles_, &corners_, &others_}) InputIdRanks::make_room(*ids, count);
    Id found = 0;
    const auto add = [&](Id triangle, Id rank, Id other) {
      triangles_[found] = triangle;
      corners_[found] = rank;
      others_[found++] = input_[other];
    };
    for (Id i = 0; i < count_; ++i)
      own_.for_each_triangle_over(edges_[i], vertex, [&](Id triangle, Id apex) { add(triangle, ends_[i], apex); });
    own_.for_each_triangle_below(vertex, [&](Id edge) {
      add(tables_.triangle_of(edge, vertex), neighbours_.rank_of(input_[tables_.edge_low(edge)]),
          tables_.edge_high(edge));
    });
    neighbours_.replace_by_ranks(others_, count);
  }

  const OwnSimplices& own_;
  const HostTables& tables_;
  const Id* input_;
  const IdsOfBoth& numbers_;
  InputIdRanks neighbours_;
  bool in_order_ = false;  ///< as in the tables
  Id count_ = 0;
  std::vector<Id> edges_, ends_;  ///< of the vertex; the ends' ranks
  std::vector<Id> triangles_, corners_, others_;
  TriangleOrder few_;
  std::vector<std::array<Id, 3>> many_;
};

}  // namespace

MadeNumbers number_by_vertex(const HostTables& simplices, const Borrowed<Id, HostMemory>& input, bool edges,
                             bool triangles) {
  const Id vertices = static_cast<Id>(simplices.edge_begin.extent(0)) - 1;
  const Elsewhere elsewhere = find_elsewhere(simplices, input.data(), triangles);
  const OwnSimplices own(simplices, input.data(), elsewhere);
  const IdsOfBoth begins = find_begins(own, simplices, input.data(), vertices, triangles);
  IdsOfBoth numbers;
  if (edges) numbers.edges = allocate<HostIds>("GALE::edge_numbers", simplices.edge_high.extent(0));
  if (triangles) numbers.triangles = allocate<HostIds>("GALE::triangle_numbers", simplices.triangle_apex.extent(0));
  constexpr Offset ahead = 8;
  for_parts("GALE::number_own", vertices, threads_for(vertices), [&](int, Offset first, Offset last) {
    OwnNumberer numberer(own, simplices, input.data(), numbers);
    for (Id vertex = static_cast<Id>(first); vertex < last; ++vertex) {
      stop_if_asked_at(vertex);
      const Id later = input(std::min<Offset>(vertex + ahead, last - 1));
      if (edges) __builtin_prefetch(&begins.edges(later));
      if (triangles) __builtin_prefetch(&begins.triangles(later));
      const Id here = input(vertex);
      numberer.order_edges(vertex, begins.edges(here + 1) - begins.edges(here));
      if (edges) numberer.number_edges(begins.edges(here));
      if (triangles) numberer.number_triangles(vertex, begins.triangles(here), begins.triangles(here + 1));
    }
  });
  return {numbers.edges, numbers.triangles};
}

}  // namespace gale::detail
