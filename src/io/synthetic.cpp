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
#include <gale/io/synthetic.hpp>

namespace gale::io {
namespace {

using Host = Kokkos::DefaultHostExecutionSpace;

std::uint32_t hash(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  return x ^ (x >> 16);
}

void check_size(int n) {
  const std::string name = "grid:" + std::to_string(n);
  if (n < 2) throw Error(name + " has no tetrahedra: N must be at least 2");
  const auto require_ids = [&](double count, const std::string& of_what) {
    if (count <= std::numeric_limits<Id>::max()) return;
    std::ostringstream digits;
    digits << std::fixed << std::setprecision(0) << count;
    throw Error(name + " has " + digits.str() + " " + of_what + ", more than the " +
                std::to_string(std::numeric_limits<Id>::max()) + " that 32-bit ids can number");
  };
  const double points = n, cubes = points - 1;
  require_ids(points * points * points, "vertices");
  require_ids(cubes * cubes * cubes * detail::tetrahedra_per_cube, "tetrahedra");
}

Dataset::Points<float> make_points(int n) {
  const auto points = allocate<Dataset::Points<float>>("GALE::points", std::size_t(n) * n * n);
  parallel_for("GALE::make_points", Host(), Offset(n) * n, [&](Offset row) {
    for (int x = 0; x < n; ++x) {
      const std::size_t i = std::size_t(row) * n + x;
      points(i, 0) = static_cast<float>(x);
      points(i, 1) = static_cast<float>(row % n);
      points(i, 2) = static_cast<float>(row / n);
    }
  });
  return points;
}

auto make_tetrahedra(int n) {
  const int c = n - 1;
  const auto tetrahedra =
      allocate<decltype(Dataset::tetrahedra)>("GALE::tetrahedra", std::size_t(c) * c * c * detail::tetrahedra_per_cube);
  const Id step[3] = {1, n, n * n};
  parallel_for("GALE::make_tetrahedra", Host(), Offset(c) * c, [&](Offset row) {
    for (int x = 0; x < c; ++x) {
      const Id lowest = static_cast<Id>(((row / c) * n + row % c) * n + x);
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

std::vector<float> make_field(int n) {
  std::vector<double> sine_x(n), cosine_y(n), sine_zx(std::size_t(n) * n);
  for (int k = 0; k < n; ++k) {
    sine_x[k] = std::sin(0.11 * k);
    cosine_y[k] = std::cos(0.13 * k);
    for (int x = 0; x < n; ++x) sine_zx[std::size_t(k) * n + x] = std::sin(0.17 * k + 0.05 * x);
  }
  std::vector<float> field(std::size_t(n) * n * n);
  parallel_for("GALE::make_field", Host(), Offset(n) * n, [&](Offset row) {
    const Offset y = row % n, z = row / n;
    for (int x = 0; x < n; ++x) {
      const std::size_t i = std::size_t(row) * n + x;
      const double noise = 0.05 * (hash(static_cast<std::uint32_t>(i)) / 4294967296.0);
      field[i] = static_cast<float>(sine_x[x] * cosine_y[y] + sine_zx[std::size_t(z) * n + x] + noise);
    }
  });
  return field;
}

}  // namespace

Dataset make_grid(int n) {
  check_size(n);
  Dataset dataset;
  dataset.points = make_points(n);
  dataset.tetrahedra = make_tetrahedra(n);
  dataset.arrays.push_back({"field", 1, make_field(n)});
  return dataset;
}

}  // namespace gale::io
