#pragma once

#include <vector>

#include <gale/algorithms/simplify_field.hpp>
#include <gale/io/dataset.hpp>

namespace gale::outputs {

/// A simplified field as point arrays of its mesh, in input order: the field's values, under its name and of its type,
/// and NAME_Order (int32), the order of the vertices, which is what orders them where both are read again.
/// On several ranks `field` is that of the excerpt (`array_of`).
inline std::vector<io::PointArray> simplified_arrays(const io::PointArray& field, const SimplifiedField& simplified) {
  return {io::gather(field, simplified.value_of), {field.name + "_Order", 1, simplified.rank}};
}

}  // namespace gale::outputs
