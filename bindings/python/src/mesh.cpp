#include "mesh.hpp"

#include <nanobind/stl/optional.h>

#include <algorithm>
#include <functional>
#include <future>
#include <limits>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/transfer.hpp>
#include <gale/mesh/grid.hpp>
#include <gale/mesh/make_mesh.hpp>
#include <gale/mesh/octree.hpp>
#include <gale/outputs/field.hpp>

#include "job.hpp"

namespace gale::python {

namespace {

/// A copy in the same memory: what is checked is what is used, whatever other threads of Python write meanwhile.
template <class View>
auto copy_of(const char* label, const View& view) {
  using Copy = typename View::non_const_type;
  const auto copy = allocate<Copy>(label, view.extent(0));
  if constexpr (is_device_memory<typename View::memory_space>) {
    Kokkos::deep_copy(copy, view);
  } else {
    constexpr int columns = View::static_extent(1);
    parallel_for(label, HostExecutionSpace(), view.extent(0), detail::CopyRow<columns, Copy, View>{copy, view});
  }
  return copy;
}

/// What use(points) makes of an array of points, a View where they lie.
template <class Use>
auto with_points(const Array1& points, const Use& use) {
  return with_type<float, double>(points, "points are neither float32 nor float64",
                                  [&](auto one) { return with_view<const decltype(one)* [3]>(points, "points", use); });
}

/// Points on the host, of which a copy is made where they are a caller's: beside what the device does, if it is begun.
class CopiedPoints {
 public:
  explicit CopiedPoints(std::function<io::Dataset::Positions()> copy) : copy_(std::move(copy)) {}

  void begin() {
    if (!points_.valid()) points_ = in_background(copy_);
  }
  io::Dataset::Positions get() {
    begin();
    return points_.get();
  }

