#include <gale/base/bits.hpp>
#include <gale/base/error.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/numbering/enumerate.hpp>
#include <gale/mesh/numbering/sorted_pairs.hpp>

namespace gale::detail {

namespace {

/// The higher neighbours of a vertex (the ends of its own edges, by their places), and which of them make a triangle
/// with it and each other: for each, a bit for each higher one. In one thread's own memory.
class UpperLink {
 public:
  /// Higher neighbours that a vertex may have.
  static constexpr Id capacity = 64;

  template <class Memory>
  KOKKOS_INLINE_FUNCTION static bool is_for(const Simplices<Memory>& simplices, Offset vertex) {
    return simplices.edge_begin(vertex + 1) - simplices.edge_begin(vertex) <= capacity;
  }

  template <class Memory>
  KOKKOS_INLINE_FUNCTION UpperLink(const Simplices<Memory>& simplices, const MiddleStars<Memory>& stars, Offset vertex)
      : neighbours_(simplices.edge_high.data() + simplices.edge_begin(vertex)),
        count_(simplices.edge_begin(vertex + 1) - simplices.edge_begin(vertex)) {
    for (Id i = 0; i < count_; ++i) joined_[i] = 0;
    for (Id t = simplices.cell_begin(vertex); t < simplices.cell_begin(vertex + 1); ++t) {
      const Quad quad = simplices.cell(t);
      const Id b = place_of(quad.b, 0), c = place_of(quad.c, b), d = place_of(quad.d, c);
      joined_[b] |= bit(c) | bit(d);
      joined_[c] |= bit(d);
    }
    for (const Id t : stars.row(vertex)) {
      const Quad quad = simplices.cell(t);
      if (quad.b != vertex) continue;
      const Id c = place_of(quad.c, 0);
      joined_[c] |= bit(place_of(quad.d, c));
    }
  }

  KOKKOS_INLINE_FUNCTION Id size() const { return count_; }

  /// How many triangles the i-th edge has with higher vertices.
  KOKKOS_INLINE_FUNCTION Id triangles(Id i) const {
    return count_bits(static_cast<std::uint32_t>(joined_[i])) +
           count_bits(static_cast<std::uint32_t>(joined_[i] >> 32));
  }

  /// Calls visit(apex) for each of them, ascending.
  template <class Visit>
  KOKKOS_INLINE_FUNCTION void for_each_apex(Id i, const Visit& visit) const {
    for (Id j = i + 1; j < count_; ++j) {
      if (joined_[i] >> j & 1) visit(neighbours_[j]);
    }
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION static std::uint64_t bit(Id i) { return std::uint64_t(1) << i; }

  /// The place of a neighbour that is there, not before `from`.
  KOKKOS_FORCEINLINE_FUNCTION Id place_of(Id neighbour, Id from) const {
    while (neighbours_[from] != neighbour) ++from;
    return from;
  }

  const Id* neighbours_;
  Id count_;
  std::uint64_t joined_[capacity];
};

/// The triangles of a tetrahedron whose lowest vertex has too many higher neighbours for that.
template <class Memory>
struct TrianglesOfMany {
  Simplices<Memory> s;

  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id tetrahedron, const Visit& visit) const {
    const Quad quad = s.cell(tetrahedron);
    if (!UpperLink::is_for(s, quad.a)) {
      const Id edge = s.edge_of(quad.a, quad.b);
      visit(pair_key(edge, quad.c));
      visit(pair_key(edge, quad.d));
      visit(pair_key(s.edge_of(quad.a, quad.c), quad.d));
    }
    if (!UpperLink::is_for(s, quad.b)) visit(pair_key(s.edge_of(quad.b, quad.c), quad.d));
  }
};

}  // namespace

template <class Space>
void enumerate_triangles(const Space& space, const Simplices<MemoryOf<Space>>& simplices,
                         const MiddleStars<MemoryOf<Space>>& stars, SimplexTables& tables) {
  using Memory = MemoryOf<Space>;
  const Offset vertices = simplices.edge_begin.extent(0) - 1, edges = simplices.edge_low.extent(0);
  const auto begin = allocate<Array<Id, Memory>>("GALE::triangle_begin", edges + 1);
  parallel_for(
      "GALE::count_triangles", space, vertices, KOKKOS_LAMBDA(Offset v) {
        const Id first = simplices.edge_begin(v), last = simplices.edge_begin(v + 1);
        if (!UpperLink::is_for(simplices, v)) {
          for (Id edge = first; edge < last; ++edge) begin(edge) = 0;
          return;
        }
        const UpperLink link(simplices, stars, v);
        for (Id i = 0; i < link.size(); ++i) begin(first + i) = link.triangles(i);
      });
  const bool some_have_many = longest_row(space, simplices.edge_begin) > UpperLink::capacity;
  const auto many = some_have_many
                        ? SortedPairs<Space>(space, simplices.cells.extent(0), TrianglesOfMany<Memory>{simplices})
                        : SortedPairs<Space>();
  many.write_counts(begin);
  const auto apex = rows_with(space, "triangles", begin).entries;
  parallel_for(
      "GALE::write_triangles", space, vertices, KOKKOS_LAMBDA(Offset v) {
        if (!UpperLink::is_for(simplices, v)) return;
        const UpperLink link(simplices, stars, v);
        Id at = begin(simplices.edge_begin(v));
        for (Id i = 0; i < link.size(); ++i) link.for_each_apex(i, [&](Id c) { apex(at++) = c; });
      });
  many.write(begin, apex);
  tables.triangle_begin = begin;
  tables.triangle_apex = apex;
}

template <class Space>
void find_triangles_of_edges(const Space& space, const Simplices<MemoryOf<Space>>& s, SimplexTables& tables) {
  using Memory = MemoryOf<Space>;
  const Offset edges = s.edge_low.extent(0), triangles = s.cells.extent(0);
  const auto begin = allocate<Array<Id, Memory>>("GALE::triangle_begin", edges + 1),
             apex = allocate<Array<Id, Memory>>("GALE::triangle_apex", triangles);
  parallel_for(
      "GALE::triangle_begin", space, edges + 1, KOKKOS_LAMBDA(Offset e) {
        begin(e) = e == edges ? static_cast<Id>(triangles)
                              : bisect(s.cell_begin(s.edge_low(e)), s.cell_begin(s.edge_low(e) + 1),
                                       [&](Id f) { return s.cell(f).b < s.edge_high(e); });
      });
  parallel_for(
      "GALE::triangle_apex", space, triangles, KOKKOS_LAMBDA(Offset f) { apex(f) = s.cell(static_cast<Id>(f)).c; });
  tables.triangle_begin = begin;
  tables.triangle_apex = apex;
}

#define GALE_INSTANTIATE(Space)                                                           \
  template void enumerate_triangles(const Space&, const Simplices<MemoryOf<Space>>&,      \
                                    const MiddleStars<MemoryOf<Space>>&, SimplexTables&); \
  template void find_triangles_of_edges(const Space&, const Simplices<MemoryOf<Space>>&, SimplexTables&)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
