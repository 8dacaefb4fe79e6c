#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/team.hpp>
#include <gale/runtime/device/batch_sweep.hpp>
#include <gale/runtime/make_structure.hpp>
#include <gale/runtime/sweep_options.hpp>

// Sweeps whose consumers are kernels: they read rows where these are made, and nothing is copied.
//
// `space` says where a functor runs, and on how many threads:
// - an execution space of Kokkos' that can read the mesh's arrays, the workers' (a device, where Kokkos has one) or one
//   of the host. The functor runs in a kernel of that space, and all that Kokkos promises of these holds: its atomics,
//   ScatterView, UniqueToken. Kokkos::Serial is one thread.
// - HostThreads: all threads that GALE may use on the host. What they share is for gale::atomic_add and its like
//   (base/atomic.hpp), which are right in every space; Kokkos' atomics may not be. Views that a functor copies
//   meanwhile own nothing.
//
// A sweep begins when what was enqueued on `space` before is done, and all it does is done when the call returns: what
// a functor wrote can be read anywhere. On a device it works on instances of its own. Functors run side by side. To be
// called from one thread at a time. Ids are GALE's; `mesh.vertex_input<Memory>()` leads back to those of the input.
//
// Throws gale::Error for an option below 0, for a relation with more than 2^31 - 1 entries in one segment, and as
// Mesh::simplices does; OutOfMemory if the device has no room for the mesh, or for the blocks of one segment.

namespace gale {

namespace detail {

template <class Space>
using MemoryOfSweep = std::conditional_t<is_device<Space>, WorkerMemory, HostMemory>;

/// A team a segment: calls functor(team, rows) for those that are there.
template <class Memory, class Functor>
struct OnEachSegment {
  SegmentBatches<Memory> blocks;
  Functor functor;

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    if (blocks.has(team.league_rank())) functor(team, SegmentRowsIn<Memory>(blocks, team.league_rank()));
  }
};

/// A warp a segment, a lane a row: teams of several segments, so that a device starts few.
template <class Memory, class Functor>
struct OnEachRow {
  Batch<Memory> blocks;
  Relation relation;
  Functor functor;

  template <class Team>
  KOKKOS_FUNCTION void operator()(const Team& team) const {
    const Id slot = team.league_rank() * team.team_size() + team.team_rank();
    if (slot >= blocks.count || !blocks.has(slot)) return;
    const Rows rows = blocks.rows(slot, relation);
    team::for_lanes(team, rows.count, [&](int i) { functor(rows.first + i, rows[rows.first + i]); });
  }
};

/// A team a segment, a thread a row: for large segments, and on the host.
template <class Functor>
struct OnRowsOfSegment {
  Relation relation;
  Functor functor;

  template <class Team, class Segment>
  KOKKOS_FUNCTION void operator()(const Team& team, const Segment& segment) const {
    const Rows rows = segment[relation];
    team::for_all(team, rows.count, [&](int i) { functor(rows.first + i, rows[rows.first + i]); });
  }
};

inline double mean_vertices(const Mesh& mesh) {
  return static_cast<double>(mesh.vertices()) / std::max(mesh.segments(), Id(1));
}

/// Warps for a team that reads about so many rows.
inline int warps_of_team(const DeviceSweepOptions& options, double rows) {
  constexpr int lanes = lanes_per_warp, most = 256 / lanes;
  if (options.threads_per_team > 0) return (options.threads_per_team + lanes - 1) / lanes;
  return std::clamp(static_cast<int>((rows + lanes - 1) / lanes), 1, most);
}

/// Calls kernel(instance) for a batch: on a device with the instance that makes it, behind that; on the host with the
/// caller's, and waits.
template <class Space, class Launched, class Kernel>
void read_batch(const Space& space, const Launched& launched, const Kernel& kernel) {
  if constexpr (is_device<Space>) {
    kernel(launched.instance);
  } else {
    launched.instance.fence();
    kernel(space);
    space.fence();
  }
}

/// for_each_segment on all host threads: each makes the rows that it reads.
template <class Functor>
void for_each_segment_on_threads(const Mesh& mesh, RelationSet relations, const Functor& functor,
                                 const DeviceSweepOptions& options) {
  require_sweep(relations, options);
  SweepOptions threads;
  std::vector<std::vector<std::max_align_t>> scratch(threads.threads);
  for (auto& one : scratch) one.resize(options.team_scratch / sizeof(std::max_align_t) + 1);
  StructureOptions inline_way;
  inline_way.way = Way::inline_;
  make_structure(mesh, relations, inline_way)
      ->for_each_segment(relations, threads, [&](int thread, const SegmentRows& rows) {
        functor(HostTeam(rows.segment(), reinterpret_cast<char*>(scratch[thread].data())), rows);
      });
}

}  // namespace detail

