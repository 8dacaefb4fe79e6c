#include <cmath>
#include <limits>
#include <numeric>

#include <gale/algorithms/surface_vertices.hpp>
#include <gale/app/commands/command.hpp>

namespace gale::app {

namespace {

using Json = nlohmann::ordered_json;

/// How the values of an array are called.
std::string type_of(const io::PointArray& array) {
  static const char* const names[] = {"int8",   "uint8", "int16",  "uint16", "int32",
                                      "uint32", "int64", "uint64", "float",  "double"};
  return names[array.values.index()];
}

std::string brief(double value) { return formatted("%.6g", value); }

/// The least and the largest of the values added. NaN is neither: those are counted.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::int64_t nans = 0;

  void add(double value) {
    if (std::isnan(value)) ++nans;
    low = value < low ? value : low;
    high = value > high ? value : high;
  }
  bool empty() const { return low > high; }
  Json json() const { return empty() ? Json(nullptr) : Json{low, high}; }
};

std::string to_string(const Range& range) {
  const std::string values = range.empty() ? "no numbers" : brief(range.low) + " to " + brief(range.high);
  return range.nans == 0 ? values : values + ", " + grouped(range.nans) + " NaN";
}

void tell_extent(const io::Dataset& dataset, Session& session) {
  static const char* const axes[] = {"x", "y", "z"};
  Json extent = Json::array();
  std::visit(
      [&](const auto& points) {
        for (int axis = 0; axis < 3; ++axis) {
          Range range;
          for (std::size_t i = 0; i < points.extent(0); ++i) range.add(points(i, axis));
          session.console().say(axes[axis], to_string(range));
          extent.push_back(range.json());
        }
      },
      dataset.points);
  session.report().result["extent"] = extent;
}

void tell_arrays(const io::Dataset& dataset, Session& session) {
  Json arrays = Json::array();
  for (const auto& array : dataset.arrays) {
    const std::string type = type_of(array);
    Range range;
    std::visit(
        [&](const auto& values) {
          for (const auto value : values) range.add(static_cast<double>(value));
        },
        array.values);
    const std::string components = array.components == 1 ? "" : ", " + std::to_string(array.components) + " components";
    session.console().say("array " + array.name, type + components + ", " + to_string(range));
    arrays.push_back({{"name", array.name},
                      {"type", type},
                      {"components", array.components},
                      {"range", range.json()},
                      {"nan", range.nans}});
  }
  session.report().result["arrays"] = arrays;
}

void tell_surface(const Mesh& mesh, Session& session) {
  const auto on_surface = timed(session.report().seconds.run, [&] { return surface_vertices(mesh); });
  const auto count = std::accumulate(on_surface.data(), on_surface.data() + on_surface.extent(0), std::int64_t(0));
  session.console().say("on the boundary", grouped(count) + " vertices");
  session.report().result["boundary_vertices"] = count;
}

class Info final : public Command {
 public:
  explicit Info(CLI::App& app) : Command(app, "info", "Says what a mesh is: sizes, extent, arrays") {}

  void run() const override {
    Session session = begin();
    io::Dataset dataset = session.read();
    tell_extent(dataset, session);
    tell_arrays(dataset, session);
    if (dataset.dimension() == 3)
      tell_surface(session.encode(dataset, SegmentationOptions(), Session::Keep::nothing), session);
    session.finish();
  }
};

}  // namespace

std::unique_ptr<Command> add_info(CLI::App& app) { return std::make_unique<Info>(app); }

}  // namespace gale::app
