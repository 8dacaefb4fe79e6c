#include <cmath>
#include <utility>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/io/image.hpp>
#include <gale/io/noise.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/io/voxels.hpp>

namespace gale::io {
namespace {

/// A point of the cube from -1 to 1, and a number of its own between 0 and 1.
struct CubePoint {
  double x, y, z, noise;

  double radius() const { return std::sqrt(x * x + y * y + z * z); }
  double waves() const { return 3 + std::sin(9 * x) * std::cos(7 * y) + std::sin(8 * z + 3 * x); }
};

struct SyntheticKind {
  const char* name;
  bool (*has)(const CubePoint&);
  double (*value)(const CubePoint&);  ///< above 0
};

bool everywhere(const CubePoint&) { return true; }

constexpr SyntheticKind synthetic_kinds[] = {
    {"smooth", everywhere,
     [](const CubePoint& p) { return 4 + std::sin(3 * p.x + 1) * std::cos(2 * p.y) + p.z * p.x; }},
    {"noisy", everywhere, [](const CubePoint& p) { return 1 + p.noise; }},
    {"ball", [](const CubePoint& p) { return p.radius() <= 1; }, [](const CubePoint& p) { return p.waves(); }},
    {"shells",
     [](const CubePoint& p) {
       const double of_three = 3 * p.radius();
       return of_three <= 3 && of_three - std::floor(of_three) >= 0.55;
     },
     [](const CubePoint& p) { return p.waves() + 0.3 * p.noise; }},
    {"dense", everywhere, [](const CubePoint& p) { return p.waves() + 0.02 * p.noise; }},
};

const SyntheticKind* kind_named(const std::string& name) {
  for (const SyntheticKind& kind : synthetic_kinds) {
    if (name == kind.name) return &kind;
  }
  return nullptr;
}

/// Towards the first corner: the density falls with the square of a coordinate.
void gather_points(Dataset& dataset, int n) {
  const auto& points = std::get<Dataset::Points<float>>(dataset.points);
  parallel_for("GALE::gather_points", HostExecutionSpace(), static_cast<Offset>(points.extent(0)), [&](Offset i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double from = points(i, axis) / double(n - 1);
      points(i, axis) = static_cast<float>((n - 1) * (0.1 * from + 0.9 * from * from * from));
    }
  });
}

}  // namespace

bool is_synthetic(const std::string& kind) { return kind_named(kind) != nullptr; }

Dataset make_synthetic(const std::string& kind, int n) {
  const SyntheticKind* const made = kind_named(kind);
  if (made == nullptr) throw Error("there is no synthetic mesh '" + kind + "'");
  const std::string name = kind + ":" + std::to_string(n);
  if (n < 2) throw Error(name + " has no tetrahedra: N must be at least 2");
  if (n > 1290) throw Error(name + " has more vertices than the 2147483647 that 32-bit ids can number");
  Image image;
  image.dimensions = {n, n, n};
  std::vector<float> values(static_cast<std::size_t>(n) * n * n);
  const auto coordinate = [n](Offset i) { return 2.0 * static_cast<double>(i) / (n - 1) - 1; };
  parallel_for("GALE::make_synthetic", HostExecutionSpace(), Offset(n) * n, [&](Offset row) {
    for (Offset x = 0; x < n; ++x) {
      const Offset i = row * n + x;
      const CubePoint place = {coordinate(x), coordinate(row % n), coordinate(row / n),
                               detail::noise(static_cast<std::uint32_t>(i)) / 4294967296.0};
      values[static_cast<std::size_t>(i)] = made->has(place) ? static_cast<float>(made->value(place)) : 0.0F;
    }
  });
  image.arrays.push_back({"field", 1, std::move(values)});
  Dataset dataset = split_voxels(std::move(image), 0);
  if (kind == "dense") gather_points(dataset, n);
  return dataset;
}

}  // namespace gale::io
