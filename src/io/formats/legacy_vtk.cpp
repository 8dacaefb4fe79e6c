#include <cmath>
#include <limits>

#include <gale/io/bytes/text.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/cells/surface_cells.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/legacy_file.hpp>
#include <gale/io/formats/volume.hpp>

namespace gale::io::detail {
namespace {

/// The sections that a file of any kind may have, as far as it does.
struct Sections {
  MeshParts mesh;
  std::vector<std::int64_t> dimensions;
  std::vector<double> origin{0, 0, 0}, spacing{1, 1, 1};
  std::array<PointArray::Values, 3> coordinates;
  std::int64_t points = 0;
  SurfaceCells surface;
  std::vector<std::string> cell_arrays;
};

/// Reads cells before version 5: for each how many points it has, and those.
CellsOfKind read_old_cells(LegacyFile& file) {
  const std::int64_t cells = file.count("the number of cells");
  const std::int64_t size = file.count("the size of the cells");
  std::vector<std::int32_t> all = file.integers(static_cast<std::uint64_t>(size));
  std::vector<std::int64_t> ends;
  std::size_t from = 0, end = 0;
  while (from < all.size()) {
    const auto points = static_cast<std::size_t>(all[from++]);  // below 0 becomes a huge one
    if (points > all.size() - from) damaged("cell ", ends.size(), " has ", all[from - 1], " points, more than follow");
    for (std::size_t k = 0; k < points; ++k) all[end++] = all[from++];
    ends.push_back(static_cast<std::int64_t>(end));
  }
  if (ends.size() != static_cast<std::size_t>(cells)) damaged("it has ", ends.size(), " cells, not ", cells);
  all.resize(end);
  return {std::move(all), std::move(ends)};
}

/// Reads cells from version 5 on: where each begins, and the end.
CellsOfKind read_new_cells(LegacyFile& file) {
  const std::int64_t offsets = file.count("the number of offsets");
  const std::int64_t size = file.count("the size of the connectivity");
  if (offsets < 1) return {};
  if (file.keyword() != "offsets") damaged("no OFFSETS follow CELLS");
  auto begins = file.array_of_numbers(static_cast<std::uint64_t>(offsets), "the offsets of its cells");
  if (file.keyword() != "connectivity") damaged("no CONNECTIVITY follows OFFSETS");
  auto connectivity = file.array_of_numbers(static_cast<std::uint64_t>(size), "the points of its cells");
  std::visit(
      [](auto& v) {
        if (v.front() != 0) damaged("the first offset of its cells is ", v.front());
        v.erase(v.begin());
      },
      begins);
  return {std::move(connectivity), std::move(begins)};
}

CellsOfKind read_cells(LegacyFile& file) {
  return file.major_version() >= 5 ? read_new_cells(file) : read_old_cells(file);
}

/// Reads a section of the cells of a surface, whose keyword was read. False for a keyword that begins none.
bool read_surface_cells(LegacyFile& file, const std::string& keyword, SurfaceCells& to) {
  if (keyword == "vertices" || keyword == "lines") {
    to.below += count_of(read_cells(file).ends);
  } else if (keyword == "polygons") {
    to.polygons = read_cells(file);
  } else if (keyword == "triangle_strips") {
    to.strips = read_cells(file);
  } else {
    return false;
  }
  return true;
}

std::uint64_t grid_points(const Sections& from) {
  return product({from.dimensions[0], from.dimensions[1], from.dimensions[2]}, "dimensions");
}

/// Reads sections up to the end of the file. False for a keyword that begins none.
bool read_section(LegacyFile& file, const std::string& kind, std::string& keyword, Sections& to) {
  if (keyword == "point_data" || keyword == "cell_data") {
    const bool of_points = keyword == "point_data";
    const std::int64_t count = file.count(of_points ? "POINT_DATA" : "CELL_DATA");
    if (of_points && count != to.points) damaged("POINT_DATA of ", count, " for ", to.points, " points");
    LegacyAttributes found;
    do {
      keyword = file.keyword();
    } while (read_attribute(file, keyword, static_cast<std::uint64_t>(count), found));
    if (of_points) {
      to.mesh.arrays = std::move(found.arrays);
      to.mesh.notices = std::move(found.left_out);
    } else {
      to.cell_arrays.insert(to.cell_arrays.end(), found.names.begin(), found.names.end());
    }
    return true;
  }
  if (keyword == "field") {
    LegacyAttributes unused;
    read_field(file, nullptr, unused);
  } else if (keyword == "dimensions") {
    to.dimensions.clear();
    for (int d = 0; d < 3; ++d) to.dimensions.push_back(file.count("DIMENSIONS"));
    to.points = static_cast<std::int64_t>(grid_points(to));  // a structured grid counts its own, which follow
  } else if (keyword == "points" && (kind == "unstructured_grid" || kind == "structured_grid" || kind == "polydata")) {
    to.points = file.count("the number of points");
    to.mesh.points = file.array_of_numbers(product({to.points, 3}, "points"), "the points");
  } else if (keyword == "cells" && kind == "unstructured_grid") {
    CellsOfKind cells = read_cells(file);
    to.mesh.cells.connectivity = std::move(cells.connectivity);
    to.mesh.cells.ends = std::move(cells.ends);
  } else if (keyword == "cell_types" && kind == "unstructured_grid") {
    to.mesh.cells.types = file.integers(static_cast<std::uint64_t>(file.count("the number of cell types")));
  } else if ((keyword == "spacing" || keyword == "aspect_ratio") && kind == "structured_points") {
    to.spacing = file.numbers(3, "SPACING");
  } else if (keyword == "origin" && kind == "structured_points") {
    to.origin = file.numbers(3, "ORIGIN");
  } else if (keyword.size() == 13 && keyword.substr(1) == "_coordinates" && keyword[0] >= 'x' && keyword[0] <= 'z') {
    const std::int64_t count = file.count("the number of coordinates");
    to.coordinates[keyword[0] - 'x'] = file.array_of_numbers(static_cast<std::uint64_t>(count), "the coordinates");
  } else if (kind != "polydata" || !read_surface_cells(file, keyword, to.surface)) {
    return false;
  }
  keyword = file.keyword();
  return true;
}

Image to_image(Sections& from) {
  if (from.dimensions.empty()) damaged("it has no DIMENSIONS");
  std::array<std::int64_t, 3> last{};
  for (int d = 0; d < 3; ++d) last[d] = from.dimensions[d] - 1;
  Image image = oriented_image({}, last, from.origin, from.spacing, {1, 0, 0, 0, 1, 0, 0, 0, 1});
  if (from.mesh.arrays.empty() && !from.cell_arrays.empty())
    throw Error("the image has values in its cells, none at its points");
  image.arrays = std::move(from.mesh.arrays);
  image.notices = std::move(from.mesh.notices);
  return image;
}

/// Adds the cells of the grid, of `type`, a voxel or a hexahedron.
void add_grid_cells(Sections& to, int type) {
  constexpr std::int64_t most_without_values = 100000;
  if (to.mesh.arrays.empty() && to.points > most_without_values)
    refuse("it has ", to.points, " points, and no values at them");
  if (to.points > std::numeric_limits<std::int32_t>::max())
    refuse("it has ", to.points, " points, more than 32-bit ids can number");
  to.mesh.cells = cells_of_grid({to.dimensions[0], to.dimensions[1], to.dimensions[2]}, type);
}

/// Throws gale::Error unless the file had the points that its DIMENSIONS say, of a rectilinear grid along the axes.
void require_grid_points(const Sections& of, bool rectilinear) {
  if (of.dimensions.empty()) damaged("it has no DIMENSIONS");
  for (int d = 0; rectilinear && d < 3; ++d) {
    if (static_cast<std::int64_t>(count_of(of.coordinates[d])) == of.dimensions[d]) continue;
    damaged("it has ", count_of(of.coordinates[d]), " coordinates along an axis of ", of.dimensions[d]);
  }
  if (!rectilinear && count_of(of.mesh.points) != 3 * grid_points(of))
    damaged("it has ", count_of(of.mesh.points) / 3, " points, not those of its DIMENSIONS");
}

void add_grid_points(Sections& to) {
  std::array<std::vector<double>, 3> axes;
  for (std::size_t d = 0; d < 3; ++d)
    std::visit([&](const auto& places) { axes[d].assign(places.begin(), places.end()); }, to.coordinates[d]);
  to.mesh.points = points_along(axes, false);
}

}  // namespace

Content read_legacy_vtk(const InputFile& input, const ReadOptions& options) {
  LegacyFile file(input);
  std::string keyword = file.keyword();
  if (keyword != "dataset") damaged("it names no known kind of data set");
  const std::string kind = file.keyword();
  if (kind != "unstructured_grid" && kind != "polydata" && kind != "structured_points" && kind != "structured_grid" &&
      kind != "rectilinear_grid")
    damaged("its kind of data set is '", kind, "'");
  Sections sections;
  keyword = file.keyword();
  while (!keyword.empty()) {
    const std::string before = keyword;
    if (!read_section(file, kind, keyword, sections)) damaged("it has the unknown keyword '", before, "'");
  }
  if (kind == "structured_points") return to_image(sections);
  if (kind == "polydata") {
    sections.mesh.cells = cells_of_surface(std::move(sections.surface));
  } else if (kind != "unstructured_grid") {
    const bool rectilinear = kind == "rectilinear_grid";
    require_grid_points(sections, rectilinear);
    add_grid_cells(sections, rectilinear ? cell_type::voxel : cell_type::hexahedron);
    if (rectilinear && count_of(sections.mesh.cells.types) > 0) add_grid_points(sections);
  }
  if (!sections.cell_arrays.empty()) sections.mesh.notices.push_back(note_cell_arrays(sections.cell_arrays));
  return to_mesh(sections.mesh, options);
}

}  // namespace gale::io::detail
