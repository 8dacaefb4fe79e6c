#include "numpy.hpp"

namespace gale::python {

nb::object numpy_of(const io::Dataset::Positions& points) {
  return std::visit(
      [](const auto& xyz) {
        using T = typename std::decay_t<decltype(xyz)>::value_type;
        return numpy_of(std::vector<T>(xyz.data(), xyz.data() + 3 * xyz.extent(0)), 3);
      },
      points);
}

nb::dict numpy_of(std::vector<io::PointArray> arrays) {
  nb::dict named;
  for (io::PointArray& array : arrays) {
    const auto width = static_cast<std::size_t>(array.components);
    named[nb::str(array.name.c_str())] =
        std::visit([&](auto& values) { return numpy_of(std::move(values), width); }, array.values);
  }
  return named;
}

nb::tuple numpy_of(io::PointSet set) { return nb::make_tuple(numpy_of(set.points), numpy_of(std::move(set.arrays))); }

nb::tuple numpy_of(io::Surface surface) {
  io::Surface::Cells& cells = surface.lines.points.empty() ? surface.polygons : surface.lines;
  return nb::make_tuple(numpy_of(surface.points), numpy_of(std::move(surface.point_arrays)),
                        numpy_of(std::move(cells.begin)), numpy_of(std::move(cells.points)),
                        numpy_of(std::move(surface.cell_arrays)));
}

}  // namespace gale::python
