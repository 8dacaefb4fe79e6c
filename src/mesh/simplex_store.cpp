#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/enumerate.hpp>
#include <gale/mesh/simplex_store.hpp>

namespace gale::detail {

namespace {

/// Copies an array to the host unless it is there.
template <class View, class HostView>
void mirror(const View& from, HostView& to) {
  if (to.data() == nullptr) to = gale::on_host(from);
}

template <class Memory>
void add_tables(const SimplexTables<Memory>& tables, Simplices<Memory>& view) {
  view.edge_begin = tables.edge_begin;
  view.edge_low = tables.edge_low;
  view.edge_high = tables.edge_high;
  view.triangle_begin = tables.triangle_begin;
  view.triangle_edge = tables.triangle_edge;
  view.triangle_apex = tables.triangle_apex;
  view.lower_begin = tables.lower_begin;
  view.lower_edges = tables.lower_edges;
  view.longest_list = tables.longest_list;
}

/// `vertex_begin` is unmanaged, since other threads may copy the mesh' own at this moment.
Array<Id, WorkerMemory> interval_begin_of(
    const Simplices<WorkerMemory>& simplices,
    const Kokkos::View<const Id*, WorkerMemory, Kokkos::MemoryUnmanaged>& vertex_begin, int dimension) {
  const auto begin = allocate<Array<Id, WorkerMemory>>("GALE::interval_begin", vertex_begin.extent(0));
  parallel_for(
      "GALE::interval_begin", WorkerSpace(), begin.extent(0), KOKKOS_LAMBDA(Offset s) {
        const Id edge = simplices.edge_begin(vertex_begin(s));
        begin(s) = dimension == 1 ? edge : simplices.triangle_begin(edge);
      });
  return begin;
}

bool has(const Array<Id, WorkerMemory>& table) { return table.data() != nullptr; }

}  // namespace

Simplices<WorkerMemory> SimplexStore::on_worker(const SimplexNeeds& needs) {
  const std::lock_guard<std::mutex> lock(mutex_);
  enumerate(needs);
  return worker_view();
}

Simplices<HostMemory> SimplexStore::on_host(const SimplexNeeds& needs) {
  const std::lock_guard<std::mutex> lock(mutex_);
  enumerate(needs);
  if (needs.upto >= Enumeration::edges) {
    mirror(tables_.edge_begin, host_tables_.edge_begin);
    mirror(tables_.edge_low, host_tables_.edge_low);
    mirror(tables_.edge_high, host_tables_.edge_high);
  }
  if (needs.upto >= Enumeration::triangles) {
    mirror(tables_.triangle_begin, host_tables_.triangle_begin);
    mirror(tables_.triangle_edge, host_tables_.triangle_edge);
    mirror(tables_.triangle_apex, host_tables_.triangle_apex);
  }
  if (needs.lower_edges) {
    mirror(tables_.lower_begin, host_tables_.lower_begin);
    mirror(tables_.lower_edges, host_tables_.lower_edges);
    host_tables_.longest_list = tables_.longest_list;
  }
  if (needs.tetrahedra) {
    mirror(mesh_.tetrahedra, host_tetrahedra_);
    mirror(tetrahedron_begin_, host_tetrahedron_begin_);
  }
  return host_view();
}

const Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory>& SimplexStore::tetrahedra_on_host() {
  const std::lock_guard<std::mutex> lock(mutex_);
  mirror(mesh_.tetrahedra, host_tetrahedra_);
  return host_tetrahedra_;
}

const Array<const Id, HostMemory>& SimplexStore::interval_begin(int dimension) {
  const auto* const published = published_intervals_[dimension - 1].load(std::memory_order_acquire);
  if (published != nullptr) return *published;
  const std::lock_guard<std::mutex> lock(mutex_);
  SimplexNeeds needs;
  needs.upto = dimension == 1 ? Enumeration::edges : Enumeration::triangles;
  enumerate(needs);
  return intervals_[dimension - 1];
}

Id SimplexStore::known(int dimension) const {
  const auto* const published = published_intervals_[dimension - 1].load(std::memory_order_acquire);
  return published == nullptr ? no_id : (*published)(published->extent(0) - 1);
}

void SimplexStore::enumerate(const SimplexNeeds& needs) {
  const bool edges = needs.upto >= Enumeration::edges && !has(tables_.edge_begin);
  const bool triangles = needs.upto >= Enumeration::triangles && !has(tables_.triangle_begin);
  if (edges || triangles) {
    const MiddleStars stars = find_middle_stars(worker_view());
    if (edges) {
      enumerate_edges(worker_view(), stars, tables_);
      publish_intervals(1);
    }
    if (triangles) {
      enumerate_triangles(worker_view(), stars, tables_);
      publish_intervals(2);
    }
  }
  if (needs.lower_edges && !has(tables_.lower_begin)) sort_edges_by_higher(worker_view(), tables_);
}

Simplices<WorkerMemory> SimplexStore::worker_view() const {
  Simplices<WorkerMemory> view;
  view.tetrahedra = mesh_.tetrahedra;
  view.tetrahedron_begin = tetrahedron_begin_;
  add_tables(tables_, view);
  return view;
}

Simplices<HostMemory> SimplexStore::host_view() const {
  Simplices<HostMemory> view;
  view.tetrahedra = host_tetrahedra_;
  view.tetrahedron_begin = host_tetrahedron_begin_;
  add_tables(host_tables_, view);
  return view;
}

void SimplexStore::publish_intervals(int dimension) {
  intervals_[dimension - 1] = gale::on_host(interval_begin_of(worker_view(), mesh_.vertex_begin, dimension));
  published_intervals_[dimension - 1].store(&intervals_[dimension - 1], std::memory_order_release);
}

}  // namespace gale::detail
