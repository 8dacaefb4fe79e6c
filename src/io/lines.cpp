#include <exception>
#include <new>

#include <gale/base/error.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/lines.hpp>
#include <gale/io/vtk/vtk_files.hpp>

namespace gale::io {

namespace {

void check_arrays(std::size_t count, const std::vector<PointArray>& arrays, const std::string& of) {
  for (const PointArray& array : arrays) {
    const std::size_t values = std::visit([](const auto& v) { return v.size(); }, array.values);
    if (array.components > 0 && values == count * array.components) continue;
    throw Error("the array '" + array.name + "' has " + std::to_string(values) + " values for " +
                std::to_string(count) + " " + of + " of " + std::to_string(array.components) + " components");
  }
}

}  // namespace

void write_lines(const AtomicFile& file, const Surface& lines) {
  const std::string& path = file.path();
  if (detail::format_of(path) != detail::Format::vtu)
    throw Error("cannot write lines to '" + path + "': its extension is not .vtu");
  if (!detail::has_vtk()) throw Error("this gale was built without VTK: it cannot write '" + path + "'");
  try {
    check_arrays(std::visit([](const auto& points) { return points.extent(0); }, lines.points), lines.point_arrays,
                 "points");
    check_arrays(lines.lines.begin.size() - 1, lines.cell_arrays, "lines");
    detail::write_lines_with_vtk(file.temporary(), lines);
  } catch (const std::bad_alloc&) {
    throw OutOfMemory("there is none left to write '" + path + "'");
  } catch (const std::exception& error) {
    refuse_to_write(path, error.what());
  }
}

}  // namespace gale::io
