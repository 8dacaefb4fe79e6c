#include <gale/base/error.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/segmentation.hpp>

namespace gale::outputs {

io::PointArray segments_of(const Mesh& mesh) {
  std::vector<std::int32_t> segments(mesh.vertices());
  const auto& begin = mesh.vertex_begin();
  const OtherIds input = mesh.vertices_in_input();
  for (Id s = 0; s < mesh.segments(); ++s) {
    for (Id v = begin(s); v < begin(s + 1); ++v) segments[input(v)] = s;
  }
  return {segments_name, 1, std::move(segments)};
}

bool holds_segments(const io::PointArray& array) {
  const auto whole = [](const auto& values) {
    return std::is_integral_v<typename std::decay_t<decltype(values)>::value_type>;
  };
  return array.components == 1 && std::visit(whole, array.values);
}

const io::PointArray& select_segments(const io::Dataset& dataset, const std::string& name) {
  const auto* const array = detail::find_array(dataset, name);
  if (array == nullptr) throw Error("no point array '" + name + "' with segments: " + detail::names_of_arrays(dataset));
  return *array;
}

const io::PointArray* find_segments(const io::Dataset& dataset, std::vector<std::string>& ignored) {
  for (const auto* const name : {segments_name, ttk_segments_name}) {
    const auto* const array = detail::find_array(dataset, name);
    if (array == nullptr) continue;
    if (holds_segments(*array)) return array;
    ignored.push_back(name);
  }
  return nullptr;
}

std::vector<std::int64_t> labels_of(const io::PointArray& segments) {
  if (segments.components != 1) {
    throw Error("array '" + segments.name + "' has " + std::to_string(segments.components) +
                " components: segments are one label a point");
  }
  return std::visit(
      [&](const auto& values) -> std::vector<std::int64_t> {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if constexpr (std::is_floating_point_v<Value>) {
          throw Error("array '" + segments.name + "' is of floating-point numbers: segments are whole numbers");
        } else {
          return {values.begin(), values.end()};
        }
      },
      segments.values);
}

}  // namespace gale::outputs
