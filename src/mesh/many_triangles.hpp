#pragma once

#include <cstdint>

#include <gale/base/atomic.hpp>
#include <gale/base/pair_key.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/radix_sort.hpp>
#include <gale/mesh/simplices.hpp>
#include <gale/mesh/upper_link.hpp>

namespace gale::detail {

/// Calls visit(key) for the triangles (a, b, .) of a tetrahedron whose vertex a has too many higher neighbours for an
/// UpperLink. Keys are in the order of the triangles.
template <class Memory, class Visit>
KOKKOS_FUNCTION void for_each_triangle_key(const Simplices<Memory>& s, Id tetrahedron, const Visit& visit) {
  const auto has_many = [&s](Id v) { return s.edge_begin(v + 1) - s.edge_begin(v) > UpperLink::capacity; };
  const Quad quad = s.tetrahedron(tetrahedron);
  if (has_many(quad.a)) {
    const Id edge = s.edge_of(quad.a, quad.b);
    visit(pair_key(edge, quad.c));
    visit(pair_key(edge, quad.d));
    visit(pair_key(s.edge_of(quad.a, quad.c), quad.d));
  }
  if (has_many(quad.b)) visit(pair_key(s.edge_of(quad.b, quad.c), quad.d));
}

/// The triangles that begin with such vertices. They are written down as keys by each tetrahedron that has them, and
/// sorted: n log n time, and 36 bytes for each of n keys, which are at most four for a tetrahedron.
template <class Space>
class ManyTriangles {
 public:
  using Memory = MemoryOf<Space>;
  using Tables = Simplices<Memory>;
  using Ids = Array<Id, Memory>;
  using Offsets = Array<Offset, Memory>;
  using Keys = Array<std::uint64_t, Memory>;

  /// Holds no triangles.
  ManyTriangles() = default;

  /// All of them. `simplices` has the edges.
  ManyTriangles(const Space& space, const Tables& simplices) : space_(space) {
    gather(simplices);
    stable_sort_by_key(space_, keys_, Ids("GALE::no_values", keys_.extent(0)));
    number();
  }

  /// count[e] = how many there are, for each edge e that has some. Leaves other edges as they are.
  void write_counts(const Ids& count) const {
    const auto keys = keys_;
    const auto number = number_;
    const Offset n = keys.extent(0);
    parallel_for(
        "GALE::count_many_triangles", space_, n, KOKKOS_LAMBDA(Offset i) {
          const Id edge = edge_of(keys(i));
          const bool is_last = i + 1 == n || edge_of(keys(i + 1)) != edge;
          if (is_last) count(edge) = static_cast<Id>(number(i + 1) - number(first_of(keys, edge)));
        });
  }

  /// Writes the apexes of the triangles. begin[e] is where those of edge e are.
  void write(const Ids& begin, const Ids& apexes) const {
    const auto keys = keys_;
    const auto number = number_;
    parallel_for(
        "GALE::write_many_triangles", space_, keys.extent(0), KOKKOS_LAMBDA(Offset i) {
          if (number(i + 1) == number(i)) return;
          const Id edge = edge_of(keys(i));
          const Offset at = begin(edge) + number(i) - number(first_of(keys, edge));
          apexes(at) = static_cast<Id>(keys(i) & 0xffffffffu);
        });
  }

  // The steps of construction; nvcc wants them public, as their lambdas are kernels.

  void gather(const Tables& simplices) {
    const Space space = space_;
    const Offset tetrahedra = simplices.tetrahedra.extent(0);
    const Offset count = reduce_sum(
        "GALE::count_triangle_keys", space, tetrahedra, KOKKOS_LAMBDA(Offset t) {
          Offset triangles = 0;
          for_each_triangle_key(simplices, static_cast<Id>(t), [&](std::uint64_t) { ++triangles; });
          return triangles;
        });
    const auto keys = allocate<Keys>("GALE::triangle_keys", count);
    const Offsets next("GALE::next_triangle_key", 1);
    parallel_for(
        "GALE::gather_triangle_keys", space, tetrahedra, KOKKOS_LAMBDA(Offset t) {
          for_each_triangle_key(simplices, static_cast<Id>(t),
                                [&](std::uint64_t key) { keys(atomic_add(&next(0), Offset(1))) = key; });
        });
    keys_ = keys;
  }

  /// number[i] = how many different keys come before the i-th.
  void number() {
    const auto keys = keys_;
    number_ = allocate<Offsets>("GALE::triangle_number", keys.extent(0) + 1);
    exclusive_scan(
        "GALE::number_triangles", space_, keys.extent(0), number_,
        KOKKOS_LAMBDA(Offset i) { return i + 1 == Offset(keys.extent(0)) || keys(i) != keys(i + 1) ? 1 : 0; });
  }

  KOKKOS_FUNCTION static Id edge_of(std::uint64_t key) { return static_cast<Id>(key >> 32); }

  /// Place of the first key of an edge.
  KOKKOS_FUNCTION static Offset first_of(const Keys& keys, Id edge) {
    Offset begin = 0, end = keys.extent(0);
    while (begin < end) {
      const Offset middle = begin + (end - begin) / 2;
      if (edge_of(keys(middle)) < edge) {
        begin = middle + 1;
      } else {
        end = middle;
      }
    }
    return begin;
  }

 private:
  Space space_;
  Keys keys_;
  Offsets number_;
};

}  // namespace gale::detail
