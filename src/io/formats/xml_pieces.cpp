#include <algorithm>
#include <limits>

#include <gale/io/cells/join.hpp>
#include <gale/io/formats/xml_pieces.hpp>

namespace gale::io::detail {

Extent extent_of(const XmlElement& element, const char* key) {
  const auto values = numbers_in<std::int32_t>(element, key, {}, 6);
  Extent extent;
  for (int d = 0; d < 3; ++d) {
    extent.low[d] = values[2 * d];
    extent.high[d] = values[2 * d + 1];
    if (extent.size(d) < 1 || extent.size(d) > std::numeric_limits<std::int32_t>::max())
      damaged("its ", key, " is '", element.attribute(key), "'");
  }
  return extent;
}

std::vector<GridPiece> grid_pieces_of(const XmlElement& grid, const Extent& whole) {
  std::vector<GridPiece> pieces;
  for (const XmlElement* const element : grid.all("Piece")) {
    const Extent extent = extent_of(*element, "Extent");
    for (int d = 0; d < 3; ++d) {
      if (extent.low[d] < whole.low[d] || extent.high[d] > whole.high[d])
        damaged("a piece's Extent '", element->attribute("Extent"), "' leaves the WholeExtent");
    }
    pieces.push_back({extent, element});
  }
  if (pieces.empty()) not_covered();
  return pieces;
}

void not_covered() { damaged("its pieces don't cover its WholeExtent"); }

XmlArrays join_pieces(const std::vector<GridPiece>& pieces, const Extent& whole,
                      const std::function<XmlArrays(const XmlElement& piece, std::uint64_t points)>& read) {
  const std::uint64_t points = whole.points();
  std::uint64_t in_pieces = 0;
  for (const GridPiece& piece : pieces) in_pieces += piece.extent.points();
  if (in_pieces < points) not_covered();
  if (pieces.size() == 1) return read(*pieces[0].element, points);
  std::vector<XmlArrays> parts;
  for (const GridPiece& piece : pieces) parts.push_back(read(*piece.element, piece.extent.points()));
  XmlArrays all;
  if (parts[0].arrays.empty()) return parts[0];
  std::vector<ArraysByKind> kinds;
  for (XmlArrays& part : parts) kinds.push_back(by_kind(part.arrays));
  std::vector<bool> covered(points);
  for (const GridPiece& piece : pieces) {
    for_each_row(piece.extent, whole, [&](std::size_t, std::size_t to, std::size_t count) {
      std::fill_n(covered.begin() + static_cast<std::ptrdiff_t>(to), count, true);
    });
  }
  if (std::find(covered.begin(), covered.end(), false) != covered.end()) not_covered();
  all.notices = parts[0].notices;
  for (const PointArray& first : parts[0].arrays) {
    const auto width = static_cast<std::size_t>(first.components);
    const auto place = [&](const auto& values) -> PointArray::Values {
      using Vector = std::decay_t<decltype(values)>;
      Vector joined(points * width);
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        const PointArray* const found = find_alike(kinds[k], first);
        if (found == nullptr) damaged("not all pieces have the array '", first.name, "', in one type");
        const auto& from_values = std::get<Vector>(found->values);
        for_each_row(pieces[k].extent, whole, [&](std::size_t from, std::size_t to, std::size_t count) {
          std::copy_n(from_values.begin() + static_cast<std::ptrdiff_t>(from * width), count * width,
                      joined.begin() + static_cast<std::ptrdiff_t>(to * width));
        });
      }
      return joined;
    };
    all.arrays.push_back({first.name, first.components, std::visit(place, first.values)});
  }
  return all;
}

}  // namespace gale::io::detail
