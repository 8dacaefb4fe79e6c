#pragma once

#include <string>
#include <vector>

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>

namespace gale::outputs {

/// Columns of one number a row as comma-separated values, behind a line of their names. Numbers are written such that
/// they are read back as they are.
GALE_EXPORT std::string to_csv(const std::vector<io::PointArray>& columns);

/// The content of an .npz, which numpy.load reads: an array for each column, of its name and type. Throws Error where
/// that is 4 GiB or more.
GALE_EXPORT std::string to_npz(const std::vector<io::PointArray>& columns);

}  // namespace gale::outputs
