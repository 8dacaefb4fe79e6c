#pragma once

#include <limits>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/kokkos.hpp>
#include <gale/relations/block_pool.hpp>

namespace gale {

/// Lanes of a warp: what Kokkos calls the vector length.
inline constexpr int warp_lanes = 32;

/// Bytes of scratch memory that a team of `warps` warps asks for, to run `Kernel` on segments of `sizes`.
template <class Kernel>
std::size_t scratch_bytes(const StarSizes& sizes, int warps) {
  constexpr std::size_t alignment = 16;
  return Kernel::scratch_bytes(sizes, warps) + alignment;
}

/// Bytes of scratch memory that a team can have at the fast level.
template <class Space>
std::size_t fast_scratch_bytes() {
  return static_cast<std::size_t>(Kokkos::TeamPolicy<Space>::scratch_size_max(0));
}

/// Starts a kernel on `teams` teams, one a segment of the batch, of `warps` warps each on a device and of one
/// thread on the host, in the scratch memory that its sizes ask for. Returns at once on a device: fence `instance`
/// before you read what it leaves. Not from several threads at once on the host, where HostTeam is for that. Throws
/// gale::Error if a team's scratch memory is more than Kokkos counts (2 GiB).
template <class Space, class Kernel>
void launch(const Space& instance, const Kernel& kernel, int teams, int warps) {
  if (teams < 1) return;
  const int team_size = is_device<Space> ? warps : 1;
  const std::size_t bytes = scratch_bytes<Kernel>(kernel.sizes, team_size);
  if (bytes > std::size_t(std::numeric_limits<int>::max())) {
    throw Error("a segment of " + std::to_string(kernel.sizes.rows) + " rows takes " + std::to_string(bytes) +
                " bytes of scratch memory, more than a team can have: use smaller segments");
  }
  Kokkos::TeamPolicy<Space> policy(instance, teams, team_size, is_device<Space> ? warp_lanes : 1);
  policy.set_scratch_size(kernel.scratch_level, Kokkos::PerTeam(static_cast<int>(bytes)));
  Kokkos::parallel_for(kernel.label(), policy, kernel);
}

}  // namespace gale