/// Calls functor(team, rows) for each segment of the mesh (of ghosts none), with all rows of all `relations`, and links
/// if `link_form` is among them. In a space of Kokkos' all threads of a team of Kokkos' call it, and rows are a
/// SegmentRowsIn of the space's memory; on HostThreads one thread does, the team is a HostTeam, and rows are
/// SegmentRows, which are read alike. A functor whose loops over a team are those of base/team.hpp compiles for all.
template <class Space, class Functor>
void for_each_segment(const Space& space, const Mesh& mesh, RelationSet relations, const Functor& functor,
                      const DeviceSweepOptions& options = {}) {
  if (options.team_scratch > std::size_t(std::numeric_limits<int>::max()))
    throw Error("a team can't have " + std::to_string(options.team_scratch) + " bytes of scratch memory");
  space.fence();
  if constexpr (std::is_same_v<Space, HostThreads>) {
    detail::for_each_segment_on_threads(mesh, relations, functor, options);
  } else {
    using Memory = detail::MemoryOfSweep<Space>;
    detail::BatchSweep<Memory> sweep(mesh, relations, options);
    const int warps = is_device<Space> ? detail::warps_of_team(options, detail::mean_vertices(mesh)) : 1;
    sweep.run([&](const auto& launched) {
      detail::read_batch(space, launched, [&](const Space& instance) {
        Kokkos::TeamPolicy<Space> policy(instance, launched.blocks.count(), warps,
                                         is_device<Space> ? lanes_per_warp : 1);
        policy.set_scratch_size(0, Kokkos::PerTeam(static_cast<int>(options.team_scratch)));
        Kokkos::parallel_for("GALE::for_each_segment", overlapping(policy),
                             detail::OnEachSegment<Memory, Functor>{launched.blocks, functor});
      });
    });
  }
}

/// Calls functor(simplex, row) for each simplex that a relation has a row of, with the Row. A lane a row and a warp a
/// segment on a device; a thread a segment on the host.
template <class Space, class Functor>
void for_each_row(const Space& space, const Mesh& mesh, Relation relation, const Functor& functor,
                  const DeviceSweepOptions& options = {}) {
  constexpr int usual_threads = 256, most_for_a_warp = 512;
  if constexpr (is_device<Space>) {
    if (detail::mean_vertices(mesh) <= most_for_a_warp) {
      const int warps = detail::warps_of_team(options, usual_threads);
      space.fence();
      detail::BatchSweep<WorkerMemory> sweep(mesh, relation, options);
      sweep.run([&](const auto& launched) {
        const Batch<WorkerMemory>& blocks = launched.blocks.of[0];
        const Kokkos::TeamPolicy<Space> policy(launched.instance, (blocks.count + warps - 1) / warps, warps,
                                               lanes_per_warp);
        Kokkos::parallel_for("GALE::for_each_row", overlapping(policy),
                             detail::OnEachRow<WorkerMemory, Functor>{blocks, relation, functor});
      });
      return;
    }
  }
  for_each_segment(space, mesh, relation, detail::OnRowsOfSegment<Functor>{relation, functor}, options);
}

}  // namespace gale
