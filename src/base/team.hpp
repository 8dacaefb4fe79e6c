#pragma once

#include <cstddef>
#include <cstdint>

#include <gale/base/kokkos.hpp>

// The steps that team kernels are made of, for two kinds of team: Kokkos' own, and a team of one host thread that needs
// no launch. A kernel written with them is one source for all, such as a functor of for_each_segment
// (runtime/device_sweep.hpp). A "warp" is what Kokkos calls a thread with its vector lanes.

namespace gale {

/// A team of one thread, the caller's. Consumers run segment kernels through it, each for itself, at the cost of a
/// function call: Kokkos' Serial TeamPolicy is not safe from several threads before 4.4, and its launch is not free.
class HostTeam {
 public:
  /// The team of that rank, whose scratch memory begins at `scratch`.
  KOKKOS_FUNCTION HostTeam(int league_rank, char* scratch) : scratch_(scratch), league_rank_(league_rank) {}

  KOKKOS_FUNCTION int league_rank() const { return league_rank_; }  ///< which team of the league it is
  KOKKOS_FUNCTION int team_rank() const { return 0; }               ///< which thread of the team: there is one
  KOKKOS_FUNCTION int team_size() const { return 1; }               ///< how many threads the team has
  KOKKOS_FUNCTION void team_barrier() const {}                      ///< returns at once
  KOKKOS_FUNCTION char* scratch() const { return scratch_; }        ///< where its scratch memory begins

 private:
  char* scratch_;
  int league_rank_;
};

/// Are the loops of a team of this kind plain loops, in order?
template <class Team>
inline constexpr bool is_sequential = std::is_same_v<Team, HostTeam>;

/// The steps that kernels of teams are made of.
namespace team {

/// How many warps the team has.
template <class Team>
KOKKOS_FORCEINLINE_FUNCTION int warps(const Team& team) {
  return team.team_size();
}

/// The number of this thread's warp in its team.
template <class Team>
KOKKOS_FORCEINLINE_FUNCTION int warp(const Team& team) {
  return team.team_rank();
}

/// The team's scratch memory of `bytes` bytes, aligned to 16, at a level that is known at compile time. If it is not,
/// nvcc keeps the whole kernel object of each thread in memory, and accesses scratch memory in the slower way that
/// works for any.
template <int level>
KOKKOS_FORCEINLINE_FUNCTION char* scratch(const HostTeam& team, std::size_t) {
  return team.scratch();
}
/// scratch for a team of Kokkos'.
template <int level, class Team>
KOKKOS_FORCEINLINE_FUNCTION char* scratch(const Team& team, std::size_t bytes) {
  char* const memory = static_cast<char*>(team.team_scratch(level).get_shmem_aligned(bytes, 16, level));
#if defined(GALE_ON_DEVICE)
  if constexpr (level == 0) return static_cast<char*>(detail::in_shared_memory(memory));
#endif
  return memory;
}

/// All threads of the team meet, and see each other's writes.
template <class Team>
KOKKOS_FORCEINLINE_FUNCTION void barrier(const Team& team) {
  team.team_barrier();
}

/// body(i) for i in 0..n-1, by all lanes of all warps.
template <class Body>
KOKKOS_FORCEINLINE_FUNCTION void for_all(const HostTeam&, int n, const Body& body) {
  for (int i = 0; i < n; ++i) body(i);
}
/// for_all for a team of Kokkos'.
template <class Team, class Body>
KOKKOS_FORCEINLINE_FUNCTION void for_all(const Team& team, int n, const Body& body) {
  Kokkos::parallel_for(Kokkos::TeamVectorRange(team, n), body);
}

/// Calls body(i, load(i)) likewise. Where a lane takes several, it loads the next before it works on one: body must not
/// write what load reads.
template <class Team, class Load, class Body>
KOKKOS_FORCEINLINE_FUNCTION void for_all_loaded(const Team& team, int n, const Load& load, const Body& body) {
#if defined(GALE_ON_DEVICE)
  const int lane = static_cast<int>(threadIdx.y * blockDim.x + threadIdx.x),
            step = static_cast<int>(blockDim.x * blockDim.y);
  decltype(load(0)) next;
  if (lane < n) next = load(lane);
  for (int i = lane; i - lane % lanes_per_warp < n; i += step) {
    const auto loaded = next;
    if (i + step < n) next = load(i + step);
    if (i < n) body(i, loaded);
    detail::meet();
  }
#else
  for_all(team, n, [&](int i) { body(i, load(i)); });
#endif
}

/// body(i) for i in 0..n-1, by a warp each, all of whose lanes call it.
template <class Body>
KOKKOS_FORCEINLINE_FUNCTION void for_warps(const HostTeam&, int n, const Body& body) {
  for (int i = 0; i < n; ++i) body(i);
}
/// for_warps for a team of Kokkos'.
template <class Team, class Body>
KOKKOS_FORCEINLINE_FUNCTION void for_warps(const Team& team, int n, const Body& body) {
  Kokkos::parallel_for(Kokkos::TeamThreadRange(team, n), body);
}

/// Inside for_warps: body(i) for i in 0..n-1 by the lanes of this warp, which have met again and see each other's
/// writes afterwards.
template <class Body>
KOKKOS_FORCEINLINE_FUNCTION void for_lanes(const HostTeam&, int n, const Body& body) {
  for (int i = 0; i < n; ++i) body(i);
}
/// for_lanes for a team of Kokkos'.
template <class Team, class Body>
KOKKOS_FORCEINLINE_FUNCTION void for_lanes(const Team& team, int n, const Body& body) {
  Kokkos::parallel_for(Kokkos::ThreadVectorRange(team, n), body);
}

/// Inside for_warps: the lanes of this warp meet and see each other's writes.
template <class Team>
KOKKOS_FORCEINLINE_FUNCTION void warp_barrier(const Team& team) {
  for_lanes(team, 1, [](int) {});
}

/// body(), after which the lanes that began it together go on together. Lanes that a loop has parted may stay apart for
/// long without it.
template <class Body>
KOKKOS_FORCEINLINE_FUNCTION void reconverge_after(const Body& body) {
#if defined(GALE_ON_DEVICE)
  const auto lanes = detail::lanes_here();
  body();
  detail::meet(lanes);
#else
  body();
#endif
}

/// Inside for_warps: body() by one lane. The others run on.
template <class Body>
KOKKOS_FORCEINLINE_FUNCTION void once_per_warp(const HostTeam&, const Body& body) {
  body();
}
/// once_per_warp for a team of Kokkos'.
template <class Team, class Body>
KOKKOS_FORCEINLINE_FUNCTION void once_per_warp(const Team& team, const Body& body) {
  Kokkos::single(Kokkos::PerThread(team), body);
}

/// body() by one lane of the team. No barrier: others run on.
template <class Body>
KOKKOS_FORCEINLINE_FUNCTION void once(const HostTeam&, const Body& body) {
  body();
}
/// once for a team of Kokkos'.
template <class Team, class Body>
KOKKOS_FORCEINLINE_FUNCTION void once(const Team& team, const Body& body) {
  Kokkos::single(Kokkos::PerTeam(team), body);
}

// Atomics. On a device its own, whose memory the compiler sees: those of Kokkos are assembly that takes any address.

/// Adds to what the team shares and returns what was there.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T add(const HostTeam&, T* to, T value) {
  const T before = *to;
  *to += value;
  return before;
}
/// add for a team of Kokkos'.
template <class Team, class T>
KOKKOS_FORCEINLINE_FUNCTION T add(const Team&, T* to, T value) {
#if defined(GALE_ON_DEVICE)
  if constexpr (sizeof(T) == sizeof(unsigned)) {
    return static_cast<T>(atomicAdd(reinterpret_cast<unsigned*>(to), static_cast<unsigned>(value)));
  } else {
    return static_cast<T>(atomicAdd(reinterpret_cast<unsigned long long*>(to), static_cast<unsigned long long>(value)));
  }
#else
  return Kokkos::atomic_fetch_add(to, value);
#endif
}

/// Raises what the team shares to at least `value`.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void raise(const HostTeam&, T* to, T value) {
  if (*to < value) *to = value;
}
/// raise for a team of Kokkos'.
template <class Team, class T>
KOKKOS_FORCEINLINE_FUNCTION void raise(const Team&, T* to, T value) {
#if defined(GALE_ON_DEVICE)
  atomicMax(to, value);
#else
  Kokkos::atomic_fetch_max(to, value);
#endif
}

