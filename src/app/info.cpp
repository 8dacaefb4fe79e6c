#include <algorithm>
#include <numeric>

#include <gale/relations/boundary.hpp>

#include "commands.hpp"
#include "session.hpp"

namespace gale::app {

namespace {

using Json = nlohmann::ordered_json;

struct TypeName {
  const char* operator()(const std::vector<std::int8_t>&) const { return "int8"; }
  const char* operator()(const std::vector<std::uint8_t>&) const { return "uint8"; }
  const char* operator()(const std::vector<std::int16_t>&) const { return "int16"; }
  const char* operator()(const std::vector<std::uint16_t>&) const { return "uint16"; }
  const char* operator()(const std::vector<std::int32_t>&) const { return "int32"; }
  const char* operator()(const std::vector<std::uint32_t>&) const { return "uint32"; }
  const char* operator()(const std::vector<std::int64_t>&) const { return "int64"; }
  const char* operator()(const std::vector<std::uint64_t>&) const { return "uint64"; }
  const char* operator()(const std::vector<float>&) const { return "float"; }
  const char* operator()(const std::vector<double>&) const { return "double"; }
};

std::string brief(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

void tell_extent(const io::Dataset& dataset, Session& session) {
  static const char* const axes[] = {"x", "y", "z"};
  Json extent = Json::array();
  std::visit(
      [&](const auto& points) {
        for (int axis = 0; axis < 3; ++axis) {
          double low = points(0, axis), high = low;
          for (std::size_t i = 1; i < points.extent(0); ++i) {
            low = std::min<double>(low, points(i, axis));
            high = std::max<double>(high, points(i, axis));
          }
          session.console().say(axes[axis], brief(low) + " to " + brief(high));
          extent.push_back({low, high});
        }
      },
      dataset.points);
  session.report().result["extent"] = extent;
}

void tell_arrays(const io::Dataset& dataset, Session& session) {
  Json arrays = Json::array();
  for (const auto& array : dataset.arrays) {
    const std::string type = std::visit(TypeName(), array.values);
    double low = 0, high = 0;
    std::visit(
        [&](const auto& values) {
          if (values.empty()) return;
          const auto range = std::minmax_element(values.begin(), values.end());
          low = static_cast<double>(*range.first), high = static_cast<double>(*range.second);
        },
        array.values);
    const std::string components = array.components == 1 ? "" : ", " + std::to_string(array.components) + " components";
    session.console().say("array " + array.name, type + components + ", " + brief(low) + " to " + brief(high));
    arrays.push_back({{"name", array.name}, {"type", type}, {"components", array.components}, {"range", {low, high}}});
  }
  session.report().result["arrays"] = arrays;
}

}  // namespace

void info(const Options& options) {
  Session session(options);
  io::Dataset dataset = session.read();
  tell_extent(dataset, session);
  tell_arrays(dataset, session);
  const Mesh mesh = session.encode(dataset, Session::Keep::nothing);
  Array<std::uint8_t, HostMemory> boundary;
  {
    const Stopwatch watch(session.report().seconds.run);
    boundary = boundary_vertices(mesh);
  }
  const auto count = std::accumulate(boundary.data(), boundary.data() + boundary.extent(0), std::int64_t(0));
  session.console().say("on the boundary", grouped(count) + " vertices");
  session.report().result["boundary_vertices"] = count;
  session.finish(nullptr);
}

}  // namespace gale::app
