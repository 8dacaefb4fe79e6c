#include "mesh.hpp"

#include <algorithm>

#include <gale/base/error.hpp>
#include <gale/mesh/make_mesh.hpp>

#include "job.hpp"

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

struct SegmentedPoints {
  io::Dataset::Positions points;
  Segmentation segmentation;
};

SegmentedPoints segmented(const Array1& points, int capacity) {
  return with_type<float, double>(points, "points are neither float32 nor float64", [&](auto one) {
    using Coordinate = decltype(one);
    return with_view<const Coordinate* [3]>(points, "points", [&](const auto& view) -> SegmentedPoints {
      const auto copy = copy_of("GALE::points", view);
      const Points<Coordinate, typename std::decay_t<decltype(copy)>::memory_space> read_only = copy;
      const io::Dataset::Points<Coordinate> on_host = Kokkos::create_mirror_view_and_copy(HostMemory(), copy);
      return {on_host, octree_segmentation(read_only, capacity)};
    });
  });
}

Mesh mesh_of(const Array1& tetrahedra, const Segmentation& segmentation) {
  return with_type<std::int32_t, std::int64_t>(tetrahedra, "tetrahedra are neither int32 nor int64", [&](auto one) {
    using Index = decltype(one);
    return with_view<const Index* [4]>(tetrahedra, "tetrahedra", [&](const auto& view) {
      const Tetrahedra<Index, typename std::decay_t<decltype(view)>::memory_space> copy =
          copy_of("GALE::tetrahedra", view);
      return Mesh(copy, segmentation);
    });
  });
}

}  // namespace

PyMesh::PyMesh(Array1 points, Array1 tetrahedra, int capacity) : capacity_(capacity) {
  require_rows(points, 3, "points");
  require_rows(tetrahedra, 4, "tetrahedra");
  mesh_ = Job().run([&] {
    const SegmentedPoints found = segmented(points, capacity);
    dataset_.points = found.points;
    return mesh_of(tetrahedra, found.segmentation);
  });
}

PyMesh::PyMesh(io::Dataset& dataset, int capacity) : capacity_(capacity) {
  dataset_.points = dataset.points;
  mesh_ =
      std::visit([&](const auto& points) { return make_mesh(points, dataset.tetrahedra, capacity); }, dataset.points);
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

io::Dataset PyMesh::with(const io::PointArray& field) const {
  io::Dataset dataset;
  dataset.points = dataset_.points;
  dataset.arrays = {field};
  return dataset;
}

nb::tuple read(const nb::bytes& path, std::optional<double> above, const std::string& array, bool tetrahedralize,
               bool outside_files, int capacity) {
  const std::string place(path.c_str(), path.size());
  io::ReadOptions options;
  options.above = above;
  options.array = array;
  options.tetrahedralize = tetrahedralize;
  options.outside_files = outside_files;
  io::Dataset dataset;
  auto mesh = Job().run([&] {
    dataset = io::read(place, options);
    return std::make_unique<PyMesh>(dataset, capacity);
  });
  nb::list notices;
  for (const std::string& notice : dataset.notices) notices.append(text_of(notice));
  return nb::make_tuple(nb::cast(mesh.release(), nb::rv_policy::take_ownership), numpy_of(std::move(dataset.arrays)),
                        notices);
}

}  // namespace gale::python
