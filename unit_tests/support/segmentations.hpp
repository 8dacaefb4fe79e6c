#pragma once

#include <string>
#include <vector>

#include "support/input_mesh.hpp"

namespace gale::test {

/// The names of the segmentations that tests try on each mesh.
const std::vector<std::string>& segmentation_names();

/// That of a mesh. Throws std::out_of_range for another name.
Segmentation segmentation_named(const std::string& name, const InputMesh& mesh);

Segmentation octree_of(const InputMesh& mesh, int capacity);

/// By its octree.
Mesh encode(const InputMesh& mesh, int capacity);

Segmentation segmentation_by(const std::vector<std::int64_t>& labels);

/// Segments of 400 and of 20 vertices by turns, in input order: those outgrow the fast memory of a device's teams.
Segmentation large_and_small(const InputMesh& mesh);

}  // namespace gale::test
