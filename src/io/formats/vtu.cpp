#include <algorithm>
#include <limits>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/value_type.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/formats/readers.hpp>
#include <gale/io/formats/xml_file.hpp>

namespace gale::io::detail {

namespace {

constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() / 64);

std::uint64_t count_in(const XmlElement& piece, const char* of_what) {
  const std::uint64_t count = piece.number(of_what);
  if (count > most) damaged(std::string(of_what) + " is " + std::to_string(count));
  return count;
}

const XmlElement& cell_array(const XmlElement& cells, const char* name) {
  for (const XmlElement& array : cells.children) {
    if (array.name == "DataArray" && array.attribute("Name") == name) return array;
  }
  damaged(std::string("its Cells have no ") + name);
}

MeshParts read_piece(const XmlFile& file, const XmlElement& piece) {
  MeshParts parts;
  const std::uint64_t points = count_in(piece, "NumberOfPoints"), cells = count_in(piece, "NumberOfCells");
  if (points > 0) {
    const XmlElement& array = piece.require("Points").require("DataArray");
    if (array.attribute("NumberOfComponents", "3") != "3")
      damaged("its points have " + array.attribute("NumberOfComponents") + " components");
    parts.points = read_array(file, array, 3 * points);
  }
  if (cells > 0) {
    const XmlElement& arrays = piece.require("Cells");
    parts.cells.types = read_array(file, cell_array(arrays, "types"), cells);
    parts.cells.ends = read_array(file, cell_array(arrays, "offsets"), cells);
    parts.cells.connectivity = read_array(file, cell_array(arrays, "connectivity"), std::nullopt);
  }
  XmlArrays data = read_point_data(file, piece, points);
  parts.arrays = std::move(data.arrays);
  parts.notices = std::move(data.notices);
  return parts;
}

/// All values, in the type of the first.
template <class To>
void append(const PointArray::Values& from, To offset, std::vector<To>& to) {
  std::visit(
      [&](const auto& values) {
        to.reserve(to.size() + values.size());
        for (const auto value : values) to.push_back(static_cast<To>(value) + offset);
      },
      from);
}

/// Behind the arrays of the pieces before, of which those stay that this piece has as well.
void append_arrays(std::vector<PointArray>& from, std::vector<PointArray>& to, std::vector<std::string>& notices) {
  const auto same = [](const PointArray& a, const PointArray& b) {
    return a.name == b.name && a.components == b.components && a.values.index() == b.values.index();
  };
  for (auto array = to.begin(); array != to.end();) {
    const auto more = std::find_if(from.begin(), from.end(), [&](const PointArray& a) { return same(*array, a); });
    if (more == from.end()) {
      notices.push_back("left out the point array '" + array->name + "': not all pieces have it");
      array = to.erase(array);
      continue;
    }
    std::visit(
        [&](auto& values) {
          const auto& others = std::get<std::decay_t<decltype(values)>>(more->values);
          values.insert(values.end(), others.begin(), others.end());
        },
        array->values);
    ++array;
  }
}

/// The pieces one behind the other.
MeshParts join(const XmlFile& file, const std::vector<const XmlElement*>& pieces) {
  MeshParts all = read_piece(file, *pieces.front());
  if (pieces.size() == 1) return all;
  // One type for all that pieces may have in different ones.
  std::vector<double> points;
  std::vector<std::int64_t> types, ends, connectivity;
  bool is_double = false, has_arrays = false;
  const auto add = [&](MeshParts& part) {
    const auto first_point = static_cast<std::int64_t>(points.size() / 3);
    const auto begin = static_cast<std::int64_t>(connectivity.size());
    is_double |= std::holds_alternative<std::vector<double>>(part.points);
    append(part.points, 0.0, points);
    append(part.cells.types, std::int64_t(0), types);
    append(part.cells.ends, begin, ends);
    append(part.cells.connectivity, first_point, connectivity);
  };
  add(all);
  has_arrays = !points.empty();
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    MeshParts part = read_piece(file, *pieces[k]);
    add(part);
    if (count_of(part.points) == 0) continue;  // an empty piece may leave out arrays
    if (has_arrays) {
      append_arrays(part.arrays, all.arrays, all.notices);
    } else {
      all.arrays = std::move(part.arrays);
      all.notices = std::move(part.notices);
    }
    has_arrays = true;
  }
  if (is_double) {
    all.points = std::move(points);
  } else {
    all.points = std::vector<float>(points.begin(), points.end());
  }
  all.cells = {std::move(types), std::move(ends), std::move(connectivity)};
  return all;
}

}  // namespace

Content read_vtu(const InputFile& input, const ReadOptions& options) {
  const XmlFile file = read_xml(input, "UnstructuredGrid");
  const XmlElement& grid = file.root.require("UnstructuredGrid");
  std::vector<const XmlElement*> pieces;
  for (const XmlElement& piece : grid.children) {
    if (piece.name == "Piece") pieces.push_back(&piece);
  }
  if (pieces.empty()) throw Error("it has no tetrahedra");
  MeshParts parts = join(file, pieces);
  const std::vector<std::string> cell_arrays = names_of_cell_data(*pieces.front());
  if (!cell_arrays.empty()) parts.notices.push_back(note_cell_arrays(cell_arrays));
  return to_mesh(parts, options.tetrahedralize);
}

}  // namespace gale::io::detail
