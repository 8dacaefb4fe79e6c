#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/types.hpp>
#include <gale/io/freudenthal.hpp>
#include <gale/io/noise.hpp>
#include <gale/io/synthetic.hpp>

namespace gale::io {
namespace {

using Host = Kokkos::DefaultHostExecutionSpace;

/// Cubes z-layer after z-layer, and the layers of vertices at them.
struct Layers {
  int n;
  Offset first, cubes;

  Offset vertices() const { return cubes == 0 ? 0 : (cubes + 1) * n * n; }
  Offset tetrahedra() const { return cubes * (n - 1) * (n - 1) * detail::tetrahedra_per_cube; }
  Offset first_vertex() const { return first * n * n; }
  Offset first_tetrahedron() const { return first * (n - 1) * (n - 1) * detail::tetrahedra_per_cube; }
};

/// `what` has `count` of these.
void require_ids(const std::string& what, double count, const std::string& of_what) {
  if (count <= std::numeric_limits<Id>::max()) return;
  std::ostringstream digits;
  digits << std::fixed << std::setprecision(0) << count;
  throw Error(what + " has " + digits.str() + " " + of_what + ", more than the " +
              std::to_string(std::numeric_limits<Id>::max()) + " that 32-bit ids can number");
}

std::string name_of_grid(int n) { return "grid:" + std::to_string(n); }

void require_cubes(int n) {
  if (n < 2) throw Error(name_of_grid(n) + " has no tetrahedra: N must be at least 2");
}

void check_size(int n) {
  require_cubes(n);
  const double points = n, cubes = points - 1;
  require_ids(name_of_grid(n), points * points * points, "vertices");
  require_ids(name_of_grid(n), cubes * cubes * cubes * detail::tetrahedra_per_cube, "tetrahedra");
}

Dataset::Points<float> make_points(const Layers& layers) {
  const int n = layers.n;
  const auto points = allocate<Dataset::Points<float>>("GALE::points", layers.vertices());
  parallel_for("GALE::make_points", Host(), layers.vertices() / n, [&](Offset row) {
    for (int x = 0; x < n; ++x) {
      const std::size_t i = std::size_t(row) * n + x;
      points(i, 0) = static_cast<float>(x);
      points(i, 1) = static_cast<float>(row % n);
      points(i, 2) = static_cast<float>(layers.first + row / n);
    }
  });
  return points;
}

/// By the numbers of vertices in the whole mesh.
template <class Index>
auto make_tetrahedra(const Layers& layers) {
  const int n = layers.n, c = n - 1;
  const auto tetrahedra = allocate<Kokkos::View<Index* [4], Kokkos::LayoutRight, Kokkos::HostSpace>>(
      "GALE::tetrahedra", layers.tetrahedra());
  const Index step[3] = {1, Index(n), Index(n) * n};
  parallel_for("GALE::make_tetrahedra", Host(), layers.cubes * c, [&](Offset row) {
    for (int x = 0; x < c; ++x) {
      const Index lowest = static_cast<Index>(((layers.first + row / c) * n + row % c) * n + x);
      const std::size_t first = (std::size_t(row) * c + x) * detail::tetrahedra_per_cube;
      for (int p = 0; p < detail::tetrahedra_per_cube; ++p) {
        for (int k = 0; k < 4; ++k) {
          const int corner = detail::freudenthal[p][k];
          tetrahedra(first + p, k) =
              lowest + (corner & 1) * step[0] + (corner >> 1 & 1) * step[1] + (corner >> 2) * step[2];
        }
      }
    }
  });
  return tetrahedra;
}

std::vector<float> make_field(const Layers& layers) {
  const int n = layers.n;
  std::vector<double> sine_x(n), cosine_y(n), sine_zx(std::size_t(n) * n);
  for (int k = 0; k < n; ++k) {
    sine_x[k] = std::sin(0.11 * k);
    cosine_y[k] = std::cos(0.13 * k);
    for (int x = 0; x < n; ++x) sine_zx[std::size_t(k) * n + x] = std::sin(0.17 * k + 0.05 * x);
  }
  std::vector<float> field(static_cast<std::size_t>(layers.vertices()));
  parallel_for("GALE::make_field", Host(), layers.vertices() / n, [&](Offset row) {
    const Offset y = row % n, z = layers.first + row / n;
    for (int x = 0; x < n; ++x) {
      const std::size_t i = std::size_t(row) * n + x;
      const double noise = 0.05 * (detail::noise(static_cast<std::uint32_t>(layers.first_vertex() + i)) / 4294967296.0);
      field[i] = static_cast<float>(sine_x[x] * cosine_y[y] + sine_zx[std::size_t(z) * n + x] + noise);
    }
  });
  return field;
}

}  // namespace

Dataset make_grid(int n) {
  check_size(n);
  const Layers all{n, 0, n - 1};
  Dataset dataset;
  dataset.points = make_points(all);
  dataset.tetrahedra = make_tetrahedra<std::int32_t>(all);
  dataset.arrays.push_back({"field", 1, make_field(all)});
  return dataset;
}

template <class Index>
GridPartOf<Index> make_grid_part(int n, int part, int parts) {
  require_cubes(n);
  constexpr int most = 1625;  // its 2^32 numbers make the field's noise
  if (n > most) throw Error(name_of_grid(n) + " is too large: N is at most " + std::to_string(most));
  if (part < 0 || part >= parts)
    throw Error("there is no part " + std::to_string(part) + " of " + std::to_string(parts));
  if (sizeof(Index) < sizeof(Offset)) require_ids(name_of_grid(n), std::pow(n, 3), "vertices");
  const Offset first = Offset(n - 1) * part / parts, last = Offset(n - 1) * (part + 1) / parts;
  const Layers layers{n, first, last - first};
  const std::string name = "part " + std::to_string(part) + " of " + name_of_grid(n);
  require_ids(name, static_cast<double>(layers.vertices()), "vertices");
  require_ids(name, static_cast<double>(layers.tetrahedra()), "tetrahedra");
  return {make_points(layers), make_field(layers), layers.first_vertex(), make_tetrahedra<Index>(layers),
          layers.first_tetrahedron()};
}

template GALE_EXPORT GridPartOf<std::int32_t> make_grid_part(int, int, int);
template GALE_EXPORT GridPartOf<std::int64_t> make_grid_part(int, int, int);

}  // namespace gale::io
