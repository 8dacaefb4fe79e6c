#pragma once

#include <gale/io/synthetic.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::perf {

/// grid:n, encoded with an octree.
inline Mesh encode(const io::Dataset& data, int capacity = default_capacity) {
  const auto& points = std::get<io::Dataset::Points<float>>(data.points);
  return Mesh(Tetrahedra<Id, HostMemory>(data.tetrahedra),
              octree_segmentation<float, HostMemory>(Points<float, HostMemory>(points), capacity));
}

}  // namespace gale::perf
