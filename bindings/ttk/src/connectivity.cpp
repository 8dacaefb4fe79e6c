#include <algorithm>

#include <gale/algorithms/surface_vertices.hpp>
#include <gale/base/atomic.hpp>
#include <gale/base/parallel.hpp>
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

Mesh encode(const CallersPoints& points, const Cells& cells, int capacity) {
  return Mesh(Tetrahedra<Id, HostMemory>(cells.corners()),
              points.in_double ? octree<double>(points, capacity) : octree<float>(points, capacity));
}

/// What VV and VT of a regular mesh take: of all rows that is a fifth, and more made nothing faster.
constexpr std::size_t bytes_of_vertex = 192;

Options with_defaults(Options options, Id vertices) {
  if (options.memory == 0) options.memory = std::max(bytes_of_vertex * vertices, 16 * gale::detail::mebibyte);
  if (options.structure.host_memory == 0) options.structure.host_memory = 512 * gale::detail::mebibyte;
  return options;
}

}  // namespace

Connectivity::Connectivity(const CallersPoints& points, const Cells& cells, const Options& options)
    : cells_(cells),
      options_(with_defaults(options, points.count)),
      mesh_(encode(points, cells, options.capacity)),
      counts_{mesh_.vertices(), no_id, no_id, mesh_.tetrahedra()},
      vertex_input_(mesh_.vertex_input().data()),
      store_(std::make_unique<BlockStore>(mesh_.segments(), options_.memory)),
      readers_(std::make_unique<PerThread<Reader>>()) {
  internal_[0] = mesh_.vertex_internal().data();
  segment_of_vertex_ = allocate<Array<Id, HostMemory>>("GALE::ttk_segments", mesh_.vertices());
  const auto& begin = mesh_.vertex_begin();
  parallel_for("GALE::ttk_segments", HostSpace(), mesh_.segments(), [&](Offset segment) {
    for (Id v = begin(segment); v < begin(segment + 1); ++v) segment_of_vertex_(v) = static_cast<Id>(segment);
  });
}

Connectivity::~Connectivity() = default;

void Connectivity::need_edges() {
  if (internal_[1] != nullptr) return;
  edges_ = order_of_edges(mesh_, cells_);
  set_numbers(1, edges_);
}

void Connectivity::need_triangles() {
  if (internal_[2] != nullptr) return;
  triangles_ = order_of_triangles(mesh_, cells_, tetrahedra_of_);
  set_numbers(2, triangles_);
}

void Connectivity::set_numbers(int dimension, const CellOrder& order) {
  counts_[dimension] = static_cast<Id>(order.number.extent(0));
  internal_[dimension] = order.internal.data();
  const bool triangles = internal_[2] != nullptr;
  simplices_ = mesh_.simplices({triangles ? Enumeration::triangles : Enumeration::edges, false, true});
}

void Connectivity::need_rows(Relation relation) {
  for (const int dimension : {row_dimension(relation), entry_dimension(relation)}) {
    if (dimension == 1) need_edges();
    if (dimension == 2) need_triangles();
  }
  const RelationSet more = relation == Relation::VV ? star_relations : RelationSet(relation);
  store_->add(relation);
  wanted_rows_ = wanted_rows_ | relation;
  if (wanted_.contains(more)) return;
  wanted_ = wanted_ | more;
  readers_ = std::make_unique<PerThread<Reader>>();  // their consumers are of the old structure
  structure_.reset();
}

void Connectivity::need_surface(int dimension) {
  auto& on_surface = on_surface_[dimension];
  if (on_surface.data() != nullptr) return;
  if (dimension == 1) return find_surface_of_edges();
  const HostSpace host;
  if (dimension == 2) {
    need_triangles();
    on_surface = allocate<Array<std::uint8_t, HostMemory>>("GALE::ttk_surface", counts_[2]);
    parallel_for("GALE::ttk_surface", host, counts_[2],
                 [&](Offset i) { on_surface(i) = static_cast<std::uint8_t>(tetrahedra_of_(i) == 1); });
    return;
  }
  on_surface = allocate<Array<std::uint8_t, HostMemory>>("GALE::ttk_surface", counts_[0]);
  if (wanted_rows_.has(Relation::VV)) return sweep_stars(on_surface);
  const auto vertices = surface_vertices(mesh_);
  parallel_for("GALE::ttk_surface", host, counts_[0], [&](Offset i) { on_surface(vertex_input_[i]) = vertices(i); });
}

void Connectivity::find_surface_of_edges() {
  need_edges();
  need_surface(2);
  const HostSpace host;
  const auto on_surface = allocate<Array<std::uint8_t, HostMemory>>("GALE::ttk_surface", counts_[1]);
  parallel_for("GALE::ttk_clear_surface", host, counts_[1], [&](Offset i) { on_surface(i) = 0; });
  parallel_for("GALE::ttk_surface", host, counts_[2], [&](Offset i) {
    if (on_surface_[2](i) == 0) return;
    for (const Id edge : face_row<Relation::FE>(simplices_, triangles_.internal(i))) {
      atomic_write(&on_surface(edges_.number(edge)), std::uint8_t(1));
    }
  });
  on_surface_[1] = on_surface;
}

bool Connectivity::is_manifold() const {
  return reduce_sum("GALE::ttk_crowded_triangles", HostSpace(), counts_[2],
                    [&](Offset i) { return tetrahedra_of_(i) > 2 ? 1 : 0; }) == 0;
}

std::size_t Connectivity::bytes() const {
  std::size_t bytes = store_->bytes() + tetrahedra_of_.span() + segment_of_vertex_.span() * sizeof(Id);
  for (const CellOrder* order : {&edges_, &triangles_}) {
    bytes += (order->number.span() + order->internal.span()) * sizeof(Id);
  }
  for (const auto& flags : on_surface_) bytes += flags.span();
  return bytes;
}

}  // namespace gale::ttk
