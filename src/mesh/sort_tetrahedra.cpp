#include <array>
#include <limits>
#include <string>

#include <gale/base/atomic.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/require_ids.hpp>
#include <gale/mesh/encode.hpp>

namespace gale::detail {

namespace {

using Ids = Array<Id, WorkerMemory>;

/// A tetrahedron's vertices in GALE's ids, ascending, and where it stood in the input.
struct Quad {
  Id vertex[4];
  Id input;

  KOKKOS_FUNCTION bool operator<(const Quad& other) const {
    for (int corner = 0; corner < 4; ++corner) {
      if (vertex[corner] != other.vertex[corner]) return vertex[corner] < other.vertex[corner];
    }
    return input < other.input;
  }
};

KOKKOS_INLINE_FUNCTION void order(Id& a, Id& b) {
  const Id low = a < b ? a : b;
  b = a < b ? b : a;
  a = low;
}

template <class Index>
KOKKOS_FUNCTION Quad renumbered(const Tetrahedra<Index, WorkerMemory>& input, const Ids& vertex_internal, Offset t) {
  Quad quad;
  quad.input = static_cast<Id>(t);
  for (int corner = 0; corner < 4; ++corner) quad.vertex[corner] = vertex_internal(input(t, corner));
  order(quad.vertex[0], quad.vertex[1]);
  order(quad.vertex[2], quad.vertex[3]);
  order(quad.vertex[0], quad.vertex[2]);
  order(quad.vertex[1], quad.vertex[3]);
  order(quad.vertex[1], quad.vertex[2]);
  return quad;
}

/// Is there something wrong with the tetrahedron by itself?
template <class Index>
KOKKOS_FUNCTION bool is_bad(const Tetrahedra<Index, WorkerMemory>& input, Offset t, Offset vertices) {
  for (int corner = 0; corner < 4; ++corner) {
    const Index v = input(t, corner);
    if (v < 0 || v >= vertices) return true;
    for (int other = 0; other < corner; ++other) {
      if (input(t, other) == v) return true;
    }
  }
  return false;
}

/// Says what `is_bad` found.
template <class Index>
[[noreturn]] void refuse(const Tetrahedra<Index, WorkerMemory>& input, Offset t, Offset vertices) {
  const auto row = Kokkos::subview(input, std::make_pair(t, t + 1), Kokkos::ALL());
  const auto quad = Kokkos::create_mirror_view_and_copy(HostMemory(), row);
  const std::string name = "tetrahedron " + std::to_string(t);
  for (int corner = 0; corner < 4; ++corner) {
    const Index v = quad(0, corner);
    if (v < 0 || v >= vertices) {
      throw Error(name + " has vertex " + std::to_string(v) + ", but vertices are 0 to " +
                  std::to_string(vertices - 1));
    }
    for (int other = 0; other < corner; ++other) {
      if (quad(0, other) == v) throw Error(name + " has vertex " + std::to_string(v) + " twice");
    }
  }
  throw Error(name + " is not valid");
}

template <class Index>
void validate(const Tetrahedra<Index, WorkerMemory>& input, Offset vertices) {
  const Offset count = input.extent(0);
  if (count == 0) throw Error("the mesh has no tetrahedra");
  require_ids("tetrahedra", count);
  const Offset bad = reduce_min(
      "GALE::validate_tetrahedra", WorkerSpace(), count, count,
      KOKKOS_LAMBDA(Offset t) { return is_bad(input, t, vertices) ? t : count; });
  if (bad < count) refuse(input, bad, vertices);
}

KOKKOS_FUNCTION Quad load(const SortedTetrahedra& sorted, Id t) {
  return {{sorted.vertices(t, 0), sorted.vertices(t, 1), sorted.vertices(t, 2), sorted.vertices(t, 3)},
          sorted.input(t)};
}

KOKKOS_FUNCTION void store(const SortedTetrahedra& sorted, Id t, const Quad& quad) {
  for (int corner = 0; corner < 4; ++corner) sorted.vertices(t, corner) = quad.vertex[corner];
  sorted.input(t) = quad.input;
}

KOKKOS_FUNCTION void sift_down(const SortedTetrahedra& sorted, Id begin, Id count, Id root) {
  const Quad quad = load(sorted, begin + root);
  for (Id child = 2 * root + 1; child < count; child = 2 * root + 1) {
    if (child + 1 < count && load(sorted, begin + child) < load(sorted, begin + child + 1)) ++child;
    const Quad larger = load(sorted, begin + child);
    if (!(quad < larger)) break;
    store(sorted, begin + root, larger);
    root = child;
  }
  store(sorted, begin + root, quad);
}

/// Sorts the tetrahedra of one lowest vertex: some six of them, so by insertion; a heap where they are many.
KOKKOS_FUNCTION void sort_bucket(const SortedTetrahedra& sorted, Id begin, Id end) {
  constexpr Id many = 64;
  if (end - begin <= many) {
    for (Id t = begin + 1; t < end; ++t) {
      const Quad quad = load(sorted, t);
      Id to = t;
      for (; to > begin; --to) {
        const Quad before = load(sorted, to - 1);
        if (!(quad < before)) break;
        store(sorted, to, before);
      }
      if (to != t) store(sorted, to, quad);
    }
    return;
  }
  for (Id root = (end - begin) / 2 - 1; root >= 0; --root) sift_down(sorted, begin, end - begin, root);
  for (Id count = end - begin - 1; count > 0; --count) {
    const Quad last = load(sorted, begin + count);
    store(sorted, begin + count, load(sorted, begin));
    store(sorted, begin, last);
    sift_down(sorted, begin, count, 0);
  }
}

KOKKOS_FUNCTION bool same_as_next(const SortedTetrahedra& sorted, Id t) {
  for (int corner = 0; corner < 4; ++corner) {
    if (sorted.vertices(t, corner) != sorted.vertices(t + 1, corner)) return false;
  }
  return true;
}

void refuse_duplicates(const SortedTetrahedra& sorted) {
  const auto count = static_cast<Id>(sorted.vertices.extent(0));
  const Id none = std::numeric_limits<Id>::max();
  const Id twin = reduce_min(
      "GALE::find_duplicates", WorkerSpace(), count - 1, none,
      KOKKOS_LAMBDA(Offset t) { return same_as_next(sorted, static_cast<Id>(t)) ? sorted.input(t + 1) : none; });
  if (twin == none) return;
  const Id first = reduce_min(
      "GALE::find_duplicate", WorkerSpace(), count - 1, none, KOKKOS_LAMBDA(Offset t) {
        return same_as_next(sorted, static_cast<Id>(t)) && sorted.input(t + 1) == twin ? sorted.input(t) : none;
      });
  throw Error("tetrahedra " + std::to_string(first) + " and " + std::to_string(twin) + " have the same four vertices");
}

}  // namespace

template <class Index>
SortedTetrahedra sort_tetrahedra(const Tetrahedra<Index, WorkerMemory>& input, const Ids& vertex_internal) {
  const WorkerSpace space;
  const Offset vertices = vertex_internal.extent(0);
  validate(input, vertices);
  const Offset count = input.extent(0);
  SortedTetrahedra sorted;
  sorted.begin = Ids("GALE::tetrahedra_of_lowest", vertices + 1);
  const Ids begin = sorted.begin;
  const Ids slot = allocate<Ids>("GALE::tetrahedron_slot", count);
  parallel_for(
      "GALE::count_tetrahedra", space, count, KOKKOS_LAMBDA(Offset t) {
        Id lowest = vertex_internal(input(t, 0));
        for (int corner = 1; corner < 4; ++corner) {
          const Id v = vertex_internal(input(t, corner));
          lowest = v < lowest ? v : lowest;
        }
        slot(t) = atomic_add(&begin(lowest), Id(1));
      });
  exclusive_scan(
      "GALE::scan_tetrahedra", space, vertices, begin, KOKKOS_LAMBDA(Offset v) { return begin(v); });
  sorted.vertices = allocate<decltype(sorted.vertices)>("GALE::tetrahedra", count);
  sorted.input = allocate<Ids>("GALE::tetrahedron_input", count);
  parallel_for(
      "GALE::move_tetrahedra", space, count, KOKKOS_LAMBDA(Offset t) {
        const Quad quad = renumbered(input, vertex_internal, t);
        store(sorted, begin(quad.vertex[0]) + slot(t), quad);
      });
  parallel_for(
      "GALE::sort_tetrahedra", space, vertices,
      KOKKOS_LAMBDA(Offset v) { sort_bucket(sorted, begin(v), begin(v + 1)); });
  refuse_duplicates(sorted);
  return sorted;
}

template SortedTetrahedra sort_tetrahedra(const Tetrahedra<std::int32_t, WorkerMemory>&, const Ids&);
template SortedTetrahedra sort_tetrahedra(const Tetrahedra<std::int64_t, WorkerMemory>&, const Ids&);

}  // namespace gale::detail
