#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/formats/xml_file.hpp>

/// Pieces of regular grids in VTK's XML files: images, structured and rectilinear grids.
namespace gale::io::detail {

/// The numbers of an attribute, or `otherwise` if it has none. Throws gale::Error unless there are `count`.
template <class T>
std::vector<T> numbers_in(const XmlElement& element, const char* key, const std::vector<T>& otherwise,
                          std::size_t count) {
  std::vector<T> result = numbers_of<T>(element.attribute(key), key);
  if (result.empty() && !otherwise.empty()) return otherwise;
  if (result.size() != count) damaged("its ", key, " has ", result.size(), " numbers, not ", count);
  return result;
}

/// The first and the last place of each axis.
struct Extent {
  std::array<std::int64_t, 3> low{}, high{};

  std::int64_t size(int d) const { return high[d] - low[d] + 1; }
  bool is_empty() const { return size(0) < 1 || size(1) < 1 || size(2) < 1; }
  std::uint64_t points() const { return product({size(0), size(1), size(2)}, "an extent"); }
};

/// The WholeExtent of a grid. Throws gale::Error for one that has no points.
Extent whole_extent_of(const XmlElement& grid);

/// A piece of such a grid.
struct GridPiece {
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

/// The pieces of a grid that have points. Throws gale::Error if there are none, or one leaves the whole.
std::vector<GridPiece> grid_pieces_of(const XmlElement& grid, const Extent& whole);

[[noreturn]] void not_covered();

/// Puts arrays of the pieces' points, which `read` reads of so many points each, where they belong: those that all
/// pieces have, with a notice about each other one. Each point must be in a piece; where pieces overlap, the later one
/// counts.
XmlArrays join_pieces(const std::vector<GridPiece>& pieces, const Extent& whole,
                      const std::function<XmlArrays(const XmlElement& piece, std::uint64_t points)>& read);

}  // namespace gale::io::detail
