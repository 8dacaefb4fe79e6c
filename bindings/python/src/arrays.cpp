#include "arrays.hpp"

#include <algorithm>

#include <gale/base/error.hpp>
#include <gale/base/transfer.hpp>

namespace gale::python {

void require_rows(const Array1& array, std::size_t width, const char* name) {
  if (array.ndim() == 2 && array.shape(1) == width) return;
  std::string shape;
  for (std::size_t d = 0; d < array.ndim(); ++d) shape += (d > 0 ? ", " : "") + std::to_string(array.shape(d));
  throw Error(std::string(name) + " has the shape (" + shape + "), not (n, " + std::to_string(width) + ")");
}

bool is_on_device(const Array1& array, const char* name) {
  const int type = array.device_type();
  if (type == nb::device::cpu::value || type == nb::device::cuda_host::value) return false;
  const bool is_cuda = type == nb::device::cuda::value || type == nb::device::cuda_managed::value;
  const std::string where = is_cuda ? "a CUDA device" : "a device of DLPack's type " + std::to_string(type);
  if (is_cuda && device_is_cuda) {
    Kokkos::fence();
    return true;
  }
  throw Error(std::string(name) + " is in the memory of " + where +
              (device_is_cuda ? ", which this gale can't read"
                              : ", and this gale was built without CUDA: copy it to the host first"));
}

nb::ndarray<> device_array(std::uintptr_t data, const std::vector<std::size_t>& shape, char type, int bytes,
                           const nb::object& owner) {
  using Code = nb::dlpack::dtype_code;
  const Code code = type == 'f' ? Code::Float : type == 'i' ? Code::Int : Code::UInt;
  const nb::dlpack::dtype dtype{static_cast<std::uint8_t>(code), static_cast<std::uint8_t>(8 * bytes), 1};
  return nb::ndarray<>(reinterpret_cast<void*>(data), shape.size(), shape.data(), owner, nullptr, dtype,
                       nb::device::cuda::value);
}

nb::str text_of(std::string_view bytes) {
  PyObject* const text = PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "backslashreplace");
  if (text == nullptr) throw nb::python_error();
  return nb::steal<nb::str>(text);
}

nb::object numpy_of(const io::Dataset::Positions& points) {
  return std::visit(
      [](const auto& xyz) {
        using T = typename std::decay_t<decltype(xyz)>::value_type;
        return numpy_of(std::vector<T>(xyz.data(), xyz.data() + 3 * xyz.extent(0)), 3);
      },
      points);
}

namespace {

nb::object values_of(io::PointArray& array) {
  const auto width = static_cast<std::size_t>(array.components);
  return std::visit([&](auto& values) { return numpy_of(std::move(values), width); }, array.values);
}

}  // namespace

nb::dict numpy_of(std::vector<io::PointArray> arrays) {
  nb::dict named;
  for (io::PointArray& array : arrays) named[text_of(array.name)] = values_of(array);
  return named;
}

nb::dict numpy_of_result(std::vector<io::PointArray> arrays) {
  nb::dict named;
  for (io::PointArray& array : arrays) {
    const nb::str name = text_of(array.name);
    if (named.contains(name))
      throw Error("the field can't be named '" + array.name + "': another array of the result is");
    auto* const flags = array.name == "IsOnBoundary" ? std::get_if<std::vector<std::int8_t>>(&array.values) : nullptr;
    named[name] = flags != nullptr ? flags_of(std::move(*flags)) : values_of(array);
  }
  return named;
}

nb::tuple numpy_of(io::PointSet set) {
  return nb::make_tuple(numpy_of(set.points), numpy_of_result(std::move(set.arrays)));
}

nb::tuple numpy_of(io::Surface surface) {
  io::Surface::Cells& cells = surface.lines.points.empty() ? surface.polygons : surface.lines;
  return nb::make_tuple(numpy_of(surface.points), numpy_of_result(std::move(surface.point_arrays)),
                        numpy_of(std::move(cells.begin)), numpy_of(std::move(cells.points)),
                        numpy_of_result(std::move(surface.cell_arrays)));
}

namespace {

template <class T>
std::vector<T> copy_of(const Array1& values) {
  return with_view<const T*>(values, "the field", [](const auto& view) {
    if constexpr (is_device_memory<typename std::decay_t<decltype(view)>::memory_space>) {
      std::vector<T> copy;
      reserve(copy, view.extent(0));
      copy.resize(view.extent(0));
      copy_from_device(copy.data(), view.data(), copy.size() * sizeof(T));
      return copy;
    } else {
      return vector_of<T>(view.data(), view.extent(0));
    }
  });
}

/// What `use(one)` returns, where `one` is of the type of the field's values. `what` they are in errors.
template <class Use>
auto with_type_of_field(const Array1& values, const std::string& what, const Use& use) {
  if (values.ndim() != 1) throw Error(what + " has " + std::to_string(values.ndim()) + " dimensions, not 1");
  return with_type<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t, std::int64_t,
                   std::uint64_t, float, double>(values, (what + " has values of a type that isn't read").c_str(), use);
}

}  // namespace

io::PointArray field_of(const Array1& values, const std::string& name, const std::string& what) {
  return {name, 1, with_type_of_field(values, what, [&](auto one) {
            return io::PointArray::Values(copy_of<decltype(one)>(values));
          })};
}

VertexOrder order_of(const Mesh& mesh, const Array1& values) {
  return with_type_of_field(values, "the field", [&](auto one) {
    return with_view<const decltype(one)*>(values, "the field",
                                           [&](const auto& view) { return VertexOrder(mesh, view); });
  });
}

VertexOrder order_of(const Mesh& mesh, const io::PointArray& field) {
  return std::visit([&](const auto& values) { return VertexOrder(mesh, values.data(), values.size()); }, field.values);
}

}  // namespace gale::python
