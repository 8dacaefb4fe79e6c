#include <algorithm>
#include <array>
#include <utility>

#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/surface_cells.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/ply_file.hpp>

// PLY's elements: vertex has x, y and z, and numbers that become point arrays; face has lists of vertices, and
// tristrips such lists, in which a -1 ends a strip.
namespace gale::io::detail {
namespace {

void take_vertices(PlyFile& file, const PlyElement& vertex, MeshParts& parts) {
  PlyColumns columns = file.read(vertex, "");
  std::vector<PointArray::Values> axes(3);
  std::array<std::size_t, 3> places{};
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string name(1, "xyz"[d]);
    const std::optional<std::size_t> found = vertex.find(name);
    if (!found || vertex.properties[*found].count_type) damaged("its vertices have no ", name);
    places[d] = *found;
    axes[d] = std::move(columns.values[*found]);
  }
  parts.points = interleaved(axes, count_of(axes[0]));
  for (std::size_t p = 0; p < vertex.properties.size(); ++p) {
    const PlyProperty& property = vertex.properties[p];
    if (std::find(places.begin(), places.end(), p) != places.end()) continue;
    if (property.count_type) {
      parts.notices.push_back(note_array(printable(property.name), "its values are lists"));
    } else {
      parts.arrays.push_back({property.name, 1, std::move(columns.values[p])});
    }
  }
}

/// Reads the lists of vertices that elements have; notes their other properties.
CellsOfKind take_lists(PlyFile& file, const PlyElement& element, MeshParts& parts) {
  const std::string name = element.find("vertex_indices") ? "vertex_indices" : "vertex_index";
  const std::optional<std::size_t> place = element.find(name);
  if (!place || !element.properties[*place].count_type) {
    if (element.count > 0) damaged("its elements '", element.name, "' have no list vertex_indices");
    return {};
  }
  PlyColumns columns = file.read(element, name);
  std::vector<std::string> others;
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    if (p != *place) others.push_back(printable(element.properties[p].name));
  }
  if (!others.empty()) parts.notices.push_back(note_cell_arrays(others));
  return {std::move(columns.lists[*place]), std::move(columns.ends[*place])};
}

/// Cuts lists at each -1, in place.
CellsOfKind strips_of(CellsOfKind lists) {
  if (count_of(lists.ends) == 0) return lists;
  auto& points = std::get<std::vector<std::int32_t>>(lists.connectivity);
  std::vector<std::int64_t> ends;
  std::size_t begin = 0, to = 0;
  const auto end_strip = [&] {
    const auto end = static_cast<std::int64_t>(to);
    if (end > (ends.empty() ? 0 : ends.back())) ends.push_back(end);
  };
  for (const std::int64_t end : std::get<std::vector<std::int64_t>>(lists.ends)) {
    for (; begin < static_cast<std::size_t>(end); ++begin) {
      if (points[begin] == -1) {
        end_strip();
      } else {
        points[to++] = points[begin];
      }
    }
    end_strip();
  }
  points.resize(to);
  lists.ends = std::move(ends);
  return lists;
}

}  // namespace

Content read_ply(const InputFile& input, const ReadOptions& options) {
  PlyFile file(input);
  MeshParts parts;
  SurfaceCells cells;
  for (const PlyElement& element : file.elements()) {
    if (element.name == "vertex") {
      take_vertices(file, element, parts);
    } else if (element.name == "face") {
      cells.polygons = take_lists(file, element, parts);
    } else if (element.name == "tristrips") {
      cells.strips = strips_of(take_lists(file, element, parts));
    } else {
      if (element.count > 0) parts.notices.push_back("left out its elements '" + printable(element.name) + "'");
      file.skip(element);
    }
  }
  parts.cells = cells_of_surface(std::move(cells));
  return to_mesh(parts, options);
}

}  // namespace gale::io::detail
