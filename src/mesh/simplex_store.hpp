#pragma once

#include <atomic>
#include <mutex>

#include <gale/mesh/encoded_mesh.hpp>
#include <gale/mesh/simplices.hpp>

namespace gale::detail {

/// The tables of a mesh' simplices in the workers' memory and on the host, each made when someone needs it first. By
/// any thread.
class SimplexStore {
 public:
  /// `mesh`, and vertex -> the first tetrahedron whose lowest vertex it is.
  SimplexStore(const MeshArrays<WorkerMemory>& mesh, const Array<Id, WorkerMemory>& tetrahedron_begin)
      : mesh_(mesh), tetrahedron_begin_(tetrahedron_begin) {}

  Simplices<WorkerMemory> on_worker(const SimplexNeeds& needs);
  Simplices<HostMemory> on_host(const SimplexNeeds& needs);

  const Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory>& tetrahedra_on_host();

  /// Where the edges (1) or triangles (2) that are internal to each segment begin, and one past the last, on the host;
  /// what is missing for it is enumerated. No lock once it is there.
  const Array<const Id, HostMemory>& interval_begin(int dimension);

  /// How many edges or triangles there are; no_id as long as nobody needed them. No lock.
  Id known(int dimension) const;

 private:
  void enumerate(const SimplexNeeds& needs);
  Simplices<WorkerMemory> worker_view() const;
  Simplices<HostMemory> host_view() const;
  void publish_intervals(int dimension);

  mutable std::mutex mutex_;
  MeshArrays<WorkerMemory> mesh_;
  Array<Id, WorkerMemory> tetrahedron_begin_;
  SimplexTables<WorkerMemory> tables_;
  Array<const Id, HostMemory> intervals_[2];
  std::atomic<const Array<const Id, HostMemory>*> published_intervals_[2] = {};
  SimplexTables<HostMemory> host_tables_;
  Kokkos::View<Id* [4], Kokkos::LayoutRight, HostMemory> host_tetrahedra_;
  Array<Id, HostMemory> host_tetrahedron_begin_;
};

}  // namespace gale::detail
