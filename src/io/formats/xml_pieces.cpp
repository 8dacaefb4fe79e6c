#include <algorithm>
#include <limits>
#include <map>

#include <gale/io/cells/join.hpp>
#include <gale/io/formats/xml_pieces.hpp>

namespace gale::io::detail {

namespace {

Extent extent_of(const XmlElement& element, const char* key) {
  const auto values = numbers_in<std::int32_t>(element, key, {}, 6);
  Extent extent;
  for (int d = 0; d < 3; ++d) {
    extent.low[d] = values[2 * d];
    extent.high[d] = values[2 * d + 1];
  }
  return extent;
}

}  // namespace

Extent whole_extent_of(const XmlElement& grid) {
  const char* const key = "WholeExtent";
  const Extent whole = extent_of(grid, key);
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (whole.is_empty() || std::max({whole.size(0), whole.size(1), whole.size(2)}) > most)
    damaged("its ", key, " is '", grid.attribute(key), "'");
  return whole;
}

std::vector<GridPiece> grid_pieces_of(const XmlElement& grid, const Extent& whole) {
  std::vector<GridPiece> pieces;
  for (const XmlElement* const element : grid.all("Piece")) {
    const Extent extent = extent_of(*element, "Extent");
    if (extent.is_empty()) continue;  // VTK writes such ones
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
  std::vector<ArraysByKind> kinds;
  std::map<ArrayKind, std::size_t> pieces_with;
  for (XmlArrays& part : parts) {
    kinds.push_back(by_kind(part.arrays));
    for (const auto& alike : kinds.back()) ++pieces_with[alike.first];
  }
  const auto have_all = [&](const PointArray& array) { return pieces_with[kind_of(array)] == pieces.size(); };
  DistinctTexts notices;
  for (const XmlArrays& part : parts) {
    notices.add(part.notices);
    for (const PointArray& array : part.arrays) {
      if (!have_all(array)) notices.add(note_missing(array));
    }
  }
  XmlArrays all{{}, notices.take()};
  const auto& arrays = parts[0].arrays;
  if (std::none_of(arrays.begin(), arrays.end(), have_all)) return all;
  std::vector<bool> covered(points);
  for (const GridPiece& piece : pieces) {
    for_each_row(piece.extent, whole, [&](std::size_t, std::size_t to, std::size_t count) {
      std::fill_n(covered.begin() + static_cast<std::ptrdiff_t>(to), count, true);
    });
  }
  if (std::find(covered.begin(), covered.end(), false) != covered.end()) not_covered();
  for (const PointArray& first : arrays) {
    if (!have_all(first)) continue;
    const auto width = static_cast<std::size_t>(first.components);
    const auto place = [&](const auto& values) -> PointArray::Values {
      using Vector = std::decay_t<decltype(values)>;
      Vector joined(points * width);
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        const auto& from_values = std::get<Vector>(find_alike(kinds[k], first)->values);
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
