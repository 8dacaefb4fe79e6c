#include <gale/algorithms/excerpt/triangle_names.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

/// The vertices of triangles, three each.
using Vertices = Kokkos::View<Id*, WorkerMemory, Kokkos::MemoryUnmanaged>;

Vertices vertices_of(const Array<TriangleVertices, WorkerMemory>& triangles) {
  return Vertices(reinterpret_cast<Id*>(triangles.data()), 3 * triangles.extent(0));
}

/// Marks a vertex's name. Triangles side by side have most in common: bits that are there already are left alone.
struct MarkName {
  Vertices vertices;
  VertexNames names;
  Array<std::uint64_t, WorkerMemory> bits;

  KOKKOS_FUNCTION void operator()(Offset i) const {
    const Id name = names[vertices(i)];
    const std::uint64_t bit = std::uint64_t(1) << (name & 63);
    std::uint64_t& word = bits(name >> 6);
    if ((atomic_read(&word) & bit) == 0) atomic_or(&word, bit);
  }
};

/// Calls a vertex what rename[name] says.
template <class Rename>
struct RenameVertex {
  Vertices vertices;
  VertexNames names;
  Rename rename;

  KOKKOS_FUNCTION void operator()(Offset i) const { vertices(i) = rename[names[vertices(i)]]; }
};

struct AsIs {
  KOKKOS_FUNCTION Id operator[](Id name) const { return name; }
};

template <class Rename>
void rename_all(const TrianglesThere& triangles, const VertexNames& names, const Rename& rename) {
  const WorkerSpace space;
  for (const auto& part : triangles) {
    const Vertices vertices = vertices_of(part);
    parallel_for("GALE::rename_vertices", space, vertices.extent(0), RenameVertex<Rename>{vertices, names, rename});
  }
  space.fence();
}

}  // namespace

std::vector<std::uint64_t> names_passed(const TrianglesThere& triangles, const VertexNames& names, std::size_t words) {
  const WorkerSpace space;
  const auto bits = allocate<Array<std::uint64_t, WorkerMemory>>("GALE::names_passed", words);
  fill("GALE::names_passed", space, bits, std::uint64_t(0));
  for (const auto& part : triangles) {
    const Vertices vertices = vertices_of(part);
    parallel_for("GALE::names_passed", space, vertices.extent(0), MarkName{vertices, names, bits});
  }
  space.fence();
  return vector_of(bits);
}

void rename_vertices(const TrianglesThere& triangles, const VertexNames& names, const NumberedSet* numbers) {
  if (triangles.empty()) return;
  if (numbers == nullptr) return rename_all(triangles, names, AsIs());
  const auto words = in_memory<WorkerMemory>(numbers->words());
  rename_all(triangles, names, MemberNumbers{words.data()});
}

}  // namespace gale::detail
