#include <algorithm>
#include <cstddef>
#include <exception>
#include <new>
#include <type_traits>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/write.hpp>
#include <gale/io/writers/writers.hpp>

namespace gale::io {
namespace {

using detail::refuse;

void check_arrays(std::size_t count, const std::vector<PointArray>& arrays, const std::string& of = "points") {
  for (const PointArray& array : arrays) {
    const std::size_t values = std::visit([](const auto& v) { return v.size(); }, array.values);
    if (array.components > 0 && values == count * array.components) continue;
    refuse("the array '", array.name, "' has ", values, " values for ", count, " ", of, " of ", array.components,
           " components");
  }
}

std::size_t points_of(const Dataset::Positions& points) {
  return std::visit([](const auto& p) { return p.extent(0); }, points);
}

const char* cells_of(const Dataset& mesh) { return mesh.dimension() == 2 ? "triangles" : "tetrahedra"; }

/// Throws Error unless so many entries of cells are points.
void check_entries(std::size_t points, const Id* entries, Offset count) {
  const Offset wrong = reduce_min("GALE::check_cells", HostExecutionSpace(), count, count, [&](Offset k) {
    return static_cast<std::size_t>(entries[k]) < points ? count : k;  // one below 0 becomes a huge one
  });
  if (wrong != count) refuse("there is no point ", entries[wrong], " among ", points);
}

void check_cells(std::size_t points, const Surface::Cells& cells) {
  const auto end = static_cast<std::int64_t>(cells.points.size());
  if (cells.begin.empty() || cells.begin.front() != 0 || cells.begin.back() != end ||
      !std::is_sorted(cells.begin.begin(), cells.begin.end())) {
    throw Error("its cells don't begin one after the other");
  }
  check_entries(points, cells.points.data(), end);
}

/// Throws Error for a cell of a mesh that has a corner which is none of its points.
void check_corners(const Dataset& mesh) {
  if (mesh.grid) return;
  const std::size_t points = points_of(mesh.points);
  check_entries(points, mesh.tetrahedra.data(), static_cast<Offset>(mesh.tetrahedra.size()));
  check_entries(points, mesh.triangles.data(), static_cast<Offset>(mesh.triangles.size()));
}

/// Throws Error unless the file's extension is one that is written with any of these bits. `what` it is.
void require_format(const std::string& path, unsigned bits, const char* what) {
  const Format* const format = format_of(path);
  if (format != nullptr && format->takes(bits)) return;
  const auto all = detail::words_of(extensions_of([bits](const Format& other) { return other.takes(bits); }));
  refuse("cannot write ", what, " to '", path, "': its extension is ", all.size() > 1 ? "neither " : "not ",
         detail::joined(all, " nor "));
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

/// Runs `write(file)` for the file to write to, if its format is written with any of that; it appears then, unless the
/// caller commits it.
template <class Write>
void write_as(const Target& to, unsigned bits, const char* what, const Write& write) {
  require_format(to.path(), bits, what);
  name_in_errors(to.path(), [&] {
    if (to.file() != nullptr) return write(*to.file());
    AtomicFile file(to.path());
    write(file);
    file.commit();
  });
}

/// Writes it in the form that the file's extension says.
void write_content(const AtomicFile& file, const detail::XmlContent& content) {
  std::get<detail::ContentWriter*>(format_of(file.path())->writer)(file, content);
}

void write_names(const AtomicFile& file, const std::vector<std::string>& pieces, const detail::XmlContent& like) {
  name_in_errors(file.path(), [&] { detail::write_xml_pieces(file, pieces, like); });
}

}  // namespace

void write_points(const Target& to, const PointSet& points) {
  write_as(to, written_points, "points", [&](const AtomicFile& file) {
    check_arrays(points_of(points.points), points.arrays);
    write_content(file, detail::content_of(points));
  });
}

void write_surface(const Target& to, const Surface& surface) {
  write_as(to, written_surfaces, "a surface", [&](const AtomicFile& file) {
    const std::size_t points = points_of(surface.points);
    check_cells(points, surface.lines);
    check_cells(points, surface.polygons);
    check_arrays(points, surface.point_arrays);
    check_arrays(surface.lines.begin.size() + surface.polygons.begin.size() - 2, surface.cell_arrays, "cells");
    write_content(file, detail::content_of(surface));
  });
}

void write_lines(const Target& to, const Surface& lines) {
  write_as(to, written_lines, "lines", [&](const AtomicFile& file) {
    const std::size_t points = points_of(lines.points);
    check_cells(points, lines.lines);
    check_arrays(points, lines.point_arrays);
    check_arrays(lines.lines.begin.size() - 1, lines.cell_arrays, "lines");
    write_content(file, detail::content_of_lines(lines));
  });
}

void write_mesh(const Target& to, const Dataset& mesh, const std::vector<PointArray>& more) {
  const bool is_flat = mesh.dimension() == 2;
  const unsigned bits = is_flat ? written_meshes | written_triangles : written_meshes;
  write_as(to, bits, "a mesh", [&](const AtomicFile& file) {
    check_arrays(points_of(mesh.points), mesh.arrays);
    check_arrays(points_of(mesh.points), more);
    check_arrays(mesh.cells(), mesh.cell_arrays, cells_of(mesh));
    check_corners(mesh);
    const Format& format = *format_of(file.path());
    if (const auto* const write = std::get_if<detail::MeshWriter*>(&format.writer)) return (*write)(file, mesh, more);
    write_content(file, format.takes(written_meshes) ? detail::content_of(mesh, more, mesh.cell_arrays)
                                                     : detail::content_of_triangles(mesh, more, mesh.cell_arrays));
  });
}

void write_piece(const Target& to, const Dataset& piece) {
  write_as(to, written_pieces, "a piece of a mesh", [&](const AtomicFile& file) {
    check_arrays(points_of(piece.points), piece.arrays);
    check_arrays(piece.cells(), piece.cell_arrays, cells_of(piece));
    check_corners(piece);
    write_content(file, detail::content_of(piece, {}, piece.cell_arrays));
  });
}

void write_pieces(const AtomicFile& file, const std::vector<std::string>& pieces, const PointSet& like) {
  write_names(file, pieces, detail::content_of(like));
}

void write_pieces(const AtomicFile& file, const std::vector<std::string>& pieces, const Surface& like) {
  write_names(file, pieces, detail::content_of(like));
}

void write_pieces(const AtomicFile& file, const std::vector<std::string>& pieces, const Dataset& like) {
  write_names(file, pieces, detail::content_of(like, {}, like.cell_arrays));
}

void write_series(const AtomicFile& file, const std::vector<Step>& steps) {
  name_in_errors(file.path(), [&] {
    const Format* const format = format_of(file.path());
    if (format == nullptr || !format->takes(written_series))
      throw Error("a series ends with " + detail::joined(extensions_written(written_series), " or "));
    std::get<detail::SeriesWriter*>(format->writer)(file, steps);
  });
}

}  // namespace gale::io
