#include <gale/algorithms/excerpt/triangle_names.hpp>
#include <gale/base/bit_table.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>

namespace gale::detail {

namespace {

/// The vertices of triangles, three each.
using Vertices = Kokkos::View<Id*, WorkerMemory, Kokkos::MemoryUnmanaged>;

Vertices vertices_of(const Array<TriangleVertices, WorkerMemory>& triangles) {
  return Vertices(reinterpret_cast<Id*>(triangles.data()), 3 * triangles.extent(0));
}

/// Marks a vertex's name, as triangles side by side do again.
struct MarkName {
  Vertices vertices;
  VertexNames names;
  BitTable passed;

  KOKKOS_FUNCTION void operator()(Offset i) const { passed.insert_again(names[vertices(i)]); }
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

std::vector<std::uint64_t> names_passed(const TrianglesThere& triangles, const VertexNames& names, Id count) {
  const WorkerSpace space;
  const BitTable passed("GALE::names_passed", space, count);
  for (const auto& part : triangles) {
    const Vertices vertices = vertices_of(part);
    parallel_for("GALE::names_passed", space, vertices.extent(0), MarkName{vertices, names, passed});
  }
  space.fence();
  return vector_of(passed.words());
}

void rename_vertices(const TrianglesThere& triangles, const VertexNames& names, const NumberedSet* numbers) {
  if (triangles.empty()) return;
  if (numbers == nullptr) return rename_all(triangles, names, AsIs());
  const auto words = in_memory<WorkerMemory>(numbers->words());
  rename_all(triangles, names, MemberNumbers{words.data()});
}

}  // namespace gale::detail
