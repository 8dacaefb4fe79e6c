#include <gale/base/kokkos.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/numbering/enumerate.hpp>
#include <gale/mesh/numbering/simplex_store.hpp>

namespace gale::detail {

namespace {

bool has(const Mirrored<Id>& table) { return table.size() > 0; }

/// What is there of the tables that someone needs. Unmanaged, since other threads may copy the mesh's own at this
/// moment.
template <class Memory>
Simplices<Memory> view_of(const MeshArrays& mesh, const SimplexTables& tables, const SimplexNeeds& needs) {
  Simplices<Memory> view;
  view.dimension = mesh.dimension;
  if (needs.cells || (is_device_memory<Memory> && mesh.cells.on_device())) {
    view.cells = by_four(mesh.cells.in<Memory>());
    view.cell_begin = mesh.cell_begin.in<Memory>();
  }
  if (needs.upto >= Enumeration::edges && has(tables.edge_begin)) {
    view.edge_begin = tables.edge_begin.in<Memory>();
    if (needs.edge_low) view.edge_low = tables.edge_low.in<Memory>();
    view.edge_high = tables.edge_high.in<Memory>();
  }
  if (needs.upto >= Enumeration::triangles && has(tables.triangle_begin)) {
    view.triangle_begin = tables.triangle_begin.in<Memory>();
    if (needs.triangle_edge) view.triangle_edge = tables.triangle_edge.in<Memory>();
    view.triangle_apex = tables.triangle_apex.in<Memory>();
  }
  if (needs.lower_edges && has(tables.lower_begin)) {
    view.lower_begin = tables.lower_begin.in<Memory>();
    view.lower_edges = tables.lower_edges.in<Memory>();
    view.longest_list = tables.longest_list;
  }
  return view;
}

/// The tables from which others are made.
constexpr SimplexNeeds cells = {Enumeration::cells, false, true};
constexpr SimplexNeeds edges = {Enumeration::edges, false, true};
constexpr SimplexNeeds triangles = {Enumeration::triangles, false, false, false, false};

template <class Space>
Mirrored<Id> interval_begin_of(const Space& space, const MeshArrays& mesh, const SimplexTables& tables, int dimension) {
  using Memory = MemoryOf<Space>;
  const Borrowed<Id, Memory> vertex_begin = mesh.vertex_begin.in<Memory>(), edge_begin = tables.edge_begin.in<Memory>();
  Borrowed<Id, Memory> triangle_begin;
  if (dimension == 2) triangle_begin = tables.triangle_begin.in<Memory>();
  const auto begin = allocate<Array<Id, Memory>>("GALE::interval_begin", vertex_begin.extent(0));
  parallel_for(
      "GALE::interval_begin", space, begin.extent(0), KOKKOS_LAMBDA(Offset s) {
        const Id edge = edge_begin(vertex_begin(s));
        begin(s) = dimension == 1 ? edge : triangle_begin(edge);
      });
  space.fence();
  return begin;
}

}  // namespace

template <class Memory>
Simplices<Memory> SimplexStore::in(const SimplexNeeds& needs) {
  if (needs.upto == Enumeration::cells && !needs.cells && !is_device_memory<Memory>) {
    Simplices<Memory> none;
    none.dimension = dimension_;
    return none;
  }
  const auto lock = lock_or_stop(mutex_);
  enumerate(needs);
  return view_of<Memory>(mesh_(), tables_, needs);
}

template <class Memory>
const Array<const Id, Memory>& SimplexStore::interval_begin(int dimension) {
  const auto* const published = published_intervals_[dimension - 1].load(std::memory_order_acquire);
  if (published != nullptr) return published->in<Memory>();
  const auto lock = lock_or_stop(mutex_);
  SimplexNeeds needs;
  needs.upto = dimension == 1 ? Enumeration::edges : Enumeration::triangles;
  needs.triangle_edge = false;
  enumerate(needs);
  return intervals_[dimension - 1].in<Memory>();
}

Id SimplexStore::known(int dimension) const {
  const auto* const published = published_intervals_[dimension - 1].load(std::memory_order_acquire);
  if (published == nullptr) return no_id;
  const auto& begin = published->in<HostMemory>();
  return begin(begin.extent(0) - 1);
}

std::string SimplexStore::notice() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return notice_;
}

