#pragma once

#include <array>

#include <gale/base/types.hpp>

namespace gale {

/// Consecutive ids, `first` to `last` - 1.
struct Interval {
  Id first = 0;
  Id last = 0;

  Id size() const { return last - first; }
  bool has(Id id) const { return id >= first && id < last; }
};

/// Of vertices, edges, triangles and tetrahedra; empty for those that aren't enumerated.
using Intervals = std::array<Interval, 4>;

}  // namespace gale