/// Sets bits of what the team shares.
KOKKOS_FORCEINLINE_FUNCTION void set_bits(const HostTeam&, std::uint32_t* of, std::uint32_t bits) { *of |= bits; }
/// set_bits for a team of Kokkos'.
template <class Team>
KOKKOS_FORCEINLINE_FUNCTION void set_bits(const Team&, std::uint32_t* of, std::uint32_t bits) {
#if defined(GALE_ON_DEVICE)
  atomicOr(of, bits);
#else
  Kokkos::atomic_fetch_or(of, bits);
#endif
}

/// Puts `value` where `expected` is; returns what was there.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION T exchange_if(const HostTeam&, T* at, T expected, T value) {
  const T before = *at;
  if (before == expected) *at = value;
  return before;
}
/// exchange_if for a team of Kokkos'.
template <class Team, class T>
KOKKOS_FORCEINLINE_FUNCTION T exchange_if(const Team&, T* at, T expected, T value) {
#if defined(GALE_ON_DEVICE)
  return atomicCAS(at, expected, value);
#else
  return Kokkos::atomic_compare_exchange(at, expected, value);
#endif
}

/// Replaces values[0..n-1] by the sums of those before each, and values[n] by the sum of all. To be called by all; ends
/// with a barrier.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void exclusive_scan(const HostTeam&, int n, T* values) {
  T sum = 0;
  for (int i = 0; i < n; ++i) {
    const T here = values[i];
    values[i] = sum;
    sum += here;
  }
  values[n] = sum;
}
/// exclusive_scan for a team of Kokkos'.
template <class Team, class T>
KOKKOS_FORCEINLINE_FUNCTION void exclusive_scan(const Team& team, int n, T* values) {
  team.team_barrier();
  for_warps(team, 1, [&](int) {
    Kokkos::parallel_scan(Kokkos::ThreadVectorRange(team, n + 1), [&](int i, T& sum, bool final) {
      const T here = i < n ? values[i] : T(0);
      if (final) values[i] = sum;
      sum += here;
    });
  });
  team.team_barrier();
}

}  // namespace team

}  // namespace gale
