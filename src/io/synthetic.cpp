#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/types.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/image.hpp>
#include <gale/io/synthetic.hpp>

namespace gale::io {
namespace {

using detail::refuse;

using Host = Kokkos::DefaultHostExecutionSpace;

/// A number that looks random, for any other: the noise of synthetic fields.
std::uint32_t hashed(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  return x ^ (x >> 16);
}

/// What the field has of that at a vertex.
double noise_of(Offset vertex) { return 0.05 * (hashed(static_cast<std::uint32_t>(vertex)) / 4294967296.0); }

/// Layers of vertices along z, and the layers of cubes between them.
struct Layers {
  int n;
  Offset first, count;

  Offset cubes() const { return std::max(count - 1, Offset(0)); }
  Offset vertices() const { return count * n * n; }
  Offset tetrahedra() const { return cubes() * (n - 1) * (n - 1) * tetrahedra_per_cube; }
  Offset first_vertex() const { return first * n * n; }
  Offset first_tetrahedron() const { return first * (n - 1) * (n - 1) * tetrahedra_per_cube; }
};

std::string name_of_grid(int n) { return "grid:" + std::to_string(n); }

void require_cubes(int n) {
  if (n < 2) refuse(name_of_grid(n), " has no tetrahedra: N must be at least 2");
}

void check_size(int n) {
  require_cubes(n);
  const double points = n, cubes = points - 1;
  detail::require_ids_for(name_of_grid(n) + " has", points * points * points, "vertices");
  detail::require_ids_for(name_of_grid(n) + " has", cubes * cubes * cubes * tetrahedra_per_cube, "tetrahedra");
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

/// The tetrahedra, by the numbers of vertices in the whole mesh.
template <class Index>
auto make_tetrahedra(const Layers& layers) {
  const int n = layers.n, c = n - 1;
  const auto tetrahedra = allocate<Kokkos::View<Index* [4], Kokkos::LayoutRight, Kokkos::HostSpace>>(
      "GALE::tetrahedra", layers.tetrahedra());
  const Index step[3] = {1, Index(n), Index(n) * n};
  parallel_for("GALE::make_tetrahedra", Host(), layers.cubes() * c, [&](Offset row) {
    for (int x = 0; x < c; ++x) {
      const Index lowest = static_cast<Index>(((layers.first + row / c) * n + row % c) * n + x);
      const std::size_t first = (std::size_t(row) * c + x) * tetrahedra_per_cube;
      for (int p = 0; p < tetrahedra_per_cube; ++p) {
        for (int k = 0; k < 4; ++k) {
          const int corner = freudenthal[p][k];
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
      field[i] = static_cast<float>(sine_x[x] * cosine_y[y] + sine_zx[std::size_t(z) * n + x] +
                                    noise_of(layers.first_vertex() + static_cast<Offset>(i)));
    }
  });
  return field;
}

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

/// Moves points towards the first corner: the density falls with the square of a coordinate.
void gather_points(Dataset& dataset, int n) {
  const auto& points = std::get<Dataset::Points<float>>(dataset.points);
  parallel_for("GALE::gather_points", Host(), static_cast<Offset>(points.extent(0)), [&](Offset i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double from = points(i, axis) / double(n - 1);
      points(i, axis) = static_cast<float>((n - 1) * (0.1 * from + 0.9 * from * from * from));
    }
  });
}

}  // namespace

Dataset make_grid(int n, GridCells cells) {
  check_size(n);
  const Layers all{n, 0, n};
  Dataset dataset;
  if (cells != GridCells::computed_alone) dataset.points = make_points(all);
  dataset.grid = Grid({n, n, n});
  if (cells == GridCells::written) write_out_cells(dataset);
  dataset.arrays.push_back({"field", 1, make_field(all)});
  return dataset;
}

namespace {

/// Some rows of a plane: points, if they are wanted, and the field.
Dataset make_rows(int n, const Interval& rows, bool has_points) {
  Dataset dataset;
  const Offset count = Offset(n) * rows.size();
  const auto points = allocate<Dataset::Points<float>>("GALE::points", has_points ? count : 0);
  std::vector<float> field(static_cast<std::size_t>(count));
  parallel_for("GALE::make_plane_points", Host(), rows.size(), [&](Offset row) {
    const Offset y = rows.first + row;
    const double cosine_y = std::cos(0.13 * static_cast<double>(y));
    for (int x = 0; x < n; ++x) {
      const Offset i = row * n + x;
      field[static_cast<std::size_t>(i)] =
          static_cast<float>(std::sin(0.11 * x) * cosine_y + std::sin(0.05 * x) + noise_of(y * n + x));
      if (!has_points) continue;
      points(i, 0) = static_cast<float>(x);
      points(i, 1) = static_cast<float>(y);
      points(i, 2) = 0;
    }
  });
  dataset.points = points;
  dataset.arrays.push_back({"field", 1, std::move(field)});
  return dataset;
}

std::string name_of_plane(int n) { return "plane:" + std::to_string(n); }

void require_squares(int n) {
  if (n < 2) refuse(name_of_plane(n), " has no triangles: N must be at least 2");
}

}  // namespace

Dataset make_plane(int n, GridCells cells) {
  require_squares(n);
  const double squares = n - 1.0;
  detail::require_ids_for(name_of_plane(n) + " has", 2 * squares * squares, "triangles");
  Dataset dataset = make_rows(n, {0, n}, cells != GridCells::computed_alone);
  dataset.grid = Grid({n, n, 1});
  if (cells == GridCells::written) write_out_cells(dataset);
  return dataset;
}

namespace {

void require_numbers(int n) {
  require_cubes(n);
  constexpr int most = 1625;  // its 2^32 numbers make the field's noise
  if (n > most) refuse(name_of_grid(n), " is too large: N is at most ", most);
}

}  // namespace

Dataset make_layers(const std::array<Id, 3>& of, const Interval& layers, bool has_points) {
  const int n = of[0];
  if (of[1] != n || (of[2] != n && of[2] != 1))
    refuse("no synthetic mesh has ", of[0], " x ", of[1], " x ", of[2], " points");
  const Id last = layers.first + layers.size(), all = of[2] == 1 ? of[1] : of[2];
  if (layers.first < 0 || layers.size() < 0 || last > all)
    refuse("there are no layers from ", layers.first, " up to ", last, " among ", all);
  if (of[2] == 1) {
    require_squares(n);
    constexpr int most = 65535;  // its 2^32 numbers make the field's noise
    if (n > most) refuse(name_of_plane(n), " is too large: N is at most ", most);
    return make_rows(n, layers, has_points);
  }
  require_numbers(n);
  const Layers some{n, layers.first, layers.size()};
  Dataset dataset;
  if (has_points) dataset.points = make_points(some);
  dataset.arrays.push_back({"field", 1, make_field(some)});
  return dataset;
}

template <class Index>
GridPartOf<Index> make_grid_part(int n, int part, int parts) {
  require_numbers(n);
  if (part < 0 || part >= parts) refuse("there is no part ", part, " of ", parts);
  if (sizeof(Index) < sizeof(Offset)) detail::require_ids_for(name_of_grid(n) + " has", std::pow(n, 3), "vertices");
  const Offset first = Offset(n - 1) * part / parts, last = Offset(n - 1) * (part + 1) / parts;
  const Layers layers{n, first, last > first ? last - first + 1 : 0};
  const std::string name = "part " + std::to_string(part) + " of " + name_of_grid(n);
  detail::require_ids_for(name + " has", static_cast<double>(layers.vertices()), "vertices");
  detail::require_ids_for(name + " has", static_cast<double>(layers.tetrahedra()), "tetrahedra");
  return {make_points(layers), make_field(layers), layers.first_vertex(), make_tetrahedra<Index>(layers),
          layers.first_tetrahedron()};
}

template GALE_EXPORT GridPartOf<std::int32_t> make_grid_part(int, int, int);
template GALE_EXPORT GridPartOf<std::int64_t> make_grid_part(int, int, int);

bool is_synthetic(const std::string& kind) { return kind_named(kind) != nullptr; }

Dataset make_synthetic(const std::string& kind, int n, GridCells cells) {
  const SyntheticKind* const made = kind_named(kind);
  if (made == nullptr) refuse("there is no synthetic mesh '", kind, "'");
  const std::string name = kind + ":" + std::to_string(n);
  if (n < 2) refuse(name, " has no tetrahedra: N must be at least 2");
  if (n > 1290) refuse(name, " has more vertices than the 2147483647 that 32-bit ids can number");
  Image image;
  image.dimensions = {n, n, n};
  std::vector<float> values(static_cast<std::size_t>(n) * n * n);
  const auto coordinate = [n](Offset i) { return 2.0 * static_cast<double>(i) / (n - 1) - 1; };
  parallel_for("GALE::make_synthetic", Host(), Offset(n) * n, [&](Offset row) {
    for (Offset x = 0; x < n; ++x) {
      const Offset i = row * n + x;
      const CubePoint place = {coordinate(x), coordinate(row % n), coordinate(row / n),
                               hashed(static_cast<std::uint32_t>(i)) / 4294967296.0};
      values[static_cast<std::size_t>(i)] = made->has(place) ? static_cast<float>(made->value(place)) : 0.0F;
    }
  });
  image.arrays.push_back({"field", 1, std::move(values)});
  Dataset dataset = split_voxels(std::move(image), 0, cells);
  if (kind == "dense" && cells != GridCells::computed_alone) gather_points(dataset, n);
  return dataset;
}

}  // namespace gale::io
