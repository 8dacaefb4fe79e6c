#include "support/segmentations.hpp"

#include <functional>
#include <random>
#include <stdexcept>

namespace gale::test {

namespace {

using MakeSegmentation = std::function<Segmentation(const InputMesh&)>;

template <class Label>
Segmentation labelled(const InputMesh& mesh, const Label& label) {
  std::vector<std::int64_t> labels(mesh.vertices());
  for (Id v = 0; v < mesh.vertices(); ++v) labels[v] = label(v);
  return segmentation_by(labels);
}

const std::vector<std::pair<std::string, MakeSegmentation>>& ways_to_segment() {
  static const std::vector<std::pair<std::string, MakeSegmentation>> all = {
      {"octree_1", [](const InputMesh& mesh) { return octree_of(mesh, 1); }},
      {"octree_7", [](const InputMesh& mesh) { return octree_of(mesh, 7); }},
      {"octree_100", [](const InputMesh& mesh) { return octree_of(mesh, 100); }},
      {"octree_1000000", [](const InputMesh& mesh) { return octree_of(mesh, 1000000); }},
      {"one_vertex_each_backwards", [](const InputMesh& mesh) { return labelled(mesh, [](Id v) { return -v; }); }},
      {"all_in_one", [](const InputMesh& mesh) { return labelled(mesh, [](Id) { return 7; }); }},
      {"random_labels",
       [](const InputMesh& mesh) {
         std::mt19937 random(3);
         return labelled(mesh, [&](Id) { return random() % 5; });
       }},
      {"labels_with_gaps_and_signs",
       [](const InputMesh& mesh) {
         constexpr std::int64_t labels[] = {INT64_MAX, -3, INT64_MIN, 1000000000000, -4, 0};
         return labelled(mesh, [&](Id v) { return labels[v % 6]; });
       }},
  };
  return all;
}

}  // namespace

const std::vector<std::string>& segmentation_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, make] : ways_to_segment()) all.push_back(name);
    return all;
  }();
  return names;
}

Segmentation segmentation_named(const std::string& name, const InputMesh& mesh) {
  for (const auto& [known, make] : ways_to_segment()) {
    if (known == name) return make(mesh);
  }
  throw std::out_of_range("no segmentation named " + name);
}

Segmentation octree_of(const InputMesh& mesh, int capacity) {
  return octree_segmentation(points_of<double>(mesh), capacity);
}

Mesh encode(const InputMesh& mesh, int capacity) { return encode(mesh, octree_of(mesh, capacity)); }

Segmentation segmentation_by(const std::vector<std::int64_t>& labels) {
  const Array<std::int64_t, HostMemory> view("labels", labels.size());
  for (std::size_t v = 0; v < labels.size(); ++v) view(v) = labels[v];
  return given_segmentation(view);
}

Segmentation large_and_small(const InputMesh& mesh) {
  return labelled(mesh, [](Id v) { return 2 * (v / 420) + (v % 420 < 400 ? 0 : 1); });
}

}  // namespace gale::test
