#include "fields.hpp"

#include <algorithm>

#include <gale/base/error.hpp>

namespace gale::python {

namespace {

template <class T>
std::vector<T> copy_of(const Array1& values) {
  return with_view<const T*>(values, "the field", [](const auto& view) {
    if constexpr (is_device_memory<typename std::decay_t<decltype(view)>::memory_space>) {
      std::vector<T> copy(view.extent(0));
      Kokkos::deep_copy(Kokkos::View<T*, Kokkos::LayoutRight, HostMemory>(copy.data(), copy.size()), view);
      return copy;
    } else {
      return vector_of<T>(view.data(), view.extent(0));
    }
  });
}

template <class... T>
bool take(const Array1& values, io::PointArray::Values& to) {
  return ((is<T>(values) && (to = copy_of<T>(values), true)) || ...);
}

}  // namespace

io::PointArray field_of(const Array1& values, const std::string& name) {
  if (values.ndim() != 1) throw Error("the field has " + std::to_string(values.ndim()) + " dimensions, not 1");
  io::PointArray field{name, 1, {}};
  if (!take<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t, std::int64_t,
            std::uint64_t, float, double>(values, field.values))
    throw Error("the field has values of a type that isn't read");
  return field;
}

VertexOrder order_of(const Mesh& mesh, const io::PointArray& field) {
  return std::visit([&](const auto& values) { return VertexOrder(mesh, values.data(), values.size()); }, field.values);
}

}  // namespace gale::python
