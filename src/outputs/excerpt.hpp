#pragma once

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::outputs {

/// The points of an excerpt's vertices (`MorseSmaleComplex::excerpt`), and their values of all arrays, by its input
/// ids, from the datasets of the ranks that own them, which are by input ids of their parts `mesh`, and have the same
/// arrays. Without cells. Collective.
GALE_EXPORT io::Dataset dataset_of(const Mesh& excerpt, const Mesh& mesh, const io::Dataset& dataset);

/// The values of one array likewise. Collective.
GALE_EXPORT io::PointArray array_of(const Mesh& excerpt, const Mesh& mesh, const io::PointArray& array);

}  // namespace gale::outputs
