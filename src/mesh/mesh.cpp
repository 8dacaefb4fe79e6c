#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <gale/base/error.hpp>
#include <gale/base/momentary.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/encode.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/mesh/numbering/simplex_store.hpp>

namespace gale {

namespace detail {

/// GALE's ids and the input's.
struct Permutations {
  Mirrored<Id> vertex_input, vertex_internal, cell_input;
};

/// A mesh and its permutations.
struct PermutedMesh {
  MeshArrays arrays;
  Permutations permutations;
  Interval owned_segments;
};

}  // namespace detail

namespace {

template <class Space>
using IdsIn = Array<Id, MemoryOf<Space>>;

template <class Space>
IdsIn<Space> inverse_of(const Space& space, const Array<const Id, MemoryOf<Space>>& permutation) {
  const auto inverse = allocate<IdsIn<Space>>("GALE::vertex_internal", permutation.extent(0));
  parallel_for(
      "GALE::invert", space, permutation.extent(0),
      KOKKOS_LAMBDA(Offset i) { inverse(permutation(i)) = static_cast<Id>(i); });
  return inverse;
}

/// I_T: where each segment's lowest vertex begins.
template <class Space>
IdsIn<Space> internal_begin_of(const Space& space, const Array<const Id, MemoryOf<Space>>& vertex_begin,
                               const IdsIn<Space>& cells_of_lowest) {
  const auto begin = allocate<IdsIn<Space>>("GALE::internal_begin", vertex_begin.extent(0));
  parallel_for(
      "GALE::internal_begin", space, vertex_begin.extent(0),
      KOKKOS_LAMBDA(Offset s) { begin(s) = cells_of_lowest(vertex_begin(s)); });
  return begin;
}

/// Ends with a fence: others use the arrays on instances of their own.
template <int corners, class Index, class Space, class Memory>
detail::PermutedMesh encode(const Space& space, const CellCorners<corners, Index, Memory>& given,
                            const Segmentation& segmentation) {
  using Here = MemoryOf<Space>;
  const auto vertex_internal = inverse_of(space, segmentation.vertex_input.in<Here>());
  const auto vertex_begin = segmentation.vertex_begin.in<Here>();
  detail::SortedCells<Here> sorted;
  Csr<Id, Here> external;
  if constexpr (is_device<Space>) {
    {
      const CellCorners<corners, Index, Here> input = in_memory<Here>(given);
      sorted = detail::sort_cells_by_vertices<corners, Space, Index>(space, input, vertex_internal);
    }
    external = detail::find_external_cells<Space>(space, sorted.of_lowest, vertex_begin);
  } else {
    const auto encoded =
        detail::encode_by_groups<corners, Index>(in_memory<Here>(given), vertex_internal, vertex_begin);
    sorted = encoded.sorted;
    external = encoded.external;
  }
  detail::MeshArrays arrays;
  arrays.dimension = corners - 1;
  arrays.cells = sorted.of_lowest.entries;
  arrays.cell_begin = sorted.of_lowest.offsets;
  arrays.vertex_begin = segmentation.vertex_begin;
  arrays.internal_begin = internal_begin_of<Space>(space, vertex_begin, sorted.of_lowest.offsets);
  arrays.external_begin = external.offsets;
  arrays.external = external.entries;
  space.fence();
  return {arrays,
          {segmentation.vertex_input, vertex_internal, sorted.input},
          {0, segmentation.is_part() ? segmentation.owned_segments : segmentation.segments()}};
}

Id segments_of(Id vertices, int capacity) { return vertices / capacity + (vertices % capacity > 0); }

/// How a grid is cut into segments of `capacity` consecutive vertices: those before the owned ones, these, and others.
struct GridDivision {
  detail::MeshArrays arrays;
  Interval owned_segments, owned_vertices;
};

/// Where segments begin, and their internal cells.
template <class Space>
GridDivision divide(const Space& space, const Grid& grid, int capacity, const Interval& owned) {
  const GridView view = grid.in<MemoryOf<Space>>();
  const Id vertices = grid.vertices(), cells = grid.cells();
  const Id lower = segments_of(owned.first, capacity), upper = lower + segments_of(owned.size(), capacity);
  const Id segments = upper + segments_of(vertices - owned.last, capacity);
  const auto vertex_begin = allocate<IdsIn<Space>>("GALE::vertex_begin", segments + 1),
             internal_begin = allocate<IdsIn<Space>>("GALE::internal_begin", segments + 1);
  parallel_for(
      "GALE::divide_grid", space, segments + 1, KOKKOS_LAMBDA(Offset s) {
        const Id first = s == segments ? vertices
                         : s < lower   ? static_cast<Id>(s * capacity)
                         : s < upper   ? static_cast<Id>(owned.first + (s - lower) * capacity)
                                       : static_cast<Id>(owned.last + (s - upper) * capacity);
        vertex_begin(s) = first;
        internal_begin(s) = s < segments ? view.first_cell(first) : cells;
      });
  space.fence();
  detail::MeshArrays arrays;
  arrays.dimension = grid.dimension();
  arrays.vertex_begin = vertex_begin;
  arrays.internal_begin = internal_begin;
  return {arrays, {lower, upper}, owned};
}

/// Writes what a grid computes, for those who want arrays. `divided` says where segments begin.
template <class Space>
detail::MeshArrays write_out(const Space& space, const Grid& grid, const detail::MeshArrays& divided) {
  using Here = MemoryOf<Space>;
  const GridView view = grid.in<Here>();
  const Id vertices = grid.vertices(), cells = grid.cells();
  const auto quads = allocate<Array<Quad, Here>>("GALE::grid_cells", cells);
  parallel_for(
      "GALE::grid_cells", space, grid.cubes(), KOKKOS_LAMBDA(Offset cube) {
        const Quad corners = view.corners_of_cube(static_cast<Id>(cube));
        const int of_cube = view.cells_per_cube();
        for (int i = 0; i < of_cube; ++i) quads(cube * of_cube + i) = view.cell_of_cube(corners, i);
      });
  const auto begin = allocate<IdsIn<Space>>("GALE::cell_begin", vertices + 1);
  parallel_for(
      "GALE::cell_begin", space, vertices + 1,
      KOKKOS_LAMBDA(Offset v) { begin(v) = v < vertices ? view.first_cell(static_cast<Id>(v)) : cells; });
  const Csr<Id, Here> external =
      detail::find_external_cells<Space>(space, {begin, quads}, divided.vertex_begin.in<Here>());
  detail::MeshArrays arrays = divided;
  arrays.cells = quads;
  arrays.cell_begin = begin;
  arrays.external_begin = external.offsets;
  arrays.external = external.entries;
  space.fence();
  return arrays;
}

}  // namespace

class Mesh::Data {
 public:
  template <int corners, class Index, class Memory>
  static std::shared_ptr<const Data> made_of(const CellCorners<corners, Index, Memory>& given,
                                             const Segmentation& segmentation,
                                             std::shared_ptr<const Exchange> exchange);

