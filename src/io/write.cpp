#include <algorithm>
#include <cstddef>
#include <exception>
#include <initializer_list>
#include <new>

#include <gale/base/error.hpp>
#include <gale/io/arrays.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/write.hpp>
#include <gale/io/writers/writers.hpp>

namespace gale::io {
namespace {

using detail::Format;

void check_arrays(std::size_t count, const std::vector<PointArray>& arrays, const std::string& of = "points") {
  for (const PointArray& array : arrays) {
    const std::size_t values = std::visit([](const auto& v) { return v.size(); }, array.values);
    if (array.components > 0 && values == count * array.components) continue;
    throw Error("the array '" + array.name + "' has " + std::to_string(values) + " values for " +
                std::to_string(count) + " " + of + " of " + std::to_string(array.components) + " components");
  }
}

std::size_t size_of(const Dataset::Positions& points) {
  return std::visit([](const auto& p) { return p.extent(0); }, points);
}

void check_cells(std::size_t points, const Surface::Cells& cells) {
  const auto end = static_cast<std::int64_t>(cells.points.size());
  if (cells.begin.empty() || cells.begin.front() != 0 || cells.begin.back() != end ||
      !std::is_sorted(cells.begin.begin(), cells.begin.end())) {
    throw Error("its cells don't begin one after the other");
  }
  for (const std::int32_t point : cells.points) {
    if (point < 0 || static_cast<std::size_t>(point) >= points) {
      throw Error("there is no point " + std::to_string(point) + " among " + std::to_string(points));
    }
  }
}

void require_format(const std::string& path, const std::string& what, std::initializer_list<Format> formats,
                    const std::string& rule) {
  const auto format = detail::format_of(path);
  if (format && std::find(formats.begin(), formats.end(), *format) != formats.end()) return;
  throw Error("cannot write " + what + " to '" + path + "': its extension is " + rule);
}

void require_points(const std::string& path) { require_format(path, "points", {Format::vtp}, "not .vtp"); }
void require_surface(const std::string& path) { require_format(path, "a surface", {Format::vtp}, "not .vtp"); }
void require_mesh(const std::string& path) {
  require_format(path, "a mesh", {Format::vtu, Format::vtk}, "neither .vtu nor .vtk");
}

/// Runs `write`; names `path` in whatever goes wrong.
template <class Write>
void name_in_errors(const std::string& path, const Write& write) {
  try {
    write();
  } catch (const std::bad_alloc&) {
    throw OutOfMemory("there is none left to write '" + path + "'");
  } catch (const std::exception& error) {
    refuse_to_write(path, error.what());
  }
}

/// Runs `write(file)` and makes its file appear as `path`.
template <class Write>
void write_file(const std::string& path, const Write& write) {
  name_in_errors(path, [&] {
    AtomicFile file(path);
    write(file);
    file.commit();
  });
}

void write_temporary(const AtomicFile& file, const PointSet& points) {
  check_arrays(size_of(points.points), points.arrays);
  detail::write_vtp(file, points);
}

void write_temporary(const AtomicFile& file, const Surface& surface) {
  const std::size_t points = size_of(surface.points);
  check_cells(points, surface.lines);
  check_cells(points, surface.polygons);
  check_arrays(points, surface.point_arrays);
  check_arrays(surface.lines.begin.size() + surface.polygons.begin.size() - 2, surface.cell_arrays, "cells");
  detail::write_vtp(file, surface);
}

void write_temporary(const AtomicFile& file, const Dataset& mesh, const std::vector<PointArray>& more) {
  check_arrays(size_of(mesh.points), mesh.arrays);
  check_arrays(size_of(mesh.points), more);
  if (detail::format_of(file.path()) == Format::vtu) {
    detail::write_vtu(file, mesh, more);
  } else {
    detail::write_legacy_vtk(file.temporary(), mesh, more);
  }
}

}  // namespace

void write_points(const std::string& path, const PointSet& points) {
  require_points(path);
  write_file(path, [&](const AtomicFile& file) { write_temporary(file, points); });
}

void write_points(const AtomicFile& file, const PointSet& points) {
  require_points(file.path());
  name_in_errors(file.path(), [&] { write_temporary(file, points); });
}

void write_pieces(const AtomicFile& file, const std::vector<std::string>& pieces, const PointSet& like) {
  name_in_errors(file.path(), [&] { detail::write_pvtp(file.temporary(), pieces, like); });
}

void write_pieces(const AtomicFile& file, const std::vector<std::string>& pieces, const Surface& like) {
  name_in_errors(file.path(), [&] { detail::write_pvtp(file.temporary(), pieces, like); });
}

void write_pieces(const AtomicFile& file, const std::vector<std::string>& pieces, const MeshPiece& like) {
  name_in_errors(file.path(), [&] { detail::write_pvtu(file.temporary(), pieces, like); });
}

void write_piece(const AtomicFile& file, const MeshPiece& piece) {
  require_format(file.path(), "a piece of a mesh", {Format::vtu}, "not .vtu");
  name_in_errors(file.path(), [&] {
    check_arrays(size_of(piece.mesh.points), piece.mesh.arrays);
    check_arrays(piece.mesh.tetrahedra.extent(0), piece.cell_arrays, "tetrahedra");
    detail::write_vtu(file, piece.mesh, {}, piece.cell_arrays);
  });
}

void write_surface(const std::string& path, const Surface& surface) {
  require_surface(path);
  write_file(path, [&](const AtomicFile& file) { write_temporary(file, surface); });
}

void write_surface(const AtomicFile& file, const Surface& surface) {
  require_surface(file.path());
  name_in_errors(file.path(), [&] { write_temporary(file, surface); });
}

void write_mesh(const std::string& path, const Dataset& mesh, const std::vector<PointArray>& more) {
  require_mesh(path);
  write_file(path, [&](const AtomicFile& file) { write_temporary(file, mesh, more); });
}

void write_mesh(const AtomicFile& file, const Dataset& mesh, const std::vector<PointArray>& more) {
  require_mesh(file.path());
  name_in_errors(file.path(), [&] { write_temporary(file, mesh, more); });
}

void write_lines(const AtomicFile& file, const Surface& lines) {
  require_format(file.path(), "lines", {Format::vtu}, "not .vtu");
  name_in_errors(file.path(), [&] {
    const std::size_t points = size_of(lines.points);
    check_cells(points, lines.lines);
    check_arrays(points, lines.point_arrays);
    check_arrays(lines.lines.begin.size() - 1, lines.cell_arrays, "lines");
    detail::write_vtu(file, lines);
  });
}

}  // namespace gale::io
