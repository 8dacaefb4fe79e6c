#pragma once

#include <optional>

#include <gale/algorithms/vertex_order.hpp>

#include "support/bench_mesh.hpp"
#include "support/clock.hpp"

namespace gale::perf {

/// The mesh of an input and the order of its first field, and the seconds that each step to them took.
class Initialized {
 public:
  explicit Initialized(const io::Dataset& data, int capacity = default_capacity) {
    const auto& points = std::get<io::Dataset::Points<float>>(data.points);
    const auto& field = std::get<std::vector<float>>(data.arrays[0].values);
    std::optional<Segmentation> segmentation;
    segment =
        seconds_of([&] { segmentation.emplace(octree_segmentation(Points<float, HostMemory>(points), capacity)); });
    encode = seconds_of([&] { mesh_.emplace(Tetrahedra<Id, HostMemory>(data.tetrahedra), *segmentation); });
    rank = seconds_of([&] { order_.emplace(*mesh_, field.data(), field.size()); });
  }

  const Mesh& mesh() const { return *mesh_; }
  const VertexOrder& order() const { return *order_; }

  double segment = 0, encode = 0, rank = 0;

 private:
  std::optional<Mesh> mesh_;
  std::optional<VertexOrder> order_;
};

}  // namespace gale::perf
