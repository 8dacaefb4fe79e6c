#include "mesh.hpp"

#include <algorithm>

#include <gale/base/error.hpp>
#include <gale/mesh/input_numbers.hpp>
#include <gale/mesh/make_mesh.hpp>

namespace gale::python {

namespace {

/// What `use(one)` returns, where `one` is of the array's type: one of T.
template <class... T, class Use>
auto with_type(const Array1& array, const char* refusal, const Use& use) {
  using Result = std::common_type_t<decltype(use(T()))...>;
  std::optional<Result> result;
  const auto try_one = [&](auto one) {
    if (!is<decltype(one)>(array)) return false;
    result = use(one);
    return true;
  };
  if (!(try_one(T()) || ...)) throw Error(refusal);
  return *std::move(result);
}

/// The points on the host: where they are, or a copy if a device has them.
io::Dataset::Positions positions_of(const Array1& points) {
  return with_type<float, double>(
      points, "points are neither float32 nor float64", [&](auto one) -> io::Dataset::Positions {
        using Coordinate = decltype(one);
        using Kept = io::Dataset::Points<Coordinate>;
        return with_view<const Coordinate* [3]>(points, "points", [](const auto& view) {
          if constexpr (is_device_memory<typename std::decay_t<decltype(view)>::memory_space>) {
            const Kept copy("GALE::points", view.extent(0));
            Kokkos::deep_copy(copy, view);
            return copy;
          } else {
            return Kept(const_cast<Coordinate*>(view.data()), view.extent(0));
          }
        });
      });
}

Segmentation segmentation_of(const Array1& points, int capacity) {
  return with_type<float, double>(points, "points are neither float32 nor float64", [&](auto one) {
    return with_view<const decltype(one)* [3]>(points, "points",
                                               [&](const auto& view) { return octree_segmentation(view, capacity); });
  });
}

Mesh mesh_of(const Array1& tetrahedra, const Segmentation& segmentation) {
  return with_type<std::int32_t, std::int64_t>(tetrahedra, "tetrahedra are neither int32 nor int64", [&](auto one) {
    return with_view<const decltype(one)* [4]>(tetrahedra, "tetrahedra",
                                               [&](const auto& view) { return Mesh(view, segmentation); });
  });
}

}  // namespace

PyMesh::PyMesh(Array1 points, Array1 tetrahedra, int capacity) : points_(points) {
  require_rows(points, 3, "points");
  require_rows(tetrahedra, 4, "tetrahedra");
  const Call call;
  dataset_.points = positions_of(points);
  mesh_ = mesh_of(tetrahedra, segmentation_of(points, capacity));
}

PyMesh::PyMesh(io::Dataset& dataset, int capacity) {
  dataset_.points = dataset.points;
  mesh_ =
      std::visit([&](const auto& points) { return make_mesh(points, dataset.tetrahedra, capacity); }, dataset.points);
}

const Mesh& PyMesh::mesh() const {
  if (!mesh_) throw Error("gale has ended with the interpreter");
  return *mesh_;
}

std::array<const Id*, 2> PyMesh::numbers(int one, int other) const {
  const std::lock_guard<std::mutex> lock(numbers_mutex_);
  const auto missing = [&](int dimension) { return numbers_[dimension].data() == nullptr; };
  if (std::min(one, other) == 1 && std::max(one, other) == 2 && missing(1) && missing(2)) {
    const InputNumbers both = input_numbers(mesh());
    numbers_[1] = both.edges;
    numbers_[2] = both.triangles;
  }
  for (const int dimension : {one, other}) {
    if (missing(dimension)) numbers_[dimension] = input_numbers(mesh(), dimension);
  }
  return {numbers_[one].data(), numbers_[other].data()};
}

nb::object PyMesh::points() const {
  mesh();
  return numpy_of(dataset_.points);
}

io::Dataset PyMesh::with(const io::PointArray& field) const {
  io::Dataset dataset;
  dataset.points = dataset_.points;
  dataset.arrays = {field};
  return dataset;
}

nb::tuple read(const std::string& path, std::optional<double> above, const std::string& array, bool tetrahedralize,
               bool outside_files, int capacity) {
  std::unique_ptr<PyMesh> mesh;
  io::Dataset dataset;
  {
    const Call call;
    io::ReadOptions options;
    options.above = above;
    options.array = array;
    options.tetrahedralize = tetrahedralize;
    options.outside_files = outside_files;
    dataset = io::read(path, options);
    mesh = std::make_unique<PyMesh>(dataset, capacity);
  }
  for (const std::string& notice : dataset.notices) {
    constexpr int of_the_caller = 2;
    if (PyErr_WarnEx(PyExc_UserWarning, (path + ": " + notice).c_str(), of_the_caller) != 0) throw nb::python_error();
  }
  return nb::make_tuple(nb::cast(mesh.release(), nb::rv_policy::take_ownership), numpy_of(std::move(dataset.arrays)));
}

}  // namespace gale::python
