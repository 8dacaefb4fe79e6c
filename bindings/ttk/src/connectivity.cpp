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
      counts_{points.count, no_id, no_id, cells.count()},
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
    mesh_.emplace(Tetrahedra<Id, HostMemory>(cells_.copy(counts_[0])), segmentation_);
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

void Connectivity::need_edges() {
  if (edges_.is_there()) return;
  need_mesh();
  edges_ = order_of_edges(*mesh_, cells_);
  set_numbers(1);
}

void Connectivity::need_triangles() {
  if (triangles_.is_there()) return;
  need_mesh();
  triangles_ = order_of_triangles(*mesh_, cells_);
  set_numbers(2);
  if (surface_waits_) need_surface(0);
}

void Connectivity::set_numbers(int dimension) {
  counts_[dimension] = (dimension == 1 ? edges_ : triangles_).count();
  simplices_ = mesh_->simplices(triangles_.is_there() ? tables_of_triangles : tables_of_edges);
}

void Connectivity::need_rows(Relation relation) {
  for (const int dimension : {row_dimension(relation), entry_dimension(relation)}) {
    if (dimension == 1) need_edges();
    if (dimension == 2) need_triangles();
  }
  store_->add(relation);
  wanted_rows_ = wanted_rows_ | relation;
  if (options_.memory == 0) store_->set_budget(default_memory());
  if (relation == Relation::FT && is_manifold()) return;  // the triangles have their stars
  if (finds_in_cells(relation)) return;
  need_mesh();
  Source& source = sources_[source_of(relation)];
  if (source.wanted.contains(relation)) return;
  source.wanted = relation == Relation::VV ? star_relations : source.wanted | relation;
  renew_readers();  // their consumers are of the old structure
  source.structure.reset();
}

std::size_t Connectivity::bytes() const {
  std::size_t bytes = store_->bytes() + segments_.bytes();
  bytes += edges_.bytes() + triangles_.bytes() + triangles_.second.bytes();
  for (const auto& flags : on_surface_) bytes += flags.span();
  return bytes;
}

}  // namespace gale::ttk
