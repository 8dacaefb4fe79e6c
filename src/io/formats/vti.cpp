#include <algorithm>
#include <limits>

#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/join.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/volume.hpp>
#include <gale/io/formats/xml_file.hpp>

namespace gale::io::detail {
namespace {

template <class T>
std::vector<T> numbers(const XmlElement& element, const char* key, const std::vector<T>& otherwise, std::size_t count) {
  std::vector<T> result = numbers_of<T>(element.attribute(key), key);
  if (result.empty() && !otherwise.empty()) return otherwise;
  if (result.size() != count) damaged("its ", key, " has ", result.size(), " numbers, not ", count);
  return result;
}

/// The first and the last place of each axis.
struct Extent {
  std::array<std::int64_t, 3> low{}, high{};

  std::int64_t size(int d) const { return high[d] - low[d] + 1; }
  std::uint64_t points() const { return product({size(0), size(1), size(2)}, "an extent"); }
};

Extent extent_of(const XmlElement& element, const char* key) {
  const auto values = numbers<std::int32_t>(element, key, {}, 6);
  Extent extent;
  for (int d = 0; d < 3; ++d) {
    extent.low[d] = values[2 * d];
    extent.high[d] = values[2 * d + 1];
    if (extent.size(d) < 1 || extent.size(d) > std::numeric_limits<std::int32_t>::max())
      damaged("its ", key, " is '", element.attribute(key), "'");
  }
  return extent;
}

struct Piece {
  Extent extent;
  const XmlElement* element;
};

/// Calls visit(from, to, count) for each row of the piece: its places there and in the whole.
template <class Visit>
void for_each_row(const Extent& piece, const Extent& whole, const Visit& visit) {
  std::size_t from = 0;
  const auto row = static_cast<std::size_t>(piece.size(0));
  for (std::int64_t z = piece.low[2]; z <= piece.high[2]; ++z) {
    for (std::int64_t y = piece.low[1]; y <= piece.high[1]; ++y, from += row) {
      const std::int64_t to =
          ((z - whole.low[2]) * whole.size(1) + (y - whole.low[1])) * whole.size(0) + piece.low[0] - whole.low[0];
      visit(from, static_cast<std::size_t>(to), row);
    }
  }
}

std::vector<Piece> pieces_of(const XmlElement& image, const Extent& whole) {
  std::vector<Piece> pieces;
  for (const XmlElement* const element : image.all("Piece")) {
    const Extent extent = extent_of(*element, "Extent");
    for (int d = 0; d < 3; ++d) {
      if (extent.low[d] < whole.low[d] || extent.high[d] > whole.high[d])
        damaged("a piece's Extent '", element->attribute("Extent"), "' leaves the WholeExtent");
    }
    pieces.push_back({extent, element});
  }
  return pieces;
}

[[noreturn]] void not_covered() { damaged("its pieces don't cover its WholeExtent"); }

/// Puts the pieces' arrays where they belong. Each point must be in a piece; where pieces overlap, the later one
/// counts.
XmlArrays join(const XmlFile& file, const std::vector<Piece>& pieces, const Extent& whole) {
  const std::uint64_t points = whole.points();
  std::uint64_t in_pieces = 0;
  for (const Piece& piece : pieces) in_pieces += piece.extent.points();
  if (in_pieces < points) not_covered();
  if (pieces.size() == 1) return read_point_data(file, *pieces[0].element, points);
  std::vector<XmlArrays> parts;
  for (const Piece& piece : pieces) parts.push_back(read_point_data(file, *piece.element, piece.extent.points()));
  XmlArrays all;
  if (parts[0].arrays.empty()) return parts[0];
  std::vector<ArraysByKind> kinds;
  for (XmlArrays& part : parts) kinds.push_back(by_kind(part.arrays));
  std::vector<bool> covered(points);
  for (const Piece& piece : pieces) {
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

}  // namespace

Content read_vti(const InputFile& input, const ReadOptions&) {
  const XmlFile file = read_xml(input, "ImageData");
  const XmlElement& element = file.root.require("ImageData");
  const Extent whole = extent_of(element, "WholeExtent");
  const auto origin = numbers<double>(element, "Origin", {0, 0, 0}, 3);
  const auto spacing = numbers<double>(element, "Spacing", {1, 1, 1}, 3);
  const auto direction = numbers<double>(element, "Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1}, 9);
  Image image = oriented_image(whole.low, whole.high, origin, spacing, direction);
  const std::vector<Piece> pieces = pieces_of(element, whole);
  if (pieces.empty()) not_covered();
  XmlArrays arrays = join(file, pieces, whole);
  if (arrays.arrays.empty() && arrays.notices.empty() && !names_of_cell_data(*pieces[0].element).empty())
    throw Error("the image has values in its cells, none at its points");
  image.arrays = std::move(arrays.arrays);
  image.notices = std::move(arrays.notices);
  return image;
}

}  // namespace gale::io::detail
