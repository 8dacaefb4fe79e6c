#include "numpy.hpp"

#include <gale/base/error.hpp>

namespace gale::python {

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

}  // namespace gale::python
