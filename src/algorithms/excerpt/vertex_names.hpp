#pragma once

#include <cstdint>

#include <gale/base/ordered.hpp>
#include <gale/mesh/intervals.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::detail {

/// Numbers of vertices that compare as global ids do: of one rank's own, whose global ids must ascend with input ids,
/// and of others, whose ids come after GALE's. Each is how many vertices have a lower global id. Owns nothing.
struct VertexNames {
  OtherIds input;                  ///< of own vertices, by GALE's ids
  Id own = 0;                      ///< how many these are
  const Id* own_before = nullptr;  ///< of each other one, by global id: how many own ones come before it
  Interval between{0, 0};          ///< those others that some own ones come before, and some after

  KOKKOS_FUNCTION Id operator[](Id vertex) const {
    if (vertex >= own) return own_before[vertex - own] + (vertex - own);
    return input[vertex] + others_before(input[vertex]);
  }

  /// How many others come before an own one, by its input id.
  KOKKOS_FUNCTION Id others_before(Id id) const {
    if (between.first == between.last) return between.first;
    return bisect(between.first, between.last, [this, id](Id other) { return own_before[other] <= id; });
  }
};

/// Keys that compare vertices that have names. Owns nothing.
struct NamedKeys {
  const std::uint64_t* own;               ///< of own vertices; where there are names, with input ids in lower halves
  Id count;                               ///< how many these are
  const std::uint64_t* others = nullptr;  ///< of the others, with names there
  VertexNames names{};                    ///< of all; none where own keys compare as they are

  KOKKOS_FUNCTION std::uint64_t operator[](Id vertex) const {
    if (vertex >= count) return others[vertex - count];
    return own[vertex] + names.others_before(static_cast<Id>(own[vertex]));
  }
};

}  // namespace gale::detail
