#include <limits>
#include <string>

#include <gale/base/atomic.hpp>
#include <gale/base/error.hpp>
#include <gale/base/group_by.hpp>
#include <gale/base/ordered.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/encode.hpp>

namespace gale::detail {

namespace {

/// A tetrahedron in GALE's ids, and where it stood in the input.
struct Entry {
  Quad vertices;
  Id input;

  KOKKOS_FUNCTION bool operator<(const Entry& other) const {
    return vertices == other.vertices ? input < other.input : vertices < other.vertices;
  }
};

KOKKOS_INLINE_FUNCTION void put_in_order(Id& a, Id& b) {
  const Id low = a < b ? a : b;
  b = a < b ? b : a;
  a = low;
}

template <class Index, class Memory>
KOKKOS_FUNCTION Quad renumbered(const Tetrahedra<Index, Memory>& input, const Array<Id, Memory>& vertex_internal,
                                Offset t) {
  Quad quad{vertex_internal(input(t, 0)), vertex_internal(input(t, 1)), vertex_internal(input(t, 2)),
            vertex_internal(input(t, 3))};
  put_in_order(quad.a, quad.b);
  put_in_order(quad.c, quad.d);
  put_in_order(quad.a, quad.c);
  put_in_order(quad.b, quad.d);
  put_in_order(quad.b, quad.c);
  return quad;
}

/// Is there something wrong with the tetrahedron by itself?
template <class Index, class Memory>
KOKKOS_FUNCTION bool is_bad(const Tetrahedra<Index, Memory>& input, Offset t, Offset vertices) {
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
template <class Index, class Memory>
[[noreturn]] void refuse(const Tetrahedra<Index, Memory>& input, Offset t, Offset vertices) {
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

template <class Index, class Space>
void validate(const Space& space, const Tetrahedra<Index, MemoryOf<Space>>& input, Offset vertices) {
  const Offset count = input.extent(0);
  require_ids("tetrahedra", count);
  const Offset bad = reduce_min(
      "GALE::validate_tetrahedra", space, count, count,
      KOKKOS_LAMBDA(Offset t) { return is_bad(input, t, vertices) ? t : count; });
  if (bad < count) refuse(input, bad, vertices);
}

template <class Memory>
KOKKOS_FUNCTION Entry load(const SortedTetrahedra<Memory>& sorted, Id t) {
  return {sorted.of_lowest.entries(t), sorted.input(t)};
}

template <class Memory>
KOKKOS_FUNCTION void store(const SortedTetrahedra<Memory>& sorted, Id t, const Entry& entry) {
  sorted.of_lowest.entries(t) = entry.vertices;
  sorted.input(t) = entry.input;
}

/// Sorts the tetrahedra of one lowest vertex: some six of them, so by insertion; a heap where they are many.
template <class Memory>
KOKKOS_FUNCTION void sort_bucket(const SortedTetrahedra<Memory>& sorted, Id begin, Id end) {
  constexpr Id many = 64;
  if (end - begin <= many) {
    for (Id t = begin + 1; t < end; ++t) {
      const Entry entry = load(sorted, t);
      Id to = t;
      for (; to > begin; --to) {
        const Entry before = load(sorted, to - 1);
        if (!(entry < before)) break;
        store(sorted, to, before);
      }
      if (to != t) store(sorted, to, entry);
    }
    return;
  }
  heap_sort(
      end - begin, [&](Id i) { return load(sorted, begin + i); },
      [&](Id i, const Entry& entry) { store(sorted, begin + i, entry); });
}

template <class Memory>
KOKKOS_FUNCTION bool same_as_next(const SortedTetrahedra<Memory>& sorted, Offset t) {
  return sorted.of_lowest.entries(t) == sorted.of_lowest.entries(t + 1);
}

template <class Space>
void refuse_duplicates(const Space& space, const SortedTetrahedra<MemoryOf<Space>>& sorted) {
  const auto count = static_cast<Id>(sorted.of_lowest.entries.extent(0));
  if (count == 0) return;
  const Id none = std::numeric_limits<Id>::max();
  const Id twin = reduce_min(
      "GALE::find_duplicates", space, count - 1, none,
      KOKKOS_LAMBDA(Offset t) { return same_as_next(sorted, t) ? sorted.input(t + 1) : none; });
  if (twin == none) return;
  const Id first = reduce_min(
      "GALE::find_duplicate", space, count - 1, none, KOKKOS_LAMBDA(Offset t) {
        return same_as_next(sorted, t) && sorted.input(t + 1) == twin ? sorted.input(t) : none;
      });
  throw Error("tetrahedra " + std::to_string(first) + " and " + std::to_string(twin) + " have the same four vertices");
}

template <class Space>
Array<Id, MemoryOf<Space>> segment_of_vertices(const Space& space, const EncodedMesh<MemoryOf<Space>>& mesh,
                                               Offset vertices) {
  const auto segment_of = allocate<Array<Id, MemoryOf<Space>>>("GALE::segment_of", vertices);
  const auto begin = mesh.vertex_begin;
  const auto segments = static_cast<Id>(begin.extent(0)) - 1;
  parallel_for(
      "GALE::segment_of", space, vertices,
      KOKKOS_LAMBDA(Offset v) { segment_of(v) = bisect(Id(0), segments, [&](Id s) { return begin(s + 1) <= v; }); });
  return segment_of;
}

/// The segments that a tetrahedron touches beside the one it is internal to. Its vertices ascend, and so do their
/// segments.
template <class Memory>
struct ExternalSegments {
  EncodedMesh<Memory> mesh;
  Borrowed<Id, Memory> segment_of;

  template <class Visit>
  KOKKOS_FUNCTION void operator()(Id t, const Visit& visit) const {
    Id previous = segment_of(mesh.tetrahedra(t, 0));
    if (mesh.tetrahedra(t, 3) < mesh.vertex_begin(previous + 1)) return;
    for (int corner = 1; corner < 4; ++corner) {
      const Id here = segment_of(mesh.tetrahedra(t, corner));
      if (here != previous) visit(here);
      previous = here;
    }
  }
};

}  // namespace

template <class Space, class Index>
SortedTetrahedra<MemoryOf<Space>> sort_tetrahedra(const Space& space, const Tetrahedra<Index, MemoryOf<Space>>& input,
                                                  const Array<Id, MemoryOf<Space>>& vertex_internal) {
  using Ids = Array<Id, MemoryOf<Space>>;
  const Offset vertices = vertex_internal.extent(0);
  validate<Index>(space, input, vertices);
  const Offset count = input.extent(0);
  SortedTetrahedra<MemoryOf<Space>> sorted;
  const auto begin = allocate<Ids>("GALE::tetrahedra_of_lowest", vertices + 1);
  sorted.of_lowest.offsets = begin;
  fill("GALE::clear_counts", space, begin, 0);
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
  sorted.of_lowest.entries = allocate<decltype(sorted.of_lowest.entries)>("GALE::tetrahedra", count);
  sorted.input = allocate<Ids>("GALE::tetrahedron_input", count);
  parallel_for(
      "GALE::move_tetrahedra", space, count, KOKKOS_LAMBDA(Offset t) {
        const Quad quad = renumbered(input, vertex_internal, t);
        store(sorted, begin(quad.a) + slot(t), {quad, static_cast<Id>(t)});
      });
  parallel_for(
      "GALE::sort_tetrahedra", space, vertices,
      KOKKOS_LAMBDA(Offset v) { sort_bucket(sorted, begin(v), begin(v + 1)); });
  refuse_duplicates(space, sorted);
  return sorted;
}

template <class Space>
Csr<Id, MemoryOf<Space>> find_external_tetrahedra(const Space& space, const EncodedMesh<MemoryOf<Space>>& mesh,
                                                  Id vertices) {
  const auto segment_of = segment_of_vertices(space, mesh, vertices);
  const auto external = group_by("GALE::external", space, mesh.tetrahedra.extent(0), mesh.vertex_begin.extent(0) - 1,
                                 ExternalSegments<MemoryOf<Space>>{mesh, segment_of});
  sort_rows(space, "GALE::sort_external", external);
  return external;
}

#define GALE_INSTANTIATE_INDEX(Space, Index)                                                                          \
  template SortedTetrahedra<MemoryOf<Space>> sort_tetrahedra(const Space&, const Tetrahedra<Index, MemoryOf<Space>>&, \
                                                             const Array<Id, MemoryOf<Space>>&)
#define GALE_INSTANTIATE(Space)                \
  GALE_INSTANTIATE_INDEX(Space, std::int32_t); \
  GALE_INSTANTIATE_INDEX(Space, std::int64_t); \
  template Csr<Id, MemoryOf<Space>> find_external_tetrahedra(const Space&, const EncodedMesh<MemoryOf<Space>>&, Id)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE
#undef GALE_INSTANTIATE_INDEX

}  // namespace gale::detail
