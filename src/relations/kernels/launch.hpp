#pragma once

#include <limits>
#include <string>
#include <type_traits>

#include <gale/base/error.hpp>
#include <gale/base/kokkos.hpp>
#include <gale/relations/kernels/block_pool.hpp>

namespace gale {

/// The threads of a team: so many warps of so many lanes, which Kokkos calls threads and vector length.
struct TeamShape {
  int warps;
  int lanes;

  TeamShape(int full_warps, int warp_lanes = lanes_per_warp) : warps(full_warps), lanes(warp_lanes) {}

  /// A team of exactly so many threads, at least 1: with full warps if they are a multiple of theirs, else with the
  /// largest ones that they are a multiple of.
  static TeamShape of(int threads) {
    int lanes = lanes_per_warp;
    while (threads % lanes != 0) lanes /= 2;
    return {threads / lanes, lanes};
  }
};

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

/// Calls use(level) with the level of scratch memory, as a constant, that a kernel in `Memory` is launched for: on the
/// host always 1, where both are the same memory and each kernel needs compiling once.
template <class Memory, class Use>
void at_scratch_level(int level, const Use& use) {
  if constexpr (is_device_memory<Memory>) {
    if (level == 0) return use(std::integral_constant<int, 0>());
  }
  use(std::integral_constant<int, 1>());
}

/// Starts a kernel on `teams` teams, one a segment of the batch, of that shape each on a device and of one
/// thread on the host, in the scratch memory that its sizes ask for. Returns at once on a device: fence `instance`
/// before you read what it leaves. Not from several threads at once on the host, where HostTeam is for that. Throws
/// gale::Error if a team's scratch memory is more than Kokkos counts (2 GiB).
template <class Space, class Kernel>
void launch(const Space& instance, const Kernel& kernel, int teams, TeamShape shape) {
  if (teams < 1) return;
  const int team_size = is_device<Space> ? shape.warps : 1;
  const std::size_t bytes = scratch_bytes<Kernel>(kernel.sizes, team_size);
  if (bytes > std::size_t(std::numeric_limits<int>::max())) {
    throw Error("a segment of " + std::to_string(kernel.sizes.rows) + " rows takes " + std::to_string(bytes) +
                " bytes of scratch memory, more than a team can have: use smaller segments");
  }
  Kokkos::TeamPolicy<Space> policy(instance, teams, team_size, is_device<Space> ? shape.lanes : 1);
  at_scratch_level<MemoryOf<Space>>(kernel.scratch_level, [&](auto level) {
    policy.set_scratch_size(level, Kokkos::PerTeam(static_cast<int>(bytes)));
  });
  kernel.use_on_teams([&](const auto& functor) { Kokkos::parallel_for(kernel.label(), overlapping(policy), functor); });
}

}  // namespace gale
