#include <limits>

#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/join.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/xml_file.hpp>

namespace gale::io::detail {
namespace {

constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() / 64);

std::uint64_t count_in(const XmlElement& piece, const char* of_what) {
  const std::uint64_t count = piece.number(of_what);
  if (count > most) damaged(of_what, " is ", count);
  return count;
}

/// Reads one of the arrays that say what cells there are.
PointArray::Values read_cells(const XmlFile& file, const XmlElement& piece, const char* name,
                              std::optional<std::uint64_t> count) {
  piece.require("Cells");
  const XmlElement* const array = piece.array("Cells", name);
  if (array == nullptr) damaged("its Cells have no ", name);
  return read_array(file, *array, count);
}

}  // namespace

MeshParts read_piece(const XmlFile& file, const XmlElement& piece) {
  MeshParts parts;
  const std::uint64_t points = count_in(piece, "NumberOfPoints"), cells = count_in(piece, "NumberOfCells");
  if (points > 0) {
    const XmlElement& array = piece.require("Points").require("DataArray");
    if (array.attribute("NumberOfComponents", "3") != "3")
      damaged("its points have ", array.attribute("NumberOfComponents"), " components");
    parts.points = read_array(file, array, 3 * points);
  }
  if (cells > 0) {
    parts.cells.types = read_cells(file, piece, "types", cells);
    parts.cells.ends = read_cells(file, piece, "offsets", cells);
    parts.cells.connectivity = read_cells(file, piece, "connectivity", std::nullopt);
  }
  XmlArrays data = read_point_data(file, piece, points);
  parts.arrays = std::move(data.arrays);
  parts.notices = std::move(data.notices);
  return parts;
}

std::optional<PointArray::Values> read_cell_array(const XmlFile& file, const XmlElement& piece,
                                                  const std::string& name) {
  const XmlElement* const array = piece.array("CellData", name);
  if (array == nullptr) return std::nullopt;
  return read_array(file, *array, count_in(piece, "NumberOfCells"));
}

std::vector<const XmlElement*> pieces_of(const XmlFile& file) {
  return file.root.require("UnstructuredGrid").all("Piece");
}

Content read_vtu(const InputFile& input, const ReadOptions& options) {
  const XmlFile file = read_xml(input, "UnstructuredGrid");
  const std::vector<const XmlElement*> pieces = pieces_of(file);
  if (pieces.empty()) throw Error("it has no tetrahedra");
  MeshParts parts = read_piece(file, *pieces.front());
  if (pieces.size() > 1) {
    JoinedPieces joined;
    joined.add(std::move(parts));
    for (std::size_t k = 1; k < pieces.size(); ++k) joined.add(read_piece(file, *pieces[k]));
    parts = joined.take();
  }
  const std::vector<std::string> cell_arrays = names_of_cell_data(*pieces.front());
  if (!cell_arrays.empty()) parts.notices.push_back(note_cell_arrays(cell_arrays));
  return to_mesh(parts, options.tetrahedralize);
}

}  // namespace gale::io::detail
