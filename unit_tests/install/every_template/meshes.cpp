#include <algorithm>
#include <vector>

#include <gale/mesh/make_mesh.hpp>
#include <gale/relations/batch.hpp>
#include <gale/relations/faces.hpp>
#include <gale/relations/preconditioning.hpp>

#include "parts.hpp"

namespace every_template {

namespace {

using gale::HostMemory;
using gale::Id;
using gale::PinnedMemory;
using gale::WorkerMemory;

template <class PointView, class TetrahedronView>
void make(const PointView& points_view, const TetrahedronView& tetrahedron_view) {
  const gale::Mesh mesh = gale::make_mesh(points_view, tetrahedron_view);
  expect(mesh.vertices() == vertices && mesh.cells() == tetrahedra, "a mesh of Views");
}

/// From Views of some layout and memory, of such types, and from their const and unmanaged kinds.
template <class Coordinate, class Index, class Layout, class Memory>
void make_of() {
  const Kokkos::View<Coordinate**, Layout, Memory> p("points", vertices, 3);
  const Kokkos::View<Index* [4], Layout, Memory> t("tetrahedra", tetrahedra);
  fill(p, points);
  fill(t, corners);
  make(p, t);
  make(Kokkos::View<const Coordinate**, Layout, Memory>(p), Kokkos::View<const Index* [4], Layout, Memory>(t));
  make(Kokkos::View<Coordinate**, Layout, Memory, Kokkos::MemoryUnmanaged>(p.data(), vertices, 3),
       Kokkos::View<const Index**, Layout, Memory, Kokkos::MemoryUnmanaged>(t.data(), tetrahedra, 4));
}

/// Rows with something behind them.
template <class Memory>
void make_of_strided() {
  const Kokkos::View<double* [4], Kokkos::LayoutRight, Memory> p("points", vertices);
  const Kokkos::View<int* [5], Kokkos::LayoutRight, Memory> t("tetrahedra", tetrahedra);
  double wide_points[vertices][4] = {};
  int wide_corners[tetrahedra][5] = {};
  for (int i = 0; i < vertices; ++i) std::copy_n(points[i], 3, wide_points[i]);
  for (int i = 0; i < tetrahedra; ++i) std::copy_n(corners[i], 4, wide_corners[i]);
  fill(p, wide_points);
  fill(t, wide_corners);
  make(Kokkos::subview(p, Kokkos::ALL(), std::make_pair(0, 3)),
       Kokkos::subview(t, Kokkos::ALL(), std::make_pair(0, 4)));
}

/// A grid, whose cells are computed.
template <class Memory>
void make_grid() {
  const gale::Grid grid({3, 3, 3});
  gale::Id seen = 0;
  grid.for_each_vertex(0, 9, [&](gale::Id, gale::Id, gale::Id vertex) { seen += vertex == seen; });
  expect(seen == 27 && grid.in<Memory>().nx == 3 && grid.kinds_in<Memory>() != nullptr, "a grid");
  expect(gale::Mesh(grid).cells() == 48, "the mesh of a grid");
  const Kokkos::View<gale::Id* [4], gale::HostMemory> cells("cells", 48);
  grid.write_cells(cells);
  expect(cells(0, 3) == 13, "the cells of a grid");
}

template <class Memory>
void make_in() {
  make_of<double, std::int64_t, Kokkos::LayoutRight, Memory>();
  make_of<float, std::int32_t, Kokkos::LayoutRight, Memory>();
  make_of<double, long long, Kokkos::LayoutLeft, Memory>();
  make_of<float, unsigned, Kokkos::LayoutLeft, Memory>();
  make_of<double, short, Kokkos::LayoutRight, Memory>();
  make_of<double, unsigned char, Kokkos::LayoutRight, Memory>();
  make_of<float, unsigned long, Kokkos::LayoutRight, Memory>();
  make_of_strided<Memory>();
}

template <class Coordinate, class Index>
void make_of_vectors() {
  std::vector<Coordinate> p;
  std::vector<Index> t;
  for (const auto& point : points) p.insert(p.end(), point, point + 3);
  for (const auto& cell : corners) t.insert(t.end(), cell, cell + 4);
  expect(gale::make_mesh(p, t).cells() == tetrahedra, "a mesh of vectors");
}

template <class T, class Memory>
Kokkos::View<T*, Memory> entries(const std::vector<int>& values) {
  const Kokkos::View<T*, Memory> view("entries", values.size());
  const auto host = Kokkos::create_mirror_view(view);
  for (std::size_t k = 0; k < values.size(); ++k) host(k) = static_cast<T>(values[k]);
  Kokkos::deep_copy(view, host);
  return view;
}

/// Cells by VTK's numbers, from Views of such types in such memory.
template <class Index, class Begin, class Type, class Memory>
void make_of_cells() {
  const Kokkos::View<double* [3], HostMemory> p("points", vertices);
  fill(p, points);
  std::vector<int> all;
  for (const auto& cell : corners) all.insert(all.end(), cell, cell + 4);
  std::vector<int> begin(tetrahedra + 1);
  for (int t = 0; t <= tetrahedra; ++t) begin[t] = 4 * t;
  const auto make_with = [&](int type) {
    return gale::make_mesh(p, entries<Index, Memory>(all), entries<Begin, HostMemory>(begin),
                           entries<Type, Memory>(std::vector<int>(tetrahedra, type)));
  };
  expect(make_with(gale::cell_type::tetrahedron).cells() == tetrahedra, "a mesh of cells");
  const auto connectivity = entries<Index, Memory>(all);
  const auto offsets = entries<Begin, Memory>(begin);
  const auto types = entries<Type, Memory>(std::vector<int>(tetrahedra, gale::cell_type::quad));
  const auto cells = gale::cells_of(connectivity, offsets, types);
  using Held = std::decay_t<decltype(cells)>;
  using Known = gale::Cells<typename decltype(Held::connectivity)::non_const_value_type,
                            typename decltype(Held::connectivity)::memory_space>;
  static_assert(std::is_same_v<Held, Known>, "cells in their memory");
  expect(!gale::are_tetrahedra(cells), "no tetrahedra");
  const gale::SplitCells<3, typename decltype(Held::connectivity)::memory_space> flat =
      gale::split_polygons(cells, vertices);
  expect(flat.simplices.extent(0) == 2 * tetrahedra, "triangles");
  expect(gale::split_cells(cells, vertices).simplices.extent(0) == 0, "quads are no tetrahedra");
}

/// A mesh with a segmentation of the caller's, from arrays in such memory.
template <class Coordinate, class Index, class Memory>
void segment() {
  const Kokkos::View<Coordinate* [3], Kokkos::LayoutRight, Memory> p("points", vertices);
  const Kokkos::View<Index* [4], Kokkos::LayoutRight, Memory> t("tetrahedra", tetrahedra);
  const gale::Points<Coordinate, Memory> const_points = fill(p, points);
  const gale::Tetrahedra<Index, Memory> const_tetrahedra = fill(t, corners);
  const gale::Mesh mesh(const_tetrahedra, gale::octree_segmentation(const_points, 2));
  expect(mesh.segments() >= 3, "segments of two vertices");
}

template <gale::Relation relation, class Memory>
void look_up(const gale::Mesh& mesh) {
  const auto simplices = mesh.simplices<Memory>(gale::needs_of(relation));
  if constexpr (!gale::is_device_memory<Memory>) {
    const gale::FaceRow<gale::face_count(relation)> row = gale::face_row<relation>(simplices, 0);
    expect(row[0] == 0, "the first face of the first simplex");
  }
}

/// What a mesh has in such memory.
template <class Memory>
void read(const gale::Mesh& mesh) {
  const gale::EncodedMesh<Memory> encoded = mesh.encoded<Memory>();
  expect(encoded.cells.extent(0) == tetrahedra, "encoded tetrahedra");
  for (const auto* const permutation : {&mesh.vertex_input<Memory>(), &mesh.vertex_internal<Memory>()})
    expect(permutation->extent(0) == vertices, "permuted vertices");
  expect(mesh.cell_input<Memory>().extent(0) == tetrahedra, "permuted tetrahedra");
  expect(mesh.vertices_in_input<Memory>().table != nullptr && mesh.vertices_of_input<Memory>().table != nullptr &&
             mesh.cells_in_input<Memory>().table != nullptr && mesh.cell_reader<Memory>().vertices != nullptr,
         "tables that aren't those of a grid");
  const gale::Grid grid({2, 3, 4});
  expect(grid.in<Memory>().is_whole() && gale::Mesh(grid).cells() == 36, "a grid");
  const gale::Simplices<Memory> simplices = mesh.simplices<Memory>({gale::Enumeration::triangles});
  expect(simplices.edge_high.extent(0) == edges && simplices.triangle_apex.extent(0) == triangles, "simplices");
  expect(gale::first_of(mesh.interval_begin<Memory>(1), 1).extent(0) == 1, "intervals");
  const gale::IntervalTables<Memory> intervals = gale::interval_tables<Memory>(mesh);
  const gale::Batch<Memory> batch{{}, 0, {}, nullptr, nullptr, intervals};
  expect(batch.count == 0 && intervals.begin[0] != nullptr, "tables of intervals");
  look_up<gale::Relation::EV, Memory>(mesh);
  look_up<gale::Relation::FV, Memory>(mesh);
  look_up<gale::Relation::FE, Memory>(mesh);
  look_up<gale::Relation::TV, Memory>(mesh);
  look_up<gale::Relation::TE, Memory>(mesh);
  look_up<gale::Relation::TF, Memory>(mesh);
}

}  // namespace

gale::Mesh two_tetrahedra() {
  const Kokkos::View<double* [3], HostMemory> p("points", vertices);
  const Kokkos::View<int* [4], HostMemory> t("tetrahedra", tetrahedra);
  return gale::make_mesh(fill(p, points), fill(t, corners));
}

void use_meshes() {
  std::vector<int> room;
  gale::reserve(room, vertices);
  expect(room.capacity() >= vertices, "room");
  make_grid<HostMemory>();
  make_grid<WorkerMemory>();
  make_in<HostMemory>();
  make_in<WorkerMemory>();
  make_in<PinnedMemory>();
  make_of_vectors<float, int>();
  make_of_vectors<double, std::int64_t>();
  make_of_vectors<double, unsigned>();
  make_of_cells<std::int32_t, int, int, HostMemory>();
  make_of_cells<std::int64_t, std::int64_t, std::uint8_t, WorkerMemory>();
  make_of_cells<unsigned, unsigned long, char, PinnedMemory>();
  segment<float, std::int32_t, HostMemory>();
  segment<double, std::int64_t, HostMemory>();
  segment<float, std::int64_t, WorkerMemory>();
  segment<double, std::int32_t, WorkerMemory>();
  const gale::Mesh mesh = two_tetrahedra();
  read<HostMemory>(mesh);
  read<WorkerMemory>(mesh);
  gale::in_worker_or_host_space(mesh, [&](const auto& space) {
    using Memory = gale::MemoryOf<std::decay_t<decltype(space)>>;
    const auto ids = gale::allocate<gale::Array<Id, Memory>>("ids", mesh.vertices());
    Kokkos::deep_copy(ids, mesh.vertex_input<Memory>());
    return ids.extent(0);
  });
}

}  // namespace every_template
