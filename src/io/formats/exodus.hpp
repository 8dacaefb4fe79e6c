#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gale/io/dataset.hpp>

/// The meaning of Exodus's names, as VTK's reader has it.
namespace gale::io::detail {

struct ElementType {
  int cell_type;                    ///< a `CellType::number`
  std::size_t points;               ///< how many the cell has; an element may have more, which are left out
  std::vector<std::uint8_t> order;  ///< which of the element's points each of the cell's is; empty if they are the same
};

/// The type of cell of elements called `name` with so many points. Throws gale::Error, naming the `array` they are in,
/// if none is known.
ElementType find_element_type(const std::string& name, std::uint64_t points, const std::string& array);

/// Arrays of one component each whose names, one after the other, end with X Y Z, or X Y, or XX YY ZZ XY XZ YZ, become
/// one by the name before that. Of two dimensions, vectors have a third component of 0.
std::vector<PointArray> with_vectors(std::vector<PointArray> arrays, std::uint64_t dimensions);

}  // namespace gale::io::detail
