#include <limits>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/join.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/vtu.hpp>

namespace gale::io::detail {
namespace {

constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() / 64);

std::uint64_t count_in(const XmlElement& piece, const char* of_what) {
  const std::uint64_t count = piece.number(of_what);
  if (count > most) damaged(of_what, " is ", count);
  return count;
}

const XmlElement& cell_array(const XmlElement& cells, const char* name) {
  for (const XmlElement& array : cells.children) {
    if (array.name == "DataArray" && array.attribute("Name") == name) return array;
  }
  damaged("its Cells have no ", name);
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

std::optional<PointArray::Values> read_cell_array(const XmlFile& file, const XmlElement& piece,
                                                  const std::string& name) {
  const XmlElement* const data = piece.child("CellData");
  if (data == nullptr) return std::nullopt;
  for (const XmlElement& array : data->children) {
    if (array.name == "DataArray" && array.attribute("Name") == name)
      return read_array(file, array, count_in(piece, "NumberOfCells"));
  }
  return std::nullopt;
}

std::vector<const XmlElement*> pieces_of(const XmlFile& file) {
  const XmlElement& grid = file.root.require("UnstructuredGrid");
  std::vector<const XmlElement*> pieces;
  for (const XmlElement& piece : grid.children) {
    if (piece.name == "Piece") pieces.push_back(&piece);
  }
  return pieces;
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