  Data(const detail::PermutedMesh& mesh, std::string what_did_not_fit, std::shared_ptr<const Exchange> others)
      : notice(std::move(what_did_not_fit)),
        exchange(std::move(others)),
        vertices(static_cast<Id>(mesh.permutations.vertex_input.size())),
        cells(static_cast<Id>(mesh.permutations.cell_input.size())),
        owned_segments(mesh.owned_segments),
        owned_vertices(vertices_in(mesh.arrays, owned_segments)),
        simplices(mesh.arrays.dimension, [this]() -> const detail::MeshArrays& { return arrays(); }),
        divided_(mesh.arrays),
        permutations_(mesh.permutations) {
    // What consumers read again and again is copied to the host now, as vertex_begin was.
    divided_.external_begin.in<HostMemory>();
    divided_.internal_begin.in<HostMemory>();
  }

  Data(const Grid& given, const GridDivision& division, std::shared_ptr<const Exchange> others)
      : exchange(std::move(others)),
        grid(given),
        vertices(given.vertices()),
        cells(given.cells()),
        owned_segments(division.owned_segments),
        owned_vertices(division.owned_vertices),
        simplices(given.dimension(), [this]() -> const detail::MeshArrays& { return arrays(); }),
        divided_(division.arrays) {}

  /// The arrays that a grid has, too: the division into segments.
  const detail::MeshArrays& divided() const { return divided_; }

