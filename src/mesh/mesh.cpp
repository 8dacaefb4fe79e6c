#include <algorithm>
#include <mutex>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/encode.hpp>
#include <gale/mesh/mesh.hpp>
#include <gale/mesh/simplex_store.hpp>

namespace gale {

namespace {

using Ids = Array<Id, WorkerMemory>;
using HostIds = Array<const Id, HostMemory>;

/// An array that is copied to the host when someone asks for it first.
class Mirror {
 public:
  const HostIds& of(const Array<const Id, WorkerMemory>& array) {
    std::call_once(once_, [&] { host_ = on_host(array); });
    return host_;
  }

 private:
  std::once_flag once_;
  HostIds host_;
};

Ids inverse_of(const Ids& permutation) {
  const auto inverse = allocate<Ids>("GALE::vertex_internal", permutation.extent(0));
  parallel_for(
      "GALE::invert", WorkerSpace(), permutation.extent(0),
      KOKKOS_LAMBDA(Offset i) { inverse(permutation(i)) = static_cast<Id>(i); });
  return inverse;
}

/// I_T: where each segment's lowest vertex begins.
Ids internal_begin_of(const Ids& vertex_begin, const Ids& tetrahedra_of_lowest) {
  const auto begin = allocate<Ids>("GALE::internal_begin", vertex_begin.extent(0));
  parallel_for(
      "GALE::internal_begin", WorkerSpace(), vertex_begin.extent(0),
      KOKKOS_LAMBDA(Offset s) { begin(s) = tetrahedra_of_lowest(vertex_begin(s)); });
  return begin;
}

}  // namespace

struct Mesh::Data {
  MeshArrays<WorkerMemory> arrays;
  EncodedMesh<WorkerMemory> worker;
  Array<const Id, WorkerMemory> vertex_input, vertex_internal, tetrahedron_input;
  HostIds vertex_begin, internal_begin;
  Array<const Offset, HostMemory> external_begin;
  mutable detail::SimplexStore simplices;

  Data(const MeshArrays<WorkerMemory>& mesh, const Ids& tetrahedra_of_lowest)
      : arrays(mesh),
        worker(mesh.view()),
        vertex_begin(on_host(mesh.vertex_begin)),
        internal_begin(on_host(mesh.internal_begin)),
        external_begin(on_host(mesh.external_begin)),
        simplices(mesh, tetrahedra_of_lowest) {}

  mutable std::once_flag host_once;
  mutable MeshArrays<HostMemory> host_arrays;
  mutable EncodedMesh<HostMemory> host;
  mutable Mirror vertex_input_mirror, vertex_internal_mirror, tetrahedron_input_mirror;
};

template <class Index, class Memory>
Mesh::Mesh(const Tetrahedra<Index, Memory>& given, const Segmentation& segmentation) {
  const auto vertex_internal = inverse_of(segmentation.vertex_input);
  detail::SortedTetrahedra sorted;
  {
    const Tetrahedra<Index, WorkerMemory> input = on_worker(given);
    sorted = detail::sort_tetrahedra(input, vertex_internal);
  }
  MeshArrays<WorkerMemory> mesh;
  mesh.tetrahedra = sorted.vertices;
  mesh.vertex_begin = segmentation.vertex_begin;
  mesh.internal_begin = internal_begin_of(segmentation.vertex_begin, sorted.begin);
  detail::find_external_tetrahedra(mesh, segmentation.vertices());
  auto data = std::make_shared<Data>(mesh, sorted.begin);
  data->vertex_input = segmentation.vertex_input;
  data->vertex_internal = vertex_internal;
  data->tetrahedron_input = sorted.input;
  data_ = std::move(data);
}

Id Mesh::vertices() const { return static_cast<Id>(data_->vertex_input.extent(0)); }
Id Mesh::tetrahedra() const { return static_cast<Id>(data_->tetrahedron_input.extent(0)); }
Id Mesh::segments() const { return static_cast<Id>(data_->vertex_begin.extent(0)) - 1; }

const EncodedMesh<WorkerMemory>& Mesh::worker() const { return data_->worker; }

const EncodedMesh<HostMemory>& Mesh::host() const {
  std::call_once(data_->host_once, [this] {
    const auto& from = data_->arrays;
    auto& to = data_->host_arrays;
    to.vertex_begin = on_host(from.vertex_begin);
    to.internal_begin = on_host(from.internal_begin);
    to.external_begin = on_host(from.external_begin);
    to.external = on_host(from.external);
    to.tetrahedra = data_->simplices.tetrahedra_on_host();
    data_->host = to.view();
  });
  return data_->host;
}

const HostIds& Mesh::vertex_begin() const { return data_->vertex_begin; }
const HostIds& Mesh::vertex_input() const { return data_->vertex_input_mirror.of(data_->vertex_input); }
const HostIds& Mesh::vertex_internal() const { return data_->vertex_internal_mirror.of(data_->vertex_internal); }
const HostIds& Mesh::tetrahedron_input() const { return data_->tetrahedron_input_mirror.of(data_->tetrahedron_input); }
const Array<const Id, WorkerMemory>& Mesh::vertex_input_on_worker() const { return data_->vertex_input; }
const Array<const Id, WorkerMemory>& Mesh::tetrahedron_input_on_worker() const { return data_->tetrahedron_input; }

Simplices<WorkerMemory> Mesh::simplices_on_worker(const SimplexNeeds& needs) const {
  return data_->simplices.on_worker(needs);
}
Simplices<HostMemory> Mesh::simplices_on_host(const SimplexNeeds& needs) const {
  return data_->simplices.on_host(needs);
}
Id Mesh::known_edges() const { return data_->simplices.known(1); }
Id Mesh::known_triangles() const { return data_->simplices.known(2); }

const HostIds& Mesh::interval_begin(int dimension) const {
  if (dimension == 0) return data_->vertex_begin;
  if (dimension == 3) return data_->internal_begin;
  return data_->simplices.interval_begin(dimension);
}

Intervals Mesh::intervals_of(Id segment) const {
  Intervals intervals;
  for (int dimension = 0; dimension < 4; ++dimension) {
    const bool enumerated = dimension == 0 || dimension == 3 || data_->simplices.known(dimension) != no_id;
    if (!enumerated) continue;
    const auto& begin = interval_begin(dimension);
    intervals[dimension] = {begin(segment), begin(segment + 1)};
  }
  return intervals;
}

const Array<const Offset, HostMemory>& Mesh::external_begin() const { return data_->external_begin; }

Id Mesh::segment_of(int dimension, Id simplex) const {
  const Id* const begin = interval_begin(dimension).data();
  return static_cast<Id>(std::upper_bound(begin, begin + segments() + 1, simplex) - begin) - 1;
}

#define GALE_INSTANTIATE(Index, Memory) template Mesh::Mesh(const Tetrahedra<Index, Memory>&, const Segmentation&)
GALE_INSTANTIATE(std::int32_t, HostMemory);
GALE_INSTANTIATE(std::int64_t, HostMemory);
#if defined(KOKKOS_ENABLE_CUDA)
GALE_INSTANTIATE(std::int32_t, WorkerMemory);
GALE_INSTANTIATE(std::int64_t, WorkerMemory);
#endif
#undef GALE_INSTANTIATE

}  // namespace gale