/// Other threads may use the tables on instances of their own as soon as they have them, so each step ends with a
/// fence.
void SimplexStore::enumerate(const SimplexNeeds& needs) {
  const TrackedViews tracked;  // the tables last, also where a sweep's body asks for them
  const bool edges_too = needs.upto >= Enumeration::edges && known(1) == no_id;
  const bool triangles_too = needs.upto >= Enumeration::triangles && known(2) == no_id;
  if (edges_too || triangles_too) {
    make(triangles_too ? "triangles" : "edges", mesh_().cells, [&](const auto& space) {
      using Memory = MemoryOf<std::decay_t<decltype(space)>>;
      const bool are_cells = mesh_().dimension == 2;  // the triangles
      const bool missing = !has(tables_.edge_begin) || (triangles_too && !has(tables_.triangle_begin));
      if constexpr (!is_device_memory<Memory>) {
        if (missing) {
          enumerate_by_segments(mesh_().in<HostMemory>(), mesh_().cell_begin.in<HostMemory>(),
                                triangles_too && !are_cells, tables_);
        }
      } else if (missing) {
        const auto stars = find_middle_stars(space, view_of<Memory>(mesh_(), tables_, cells));
        if (!has(tables_.edge_begin)) {
          enumerate_edges(space, view_of<Memory>(mesh_(), tables_, cells), stars, tables_);
        }
        publish_intervals(space, 1);
        if (triangles_too && !are_cells)
          enumerate_triangles(space, view_of<Memory>(mesh_(), tables_, edges), stars, tables_);
      }
      publish_intervals(space, 1);
      if (!triangles_too) return;
      if (are_cells) find_triangles_of_edges(space, view_of<Memory>(mesh_(), tables_, edges), tables_);
      publish_intervals(space, 2);
    });
  }
  const bool triangle_edge_too = needs.upto >= Enumeration::triangles && needs.triangle_edge &&
                                 tables_.triangle_edge.size() < tables_.triangle_apex.size();
  if (triangle_edge_too) {
    make("edges that its triangles lie over", tables_.triangle_apex, [&](const auto& space) {
      using Memory = MemoryOf<std::decay_t<decltype(space)>>;
      const auto all = view_of<Memory>(mesh_(), tables_, triangles);
      tables_.triangle_edge =
          row_of_entries(space, "GALE::triangle_edge", all.triangle_begin, all.triangle_apex.extent(0));
      space.fence();
    });
  }
  if (needs.lower_edges && !has(tables_.lower_begin)) {
    make("edges by their higher vertices", tables_.edge_high, [&](const auto& space) {
      using Memory = MemoryOf<std::decay_t<decltype(space)>>;
      sort_edges_by_higher(space, view_of<Memory>(mesh_(), tables_, edges), tables_);
      space.fence();
    });
  }
}

/// Calls make(space) where what it is made from is, and on the host if there is no memory for that.
template <class From, class Make>
void SimplexStore::make(const char* what, const From& from, const Make& make) {
  in_worker_or_host_space(from.on_device(), make, [&](const OutOfMemory& error) {
    if (!notice_.empty()) return;
    notice_ = std::string("the mesh's ") + (has(tables_.edge_begin) ? what : "edges") +
              " don't fit the device's memory (" + error.missing() + "): the host computes them";
  });
}

/// Makes them, unless they are there. On the host too, where consumers read them again and again.
template <class Space>
void SimplexStore::publish_intervals(const Space& space, int dimension) {
  auto& published = published_intervals_[dimension - 1];
  if (published != nullptr) return;
  auto& intervals = intervals_[dimension - 1];
  intervals = interval_begin_of(space, mesh_(), tables_, dimension);
  intervals.in<HostMemory>();
  published.store(&intervals, std::memory_order_release);
}

#define GALE_INSTANTIATE(Space)                                                               \
  template Simplices<MemoryOf<Space>> SimplexStore::in<MemoryOf<Space>>(const SimplexNeeds&); \
  template const Array<const Id, MemoryOf<Space>>& SimplexStore::interval_begin<MemoryOf<Space>>(int)
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale::detail