  const detail::MeshArrays& arrays() const {
    if (!grid) return divided_;
    return written_.get([this] {
      return in_worker_or_host_space(on_device(),
                                     [this](const auto& space) { return write_out(space, *grid, divided_); });
    });
  }

  const detail::Permutations& permutations() const {
    if (!grid) return permutations_;
    return of_grid_.get([this] {
      return in_worker_or_host_space(on_device(), [this](const auto& space) {
        const Mirrored<Id> of_vertices = iota("GALE::grid_vertices", space, vertices),
                           of_cells = iota("GALE::grid_cell_ids", space, cells);
        space.fence();
        return detail::Permutations{of_vertices, of_vertices, of_cells};
      });
    });
  }

  template <class Memory>
  const EncodedMesh<Memory>& encoded() const {
    const auto make = [this] { return arrays().in<Memory>(); };
    if constexpr (is_device_memory<Memory>) {
      return worker_.get(make);
    } else {
      return host_.get(make);
    }
  }

  bool on_device() const { return divided_.internal_begin.on_device(); }

  const std::string notice;
  const std::shared_ptr<const Exchange> exchange;  ///< of a part
  const std::optional<Grid> grid;
  const Id vertices, cells;
  const Interval owned_segments, owned_vertices;
  mutable detail::SimplexStore simplices;
  mutable std::mutex kept_mutex;
  mutable std::map<std::string, std::shared_ptr<const void>> kept;

 private:
  static Interval vertices_in(const detail::MeshArrays& arrays, const Interval& segments) {
    const auto& begin = arrays.vertex_begin.in<HostMemory>();
    return {begin(segments.first), begin(segments.last)};
  }

