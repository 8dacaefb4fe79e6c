#include <gale/runtime/defaults.hpp>
#include <gale/ttk/connectivity.hpp>

namespace gale::ttk {

namespace {

template <class Coordinate>
Segmentation octree(const CallersPoints& points, int capacity) {
  const Kokkos::View<const Coordinate* [3], Kokkos::LayoutRight, HostMemory, Kokkos::MemoryUnmanaged> view(
      static_cast<const Coordinate*>(points.coordinates), points.count);
  return octree_segmentation(Points<Coordinate, HostMemory>(view), capacity);
}

Segmentation octree(const CallersPoints& points, int capacity) {
  return points.in_double ? octree<double>(points, capacity) : octree<float>(points, capacity);
}

Options with_defaults(Options options) {
  if (options.structure.host_memory == 0) options.structure.host_memory = 128 * gale::detail::mebibyte;
  return options;
}

}  // namespace

Connectivity::Connectivity(const CallersPoints& points, const Cells& cells, const Options& options)
    : cells_(cells),
      options_(with_defaults(options)),
      segmentation_(octree(points, options.capacity)),
      finds_stars_in_cells_(!have_device && options.structure.way == Way::gale),
      counts_{points.count, no_id, cells.dimension() == 2 ? cells.count() : no_id, cells.count()},
      store_(std::make_unique<BlockStore>(segmentation_.segments(), options_.memory)) {
  if (finds_stars_in_cells_) {
    cells.require_valid(points.count);
    set_segments(Segments(segmentation_));
  } else {
    need_mesh();
  }
}

/// Encodes, if nobody needed that yet. If it throws, all is as it was.
void Connectivity::need_mesh() {
  if (mesh_) return;
  segments_ = Segments();  // what cells touch a segment is found again, sooner than both would fit
  try {
    if (dimension() == 2) {
      mesh_.emplace(Triangles<Id, HostMemory>(cells_.copy<3>(counts_[0])), segmentation_);
    } else {
      mesh_.emplace(Tetrahedra<Id, HostMemory>(cells_.copy<4>(counts_[0])), segmentation_);
    }
  } catch (...) {
    if (finds_stars_in_cells_) set_segments(Segments(segmentation_));
    throw;
  }
  set_segments(Segments(*mesh_));
}

void Connectivity::set_segments(const Segments& segments) {
  segments_ = segments;
  vertex_internal_ = segments_.vertex_internal();
  vertex_input_ = segments_.vertex_input();
  renew_readers();
}

Connectivity::~Connectivity() = default;

void Connectivity::need(int dimension) {
  CellOrder& order = dimension == 1 ? edges_ : triangles_;
  if (order.is_there() || dimension == this->dimension()) return;
  need_mesh();
  order = order_of(dimension, *mesh_, cells_);
  counts_[dimension] = order.count();
  simplices_ = mesh_->simplices(triangles_.is_there() ? tables_of_triangles : tables_of_edges);
  if (surface_waits_ && dimension == facet_dimension()) need_surface(0);
}

void Connectivity::need_rows(Relation relation) {
  if (dimension() == 2) {
    require_relations(in_mesh(relation), 2);
    if (relation == Relation::VF) relation = Relation::VT;
    if (relation == Relation::EF) relation = Relation::ET;
  }
  for (const int dimension : {row_dimension(relation), entry_dimension(relation)}) {
    if (dimension == 1 || dimension == 2) need(dimension);
  }
  store_->add(relation);
  wanted_rows_ = wanted_rows_ | relation;
  if (options_.memory == 0) store_->set_budget(default_memory());
  if (row_dimension(relation) == facet_dimension() && is_manifold()) return;  // facets have their stars
  if (finds_in_cells(relation)) return;
  need_mesh();
  Source& source = sources_[source_of(relation)];
  if (source.wanted.contains(in_mesh(relation))) return;
  source.wanted = relation == Relation::VV ? star_relations_of(dimension()) : source.wanted | in_mesh(relation);
  renew_readers();  // their consumers are of the old structure
  source.structure.reset();
}

std::size_t Connectivity::bytes() const {
  std::size_t bytes = store_->bytes() + segments_.bytes();
  bytes += edges_.bytes() + triangles_.bytes();
  for (const auto& flags : on_surface_) bytes += flags.span();
  return bytes;
}

}  // namespace gale::ttk
