#pragma once

#include <string>

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>

namespace gale::outputs::detail {

/// The dataset's point array of that name, or nullptr. Of several the first.
GALE_EXPORT const io::PointArray* find_array(const io::Dataset& dataset, const std::string& name);

/// "the input has A, B": for messages.
std::string names_of_arrays(const io::Dataset& dataset);

}  // namespace gale::outputs::detail
