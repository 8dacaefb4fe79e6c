#include <algorithm>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/encode.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/mesh/numbering/simplex_store.hpp>

namespace gale {

namespace detail {

/// A mesh and its permutations.
struct PermutedMesh {
  MeshArrays arrays;
  Mirrored<Id> vertex_input, vertex_internal, cell_input;
  Id owned_segments;
};

/// The arrays of a mesh for code that runs on `Memory`, once someone has asked for them.
template <class Memory>
class EncodedOnce {
 public:
  const EncodedMesh<Memory>& of(const MeshArrays& arrays) {
    once_([&] { mesh_ = arrays.in<Memory>(); });
    return mesh_;
  }

 private:
  Once once_;
  EncodedMesh<Memory> mesh_;
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
  return {arrays, segmentation.vertex_input, vertex_internal, sorted.input,
          segmentation.is_part() ? segmentation.owned_segments : segmentation.segments()};
}

}  // namespace

struct Mesh::Data {
  template <int corners, class Index, class Memory>
  static std::shared_ptr<const Data> made_of(const CellCorners<corners, Index, Memory>& given,
                                             const Segmentation& segmentation,
                                             std::shared_ptr<const Exchange> exchange);

  const detail::PermutedMesh encoded;
  const std::string notice;
  const std::shared_ptr<const Exchange> exchange;  ///< of a part
  mutable detail::EncodedOnce<WorkerMemory> worker;
  mutable detail::EncodedOnce<HostMemory> host;
  mutable detail::SimplexStore simplices;
  mutable std::mutex kept_mutex;
  mutable std::map<std::string, std::shared_ptr<const void>> kept;

  /// What consumers read again and again is copied to the host now.
  Data(const detail::PermutedMesh& mesh, const std::string& what_did_not_fit, std::shared_ptr<const Exchange> others)
      : encoded(mesh), notice(what_did_not_fit), exchange(std::move(others)), simplices(mesh.arrays) {
    encoded.arrays.vertex_begin.in<HostMemory>();
    encoded.arrays.internal_begin.in<HostMemory>();
    encoded.arrays.external_begin.in<HostMemory>();
  }
};

template <int corners, class Index, class Memory>
std::shared_ptr<const Mesh::Data> Mesh::Data::made_of(const CellCorners<corners, Index, Memory>& given,
                                                      const Segmentation& segmentation,
                                                      std::shared_ptr<const Exchange> exchange) {
  if (given.extent(0) == 0 && !segmentation.is_part())
    throw Error(corners == 4 ? "the mesh has no tetrahedra" : "the mesh has no triangles");
  std::string notice;
  const auto encoded = in_worker_or_host_space(
      true, [&](const auto& space) { return encode<corners, Index>(space, given, segmentation); },
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

int Mesh::dimension() const { return data_->encoded.arrays.dimension; }

Id Mesh::vertices() const { return static_cast<Id>(data_->encoded.vertex_input.size()); }
Id Mesh::cells() const { return static_cast<Id>(data_->encoded.cell_input.size()); }
Id Mesh::segments() const { return static_cast<Id>(data_->encoded.arrays.vertex_begin.size()) - 1; }
Id Mesh::owned_segments() const { return data_->encoded.owned_segments; }
Id Mesh::owned_vertices() const { return vertex_begin()(owned_segments()); }

bool Mesh::is_part() const { return data_->exchange != nullptr; }
const Exchange& Mesh::exchange() const { return is_part() ? *data_->exchange : Exchange::of_whole_mesh(); }
Id Mesh::vertex_of(GlobalId id) const {
  if (is_part()) return exchange().vertex_of(id);
  return id >= 0 && id < vertices() ? static_cast<Id>(id) : no_id;
}
GlobalId Mesh::all_vertices() const { return is_part() ? exchange().vertices() : vertices(); }
GlobalId Mesh::all_cells() const { return is_part() ? exchange().cells() : cells(); }

bool Mesh::on_device() const { return data_->encoded.arrays.cells.on_device(); }

std::string Mesh::notice() const { return data_->notice.empty() ? data_->simplices.notice() : data_->notice; }

template <class Memory>
const EncodedMesh<Memory>& Mesh::encoded() const {
  if constexpr (is_device_memory<Memory>) {
    return data_->worker.of(data_->encoded.arrays);
  } else {
    return data_->host.of(data_->encoded.arrays);
  }
}

const Array<const Id, HostMemory>& Mesh::vertex_begin() const { return interval_begin(0); }

const Array<const Offset, HostMemory>& Mesh::external_begin() const {
  return data_->encoded.arrays.external_begin.in<HostMemory>();
}

template <class Memory>
const Array<const Id, Memory>& Mesh::vertex_input() const {
  return data_->encoded.vertex_input.in<Memory>();
}
template <class Memory>
const Array<const Id, Memory>& Mesh::vertex_internal() const {
  return data_->encoded.vertex_internal.in<Memory>();
}
template <class Memory>
const Array<const Id, Memory>& Mesh::cell_input() const {
  return data_->encoded.cell_input.in<Memory>();
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
  if (dimension == 0) return data_->encoded.arrays.vertex_begin.in<Memory>();
  if (dimension == most) return data_->encoded.arrays.internal_begin.in<Memory>();
  if (dimension > most) throw Error("a mesh of triangles has no simplices of dimension " + std::to_string(dimension));
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
  template GALE_EXPORT Simplices<MemoryOf<Space>> Mesh::simplices<MemoryOf<Space>>(const SimplexNeeds&) const; \
  template GALE_EXPORT const Array<const Id, MemoryOf<Space>>& Mesh::interval_begin<MemoryOf<Space>>(int) const
GALE_IN_EACH_SPACE(GALE_INSTANTIATE);
#undef GALE_INSTANTIATE

}  // namespace gale