 private:
  std::function<io::Dataset::Positions()> copy_;
  std::future<io::Dataset::Positions> points_;
};

struct SegmentedPoints {
  CopiedPoints points;
  Segmentation segmentation;
};

SegmentedPoints segmented(const Array1& points, int capacity) {
  return with_points(points, [&](const auto& view) -> SegmentedPoints {
    using View = std::decay_t<decltype(view)>;
    using Coordinate = typename View::non_const_value_type;
    if constexpr (have_device && !is_device_memory<typename View::memory_space>) {
      try {
        const Points<Coordinate, WorkerMemory> there = on_worker(view);
        CopiedPoints here([view] { return io::Dataset::Points<Coordinate>(copy_of("GALE::points", view)); });
        return {std::move(here), octree_segmentation(there, capacity)};
      } catch (const OutOfMemory&) {  // the device has no room for them
      }
    }
    const auto copy = copy_of("GALE::points", view);
    const Points<Coordinate, typename std::decay_t<decltype(copy)>::memory_space> there = copy;
    const io::Dataset::Points<Coordinate> here = on_host(copy);
    return {CopiedPoints([here] { return here; }), octree_segmentation(there, capacity)};
  });
}

/// The mesh of a caller's cells. They are copied, from the host straight to the device if that has room: a copy on the
/// host would take longer than all that follows. The copy of the points is begun when theirs is done, which takes all
/// threads.
template <int corners, class Index, class Memory>
Mesh mesh_of(const CellCorners<corners, Index, Memory>& cells, SegmentedPoints& points) {
  if constexpr (have_device && !is_device_memory<Memory>) {
    try {
      const CellCorners<corners, Index, WorkerMemory> there = on_worker(cells);
      points.points.begin();
      const Mesh mesh(there, points.segmentation);
      if (mesh.on_device()) return mesh;
    } catch (const OutOfMemory&) {  // without the caller's cells beside it, the mesh may fit
    }
  }
  const CellCorners<corners, Index, Memory> copy = copy_of("GALE::cells", cells);
  return Mesh(copy, points.segmentation);
}

template <int corners>
Mesh mesh_of(const Array1& cells, const std::string& name, SegmentedPoints& points) {
  return with_type<std::int32_t, std::int64_t>(cells, (name + " are neither int32 nor int64").c_str(), [&](auto one) {
    using Index = decltype(one);
    return with_view<const Index* [corners]>(cells, name.c_str(), [&](const auto& view) {
      return mesh_of<corners, Index, typename std::decay_t<decltype(view)>::memory_space>(view, points);
    });
  });
}

/// A copy of an array of rank 1, likewise.
template <class View>
auto copy_of_entries(const View& view) {
  const auto copy =
      allocate<Array<typename View::non_const_value_type, typename View::memory_space>>("GALE::cells", view.extent(0));
  if constexpr (is_device_memory<typename View::memory_space>) {
    Kokkos::deep_copy(copy, view);
  } else {
    parallel_for("GALE::cells", HostExecutionSpace(), view.extent(0),
                 detail::CopyEntry<std::decay_t<decltype(copy)>, View>{copy, view});
  }
  return copy;
}

struct MeshOfCells {
  Mesh mesh;
  std::optional<std::vector<Id>> cells;  ///< of tetrahedra or triangles
  std::vector<std::string> notices;
};

template <int corners, class Memory>
MeshOfCells mesh_of(const SplitCells<corners, Memory>& split, const Segmentation& segmentation) {
  const Mesh mesh(CellCorners<corners, Id, Memory>(split.simplices), segmentation);
  if (split.cells.extent(0) == 0) return {mesh, std::nullopt, split.notices};
  const auto cells = on_host(split.cells);
  return {mesh, vector_of<Id>(cells.data(), cells.extent(0)), split.notices};
}

MeshOfCells mesh_of(const Array1& connectivity, const Array1& offsets, const Array1& types,
                    const Segmentation& segmentation) {
  return with_type<std::int32_t, std::int64_t>(connectivity, "connectivity is neither int32 nor int64", [&](auto one) {
    using Index = decltype(one);
    return with_view<const Index*>(connectivity, "connectivity", [&](const auto& corners) -> MeshOfCells {
      using Memory = typename std::decay_t<decltype(corners)>::memory_space;
      const auto begin = with_view<const std::int64_t*>(offsets, "offsets", [](const auto& view) {
        return Array<const Offset, Memory>(in_memory<Memory>(copy_of_entries(view)));
      });
      const auto numbers = with_view<const std::uint8_t*>(types, "types", [](const auto& view) {
        return Array<const std::uint8_t, Memory>(in_memory<Memory>(copy_of_entries(view)));
      });
      const Cells<Index, Memory> all{numbers, begin, copy_of_entries(corners)};
      const Id vertices = segmentation.vertices();
      return highest_dimension(on_host(numbers)) == 2 ? mesh_of(split_polygons(all, vertices), segmentation)
                                                      : mesh_of(split_cells(all, vertices), segmentation);
    });
  });
}

}  // namespace

nb::tuple from_cells(Array1 points, Array1 connectivity, Array1 offsets, Array1 types, int capacity) {
  require_rows(points, 3, "points");
  if (connectivity.ndim() != 1 || offsets.ndim() != 1 || types.ndim() != 1)
    throw Error("connectivity, offsets and types have " + std::to_string(connectivity.ndim()) + ", " +
                std::to_string(offsets.ndim()) + " and " + std::to_string(types.ndim()) + " dimensions, not 1 each");
  std::optional<MeshOfCells> found;
  auto mesh = Job().run([&] {
    SegmentedPoints in_segments = segmented(points, capacity);
    found.emplace(mesh_of(connectivity, offsets, types, in_segments.segmentation));
    return std::make_unique<PyMesh>(in_segments.points.get(), found->mesh, capacity);
  });
  nb::list notices;
  for (const std::string& notice : found->notices) notices.append(text_of(notice));
  return nb::make_tuple(nb::cast(mesh.release(), nb::rv_policy::take_ownership),
                        found->cells ? numpy_of(*std::move(found->cells)) : nb::none(), notices);
}

nb::object from_grid(Array1 points, Id nx, Id ny, Id nz, int capacity) {
  require_rows(points, 3, "points");
  auto found = Job().run([&] {
    const Mesh mesh(Grid({nx, ny, nz}), capacity);
    if (static_cast<std::size_t>(mesh.vertices()) != points.shape(0))
      throw Error("there are " + std::to_string(points.shape(0)) + " points of a grid of " +
                  std::to_string(mesh.vertices()));
    return with_points(points, [&](const auto& view) {
      using Coordinate = typename std::decay_t<decltype(view)>::non_const_value_type;
      const io::Dataset::Points<Coordinate> copy = on_host(copy_of("GALE::points", view));
      detail::require_finite<Coordinate>(HostExecutionSpace(), Points<Coordinate, HostMemory>(copy));
      return std::make_unique<PyMesh>(copy, mesh, capacity);
    });
  });
  return nb::cast(found.release(), nb::rv_policy::take_ownership);
}

PyMesh::PyMesh(io::Dataset::Positions points, const Mesh& mesh, int capacity) : capacity_(capacity), mesh_(mesh) {
  dataset_.points = std::move(points);
}

PyMesh::PyMesh(Array1 points, Array1 cells, int capacity) : capacity_(capacity) {
  require_rows(points, 3, "points");
  const bool are_triangles = cells.ndim() == 2 && cells.shape(1) == 3;
  if (!are_triangles) require_rows(cells, 4, "tetrahedra");
  mesh_ = Job().run([&] {
    SegmentedPoints found = segmented(points, capacity);
    const Mesh mesh = are_triangles ? mesh_of<3>(cells, "triangles", found) : mesh_of<4>(cells, "tetrahedra", found);
    dataset_.points = found.points.get();
    return mesh;
  });
}

PyMesh::PyMesh(const io::Dataset& dataset, int capacity, const PyMesh* like) : capacity_(capacity) {
  dataset_.points = dataset.points;
  if (like != nullptr && outputs::is_mesh_of(like->mesh(), dataset)) {
    mesh_ = like->mesh();
    return;
  }
  if (dataset.grid) {
    mesh_ = Mesh(*dataset.grid, capacity);
    return;
  }
  mesh_ = std::visit(
      [&](const auto& points) {
        return dataset.dimension() == 3 ? make_mesh(points, dataset.tetrahedra, capacity)
                                        : make_mesh(points, dataset.triangles, capacity);
      },
      dataset.points);
}

const Mesh& PyMesh::mesh() const {
  if (!mesh_) throw Error("gale has ended with the interpreter");
  return *mesh_;
}

nb::object PyMesh::points() const {
  mesh();
  return std::visit(
      [](const auto& xyz) {
        using Coordinate = typename std::decay_t<decltype(xyz)>::value_type;
        return numpy_of(Job().run([&] { return vector_of<Coordinate>(xyz.data(), 3 * xyz.extent(0)); }), 3);
      },
      dataset_.points);
}

nb::object PyMesh::cubes() const {
  const Grid* const grid = mesh().grid();
  if (grid == nullptr) return nb::none();
  const GridView view = grid->in<HostMemory>();
  const Offset along_x = view.nx - 1, layer = view.dimension == 3 ? along_x * (view.ny - 1) : 0;
  const auto cubes_as = [&](auto number) {
    return numpy_of(Job().run([&] {
      std::vector<decltype(number)> cubes(grid->cells());
      parallel_for("GALE::cubes_of_cells", HostExecutionSpace(), grid->cells(), [&](Offset t) {
        const auto at = view.place_of_cube(static_cast<Id>(t) / view.cells_per_cube());
        cubes[t] = static_cast<decltype(number)>(at.x + along_x * at.y + layer * at.z);
      });
      return cubes;
    }));
  };
  const bool is_small = layer <= std::numeric_limits<Id>::max() / view.nz;
  return is_small ? cubes_as(Id()) : cubes_as(std::int64_t());
}

io::Dataset PyMesh::with(io::PointArray field) const {
  io::Dataset dataset;
  dataset.points = std::visit(
      [](const auto& points) -> io::Dataset::Positions {
        return std::decay_t<decltype(points)>(points.data(),
                                              points.extent(0));  // no count, which several jobs may change
      },
      dataset_.points);
  dataset.arrays.push_back(std::move(field));
  return dataset;
}

nb::list steps_of(const std::vector<nb::bytes>& inputs, bool outside_files) {
  io::ReadOptions options;
  options.outside_files = outside_files;
  std::vector<std::string> paths;
  for (const nb::bytes& input : inputs) paths.emplace_back(input.c_str(), input.size());
  const std::vector<io::Step> steps = Job().run([&] { return io::steps_of(paths, options); });
  nb::list all;
  for (const io::Step& step : steps)
    all.append(nb::make_tuple(step.time, nb::bytes(step.file.data(), step.file.size()), step.at));
  return all;
}

nb::tuple read(const nb::bytes& path, std::optional<double> above, const std::string& array, bool tetrahedra_alone,
               bool outside_files, int capacity, const PyMesh* like, std::optional<std::uint64_t> time) {
  const std::string place(path.c_str(), path.size());
  io::ReadOptions options;
  options.above = above;
  options.array = array;
  options.simplices_alone = tetrahedra_alone;
  options.outside_files = outside_files;
  options.time = time;
  options.grids = io::GridCells::computed;
  io::Dataset dataset;
  auto mesh = Job().run([&] {
    dataset = io::read(place, options);
    return std::make_unique<PyMesh>(dataset, capacity, like);
  });
  nb::list notices;
  for (const std::string& notice : dataset.notices) notices.append(text_of(notice));
  nb::dict cell_arrays = numpy_of(std::move(dataset.cell_arrays));
  return nb::make_tuple(nb::cast(mesh.release(), nb::rv_policy::take_ownership), numpy_of(std::move(dataset.arrays)),
                        cell_arrays, notices);
}

}  // namespace gale::python
