#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <gale/algorithms/critical_simplices.hpp>

namespace gale::detail {

/// Where a critical simplex is among those of its dimension: binary searches.
class CriticalPlaces {
 public:
  explicit CriticalPlaces(const CriticalSimplices& critical);

  Id of_vertex(Id vertex) const { return find(vertices_, vertex); }
  Id of_edge(Id high, Id low) const { return find(edges_, key(high, low)); }
  Id of_tetrahedron(Id tetrahedron) const { return find(tetrahedra_, tetrahedron); }

 private:
  using Places = std::vector<std::pair<std::uint64_t, Id>>;

  static std::uint64_t key(Id high, Id low) { return std::uint64_t(static_cast<std::uint32_t>(high)) << 32 | static_cast<std::uint32_t>(low); }
  static Id find(const Places& places, std::uint64_t key);

  Places vertices_, edges_, tetrahedra_;
};

}  // namespace gale::detail
