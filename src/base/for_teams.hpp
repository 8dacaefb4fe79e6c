#pragma once

#include <vector>

#include <gale/base/parallel.hpp>
#include <gale/base/team.hpp>

namespace gale::detail {

/// Calls kernel(team) for so many teams, which have kernel.scratch_bytes() bytes of the fast memory of level 0 each: on
/// a device teams of `warps` warps, enqueued on the instance as loops are; on the host each thread is one, of as many
/// as `items` items are worth.
template <class Space, class Kernel>
void for_teams(const char* label, const Space& space, Offset teams, int warps, Offset items, const Kernel& kernel) {
  if (teams == 0) return;
  if constexpr (is_device<Space>) {
    Kokkos::TeamPolicy<Space> policy(space, static_cast<int>(teams), warps, lanes_per_warp);
    policy.set_scratch_size(0, Kokkos::PerTeam(static_cast<int>(kernel.scratch_bytes() + 16)));
    Kokkos::parallel_for(label, policy, kernel);
  } else {
    for_parts(label, teams, threads_for(items), [&](int, Offset first, Offset last) {
      std::vector<char> scratch(kernel.scratch_bytes());
      for (Offset team = first; team < last; ++team) {
        stop_if_asked_at(team);
        kernel(HostTeam(static_cast<int>(team), scratch.data()));
      }
    });
  }
}

}  // namespace gale::detail
