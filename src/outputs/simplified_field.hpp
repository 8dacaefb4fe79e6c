#pragma once

#include <vector>

#include <gale/algorithms/simplify_field.hpp>
#include <gale/export.hpp>
#include <gale/io/dataset.hpp>

namespace gale::outputs {

/// A simplified field as point arrays of its mesh, in input order: the field's values, under its name and of its type,
/// and NAME_Order (int32), the order of the vertices, which is what orders them where both are read again.
/// On several ranks `field` is that of the excerpt (`array_of`).
GALE_EXPORT std::vector<io::PointArray> simplified_arrays(const io::PointArray& field,
                                                          const SimplifiedField& simplified);

}  // namespace gale::outputs
