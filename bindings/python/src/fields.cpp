#include "fields.hpp"

#include <algorithm>

#include <gale/base/error.hpp>

namespace gale::python {

namespace {

template <class... T>
bool take(const Array1& values, io::PointArray::Values& to) {
  const auto try_one = [&](auto one) {
    using U = decltype(one);
    if (values.dtype() != nb::dtype<U>()) return false;
    const U* const from = static_cast<const U*>(values.data());
    to = std::vector<U>(from, from + values.shape(0));
    return true;
  };
  return (try_one(T()) || ...);
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
