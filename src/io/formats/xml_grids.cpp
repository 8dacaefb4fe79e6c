#include <algorithm>
#include <array>
#include <limits>

#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/cells/join.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/volume.hpp>
#include <gale/io/formats/xml_pieces.hpp>

// `.vti`, `.vts` and `.vtr`: images, and meshes of hexahedra and of voxels whose points have places along three axes.
namespace gale::io::detail {
namespace {

/// A grid's pieces, and where they are.
struct GridFile {
  GridFile(const InputFile& input, const char* type)
      : file(read_xml(input, type)),
        element(file.root.require(type)),
        whole(whole_extent_of(element)),
        pieces(grid_pieces_of(element, whole)) {}
  GridFile(const GridFile&) = delete;
  GridFile& operator=(const GridFile&) = delete;

  /// Throws gale::Error if ids can't number its points.
  void require_ids() const {
    if (whole.points() > std::uint64_t(std::numeric_limits<std::int32_t>::max()))
      refuse("it has ", whole.points(), " points, more than 32-bit ids can number");
  }

  XmlArrays point_data() const {
    return join_pieces(pieces, whole, [&](const XmlElement& piece, std::uint64_t points) {
      return read_point_data(file, piece, points);
    });
  }

  /// The names of all pieces' cell arrays.
  std::vector<std::string> cell_data() const {
    DistinctTexts names;
    for (const GridPiece& piece : pieces) names.add(names_of_cell_data(*piece.element));
    return names.take();
  }

  XmlFile file;
  const XmlElement& element;
  Extent whole;
  std::vector<GridPiece> pieces;
};

/// The mesh of the grid's cells, but for its points.
MeshParts parts_of(const GridFile& grid, int type) {
  MeshParts parts;
  XmlArrays arrays = grid.point_data();
  parts.arrays = std::move(arrays.arrays);
  parts.notices = std::move(arrays.notices);
  const std::vector<std::string> cell_arrays = grid.cell_data();
  if (!cell_arrays.empty()) parts.notices.push_back(note_cell_arrays(cell_arrays));
  constexpr std::uint64_t most_without_values = 100000;
  if (parts.arrays.empty() && grid.whole.points() > most_without_values)
    refuse("it has ", grid.whole.points(), " points, and no values at them");
  parts.cells = cells_of_grid({grid.whole.size(0), grid.whole.size(1), grid.whole.size(2)}, type);
  return parts;
}

/// The coordinates along an axis, of all pieces. Takes memory for what these have.
std::vector<double> axis_of(const GridFile& grid, int axis, bool& is_float) {
  std::vector<PointArray::Values> of_pieces;
  std::size_t count = 0;
  for (const GridPiece& piece : grid.pieces) {
    const auto arrays = piece.element->require("Coordinates").all("DataArray");
    if (arrays.size() != 3) damaged("its Coordinates have ", arrays.size(), " arrays, not 3");
    const auto size = static_cast<std::uint64_t>(piece.extent.size(axis));
    of_pieces.push_back(read_array(grid.file, *arrays[static_cast<std::size_t>(axis)], size));
    is_float &= std::holds_alternative<std::vector<float>>(of_pieces.back());
    count += size;
  }
  const auto all_of_them = static_cast<std::size_t>(grid.whole.size(axis));
  if (count < all_of_them) not_covered();
  std::vector<double> all(all_of_them);
  std::vector<bool> is_there(all.size());
  for (std::size_t k = 0; k < of_pieces.size(); ++k) {
    auto place = static_cast<std::size_t>(grid.pieces[k].extent.low[axis] - grid.whole.low[axis]);
    std::visit(
        [&](const auto& coordinates) {
          for (const auto coordinate : coordinates) {
            is_there[place] = true;
            all[place++] = static_cast<double>(coordinate);
          }
        },
        of_pieces[k]);
  }
  if (std::find(is_there.begin(), is_there.end(), false) != is_there.end()) not_covered();
  return all;
}

}  // namespace

Content read_vti(const InputFile& input, const ReadOptions&) {
  const GridFile grid(input, "ImageData");
  const auto origin = numbers_in<double>(grid.element, "Origin", {0, 0, 0}, 3);
  const auto spacing = numbers_in<double>(grid.element, "Spacing", {1, 1, 1}, 3);
  const auto direction = numbers_in<double>(grid.element, "Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1}, 9);
  Image image = oriented_image(grid.whole.low, grid.whole.high, origin, spacing, direction);
  XmlArrays arrays = grid.point_data();
  if (arrays.arrays.empty() && !arrays.notices.empty())
    refuse("the image has no scalars: ", printable(arrays.notices.front()));
  if (arrays.arrays.empty() && !grid.cell_data().empty())
    throw Error("the image has values in its cells, none at its points");
  image.arrays = std::move(arrays.arrays);
  image.notices = std::move(arrays.notices);
  return image;
}

Content read_vts(const InputFile& input, const ReadOptions& options) {
  const GridFile grid(input, "StructuredGrid");
  grid.require_ids();
  const auto read = [&](const XmlElement& piece, std::uint64_t points) {
    const XmlElement& array = piece.require("Points").require("DataArray");
    if (array.attribute("NumberOfComponents", "3") != "3")
      damaged("its points have ", array.attribute("NumberOfComponents"), " components");
    return XmlArrays{{{"", 3, read_array(grid.file, array, 3 * points)}}, {}};
  };
  std::vector<PointArray> points = join_pieces(grid.pieces, grid.whole, read).arrays;
  if (points.empty()) damaged("the points of its pieces have different types");
  MeshParts parts = parts_of(grid, cell_type::hexahedron);
  parts.points = std::move(points[0].values);
  return to_mesh(parts, options);
}

Content read_vtr(const InputFile& input, const ReadOptions& options) {
  const GridFile grid(input, "RectilinearGrid");
  grid.require_ids();
  bool is_float = true;
  const std::array<std::vector<double>, 3> axes = {axis_of(grid, 0, is_float), axis_of(grid, 1, is_float),
                                                   axis_of(grid, 2, is_float)};
  MeshParts parts = parts_of(grid, cell_type::voxel);
  parts.points = points_along(axes, is_float);
  return to_mesh(parts, options);
}

}  // namespace gale::io::detail