  const detail::MeshArrays divided_;  ///< of cells that are no grid: all arrays
  const detail::Permutations permutations_;
  detail::OnceMade<detail::MeshArrays> written_;
  detail::OnceMade<detail::Permutations> of_grid_;
  detail::OnceMade<EncodedMesh<WorkerMemory>> worker_;
  detail::OnceMade<EncodedMesh<HostMemory>> host_;
};

template <int corners, class Index, class Memory>
std::shared_ptr<const Mesh::Data> Mesh::Data::made_of(const CellCorners<corners, Index, Memory>& given,
                                                      const Segmentation& segmentation,
                                                      std::shared_ptr<const Exchange> exchange) {
  if (given.extent(0) == 0 && !segmentation.is_part())
    throw Error(corners == 4 ? "the mesh has no tetrahedra" : "the mesh has no triangles");
  std::string notice;
  const auto encoded = in_worker_or_host_space(
      given.extent(0) > 0, [&](const auto& space) { return encode<corners, Index>(space, given, segmentation); },
      [&](const OutOfMemory& error) {
        notice = "the mesh doesn't fit the device's memory (" + error.missing() + "): the host computes";
      });
  return std::make_shared<Data>(encoded, notice, std::move(exchange));
}

template <class Index, class Memory>
Mesh::Mesh(const Tetrahedra<Index, Memory>& tetrahedra, const Segmentation& segmentation,
           std::shared_ptr<const Exchange> exchange)
    : data_(Data::made_of<4, Index>(tetrahedra, segmentation, std::move(exchange))) {}

template <class Index, class Memory>
Mesh::Mesh(const Triangles<Index, Memory>& triangles, const Segmentation& segmentation,
           std::shared_ptr<const Exchange> exchange)
    : data_(Data::made_of<3, Index>(triangles, segmentation, std::move(exchange))) {}

Mesh::Mesh(const Grid& grid, int capacity) : Mesh(grid, capacity, {0, grid.vertices()}, nullptr) {}

Mesh::Mesh(const Grid& grid, int capacity, const Interval& owned, std::shared_ptr<const Exchange> exchange) {
  if (capacity < 1) throw Error("segments of at most " + std::to_string(capacity) + " vertices hold none");
  if (grid.cells() == 0 && exchange == nullptr)
    throw Error(grid.dimension() == 3 ? "the mesh has no tetrahedra" : "the mesh has no triangles");
  const auto divided =
      in_worker_or_host_space(true, [&](const auto& space) { return divide(space, grid, capacity, owned); });
  data_ = std::make_shared<Data>(grid, divided, std::move(exchange));
}

const Grid* Mesh::grid() const { return data_->grid ? &*data_->grid : nullptr; }

int Mesh::dimension() const { return data_->divided().dimension; }

Id Mesh::vertices() const { return data_->vertices; }
Id Mesh::cells() const { return data_->cells; }
Id Mesh::segments() const { return static_cast<Id>(data_->divided().vertex_begin.size()) - 1; }
Interval Mesh::owned_segments() const { return data_->owned_segments; }
Interval Mesh::owned_vertices() const { return data_->owned_vertices; }

bool Mesh::is_part() const { return data_->exchange != nullptr; }
const Exchange& Mesh::exchange() const { return is_part() ? *data_->exchange : Exchange::of_whole_mesh(); }
Id Mesh::vertex_of(GlobalId id) const {
  if (is_part()) return exchange().vertex_of(id);
  return id >= 0 && id < vertices() ? static_cast<Id>(id) : no_id;
}
GlobalId Mesh::all_vertices() const { return is_part() ? exchange().vertices() : vertices(); }
GlobalId Mesh::all_cells() const { return is_part() ? exchange().cells() : cells(); }

bool Mesh::on_device() const { return data_->on_device(); }

std::string Mesh::notice() const { return data_->notice.empty() ? data_->simplices.notice() : data_->notice; }

template <class Memory>
const EncodedMesh<Memory>& Mesh::encoded() const {
  return data_->encoded<Memory>();
}

const Array<const Id, HostMemory>& Mesh::vertex_begin() const { return interval_begin(0); }

const Array<const Offset, HostMemory>& Mesh::external_begin() const {
  return data_->arrays().external_begin.in<HostMemory>();
}

template <class Memory>
const Array<const Id, Memory>& Mesh::vertex_input() const {
  return data_->permutations().vertex_input.in<Memory>();
}
template <class Memory>
const Array<const Id, Memory>& Mesh::vertex_internal() const {
  return data_->permutations().vertex_internal.in<Memory>();
}
template <class Memory>
const Array<const Id, Memory>& Mesh::cell_input() const {
  return data_->permutations().cell_input.in<Memory>();
}

template <class Memory>
OtherIds Mesh::vertices_in_input() const {
  return {grid() != nullptr ? nullptr : vertex_input<Memory>().data()};
}
template <class Memory>
OtherIds Mesh::vertices_of_input() const {
  return {grid() != nullptr ? nullptr : vertex_internal<Memory>().data()};
}
template <class Memory>
OtherIds Mesh::cells_in_input() const {
  return {grid() != nullptr ? nullptr : cell_input<Memory>().data()};
}

std::vector<Id> Mesh::input_of_vertices(const std::vector<Id>& vertices) const {
  return grid() != nullptr ? vertices : detail::entries_at(data_->permutations().vertex_input, vertices);
}
std::vector<Id> Mesh::input_of_cells(const std::vector<Id>& cells) const {
  return grid() != nullptr ? cells : detail::entries_at(data_->permutations().cell_input, cells);
}

template <class Memory>
CellReader Mesh::cell_reader() const {
  if (grid() != nullptr) return {nullptr, grid()->in<Memory>()};
  return {encoded<Memory>().cells.data(), {}};
}

template <class Memory>
Simplices<Memory> Mesh::simplices(const SimplexNeeds& needs) const {
  return data_->simplices.in<Memory>(needs);
}
Id Mesh::known_edges() const { return data_->simplices.known(1); }
Id Mesh::known_triangles() const { return dimension() == 2 ? cells() : data_->simplices.known(2); }

template <class Memory>
const Array<const Id, Memory>& Mesh::interval_begin(int dimension) const {
  const int most = this->dimension();
  if (dimension == 0) return data_->divided().vertex_begin.in<Memory>();
  if (dimension == most) return data_->divided().internal_begin.in<Memory>();
  if (dimension > most)
    throw Error(std::string("a mesh of ") + (most == 2 ? "triangles" : "tetrahedra") +
                " has no simplices of dimension " + std::to_string(dimension));
  return data_->simplices.interval_begin<Memory>(dimension);
}

Intervals Mesh::intervals_of(Id segment) const {
  Intervals intervals;
  const int most = this->dimension();
  for (int dimension = 0; dimension <= most; ++dimension) {
    const bool enumerated = dimension == 0 || dimension == most || data_->simplices.known(dimension) != no_id;
    if (!enumerated) continue;
    const auto& begin = interval_begin(dimension);
    intervals[dimension] = {begin(segment), begin(segment + 1)};
  }
  return intervals;
}

Id Mesh::segment_of(int dimension, Id simplex) const {
  const Id* const begin = interval_begin(dimension).data();
  return static_cast<Id>(std::upper_bound(begin, begin + segments() + 1, simplex) - begin) - 1;
}

std::shared_ptr<const void> Mesh::kept(const std::string& key,
                                       const std::function<std::shared_ptr<const void>()>& make) const {
  const auto lock = detail::lock_or_stop(data_->kept_mutex);
  std::shared_ptr<const void>& what = data_->kept[key];
  if (!what) what = make();
  return what;
}

#define GALE_INSTANTIATE(Index, Memory)                                                  \
  template GALE_EXPORT Mesh::Mesh(const Tetrahedra<Index, Memory>&, const Segmentation&, \
                                  std::shared_ptr<const Exchange>);                      \
  template GALE_EXPORT Mesh::Mesh(const Triangles<Index, Memory>&, const Segmentation&, std::shared_ptr<const Exchange>)
GALE_INSTANTIATE(std::int32_t, HostMemory);
GALE_INSTANTIATE(std::int64_t, HostMemory);
#if defined(GALE_HAS_DEVICE)
GALE_INSTANTIATE(std::int32_t, WorkerMemory);
GALE_INSTANTIATE(std::int64_t, WorkerMemory);
#endif
#undef GALE_INSTANTIATE

#define GALE_INSTANTIATE(Space)                                                                                \
  template GALE_EXPORT const EncodedMesh<MemoryOf<Space>>& Mesh::encoded<MemoryOf<Space>>() const;             \
  template GALE_EXPORT const Array<const Id, MemoryOf<Space>>& Mesh::vertex_input<MemoryOf<Space>>() const;    \
  template GALE_EXPORT const Array<const Id, MemoryOf<Space>>& Mesh::vertex_internal<MemoryOf<Space>>() const; \
  template GALE_EXPORT const Array<const Id, MemoryOf<Space>>& Mesh::cell_input<MemoryOf<Space>>() const;      \
  template GALE_EXPORT OtherIds Mesh::vertices_in_input<MemoryOf<Space>>() const;                              \
  template GALE_EXPORT OtherIds Mesh::vertices_of_input<MemoryOf<Space>>() const;                              \
  template GALE_EXPORT OtherIds Mesh::cells_in_input<MemoryOf<Space>>() const;                                 \
  template GALE_EXPORT CellReader Mesh::cell_reader<MemoryOf<Space>>() const;                                  \
  template GALE_EXPORT Simplices<MemoryOf<Space>> Mesh::simplices<MemoryOf<Space>>(const SimplexNeeds&) const; \
  template GALE_EXPORT const Array<const Id, MemoryOf<Space>>& Mesh::interval_begin<MemoryOf<Space>>(int) const
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale
