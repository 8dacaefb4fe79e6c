#include <random>

#include <gale/app/session.hpp>
#include <gale/outputs/segmentation.hpp>

namespace gale::app {

namespace {

Segmentation by_labels(const std::vector<std::int64_t>& labels) {
  return given_segmentation(Array<const std::int64_t, HostMemory>(labels.data(), labels.size()));
}

/// Each vertex in one of `count` segments, by no rule: the worst that a segmentation can be.
Segmentation scattered(std::size_t vertices, std::int64_t count) {
  std::vector<std::int64_t> labels(vertices);
  std::mt19937_64 random(1);
  for (auto& label : labels) label = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(count));
  return by_labels(labels);
}

Segmentation octree(const io::Dataset& dataset, int capacity) {
  return std::visit(
      [&](const auto& points) {
        using Coordinate = typename std::decay_t<decltype(points)>::non_const_value_type;
        return octree_segmentation<Coordinate, HostMemory>(Points<Coordinate, HostMemory>(points), capacity);
      },
      dataset.points);
}

/// The array to segment by, or nullptr for an octree.
const io::PointArray* given_segments(const io::Dataset& dataset, const SegmentationOptions& options,
                                     std::vector<std::string>& notices) {
  if (!options.array.empty()) return &outputs::select_segments(dataset, options.array);
  if (options.capacity) return nullptr;
  std::vector<std::string> ignored;
  const io::PointArray* const segments = outputs::find_segments(dataset, ignored);
  for (const auto& name : ignored)
    notices.push_back("array " + name + " isn't one whole number a point: not used as segments");
  return segments;
}

}  // namespace

std::optional<Segmentation> segmentation_given(const io::Dataset& dataset, const SegmentationOptions& options,
                                               const Console& console, std::vector<std::string>& notices) {
  if (options.random_count) return scattered(dataset.vertices(), *options.random_count);
  const io::PointArray* const given = given_segments(dataset, options, notices);
  if (given == nullptr) return std::nullopt;
  const auto labels = outputs::labels_of(*given);
  console.say("segments from", "array " + given->name);
  return by_labels(labels);
}

Segmentation make_octree(const io::Dataset& dataset, const SegmentationOptions& options) {
  return octree(dataset, options.capacity.value_or(default_capacity));
}

}  // namespace gale::app
