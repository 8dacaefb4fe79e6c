#include "mesh.hpp"

#include <limits>

#include <gale/base/error.hpp>
#include <gale/mesh/make_mesh.hpp>

namespace gale::python {

namespace {

template <class T>
bool is(const Array1& array) {
  return array.dtype() == nb::dtype<T>();
}

void require_rows(const Array1& array, std::size_t width, const char* name) {
  if (array.ndim() == 2 && array.shape(1) == width) return;
  std::string shape;
  for (std::size_t d = 0; d < array.ndim(); ++d) shape += (d > 0 ? ", " : "") + std::to_string(array.shape(d));
  throw Error(std::string(name) + " has the shape (" + shape + "), not (n, " + std::to_string(width) + ")");
}

/// Numpy's memory as the dataset's points.
template <class Coordinate>
io::Dataset::Points<Coordinate> view_of(const Array1& points) {
  return io::Dataset::Points<Coordinate>(static_cast<Coordinate*>(const_cast<void*>(points.data())), points.shape(0));
}

io::Dataset::Positions positions_of(const Array1& points) {
  require_rows(points, 3, "points");
  if (is<float>(points)) return view_of<float>(points);
  if (is<double>(points)) return view_of<double>(points);
  throw Error("points are neither float32 nor float64");
}

template <class Index>
Mesh mesh_of(const io::Dataset::Positions& points, const Index* corners, std::size_t count, int capacity) {
  const Tetrahedra<Index, HostMemory> tetrahedra(corners, count);
  return std::visit([&](const auto& xyz) { return make_mesh(xyz, tetrahedra, capacity); }, points);
}

}  // namespace

PyMesh::PyMesh(Array1 points, Array1 tetrahedra, int capacity) : points_owner_(nb::cast(points)) {
  require_rows(tetrahedra, 4, "tetrahedra");
  dataset_.points = positions_of(points);
  const Call call;
  if (is<std::int32_t>(tetrahedra)) {
    mesh_ =
        mesh_of(dataset_.points, static_cast<const std::int32_t*>(tetrahedra.data()), tetrahedra.shape(0), capacity);
  } else if (is<std::int64_t>(tetrahedra)) {
    mesh_ =
        mesh_of(dataset_.points, static_cast<const std::int64_t*>(tetrahedra.data()), tetrahedra.shape(0), capacity);
  } else {
    throw Error("tetrahedra are neither int32 nor int64");
  }
}

PyMesh::PyMesh(io::Dataset& dataset, int capacity) {
  dataset_.points = dataset.points;
  mesh_ = mesh_of(dataset_.points, dataset.tetrahedra.data(), dataset.tetrahedra.extent(0), capacity);
}

const Mesh& PyMesh::mesh() const {
  if (!mesh_) throw Error("gale has ended with the interpreter");
  return *mesh_;
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
  return nb::make_tuple(nb::cast(mesh.release(), nb::rv_policy::take_ownership), numpy_of(std::move(dataset.arrays)));
}

}  // namespace gale::python
