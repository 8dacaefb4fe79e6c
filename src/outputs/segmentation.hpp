#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>
#include <gale/mesh/mesh.hpp>

// Segments of vertices as point arrays: those of a mesh, to be written, and those that an input brings along.

namespace gale::outputs {

/// The name under which GALE writes segments, and finds them in an input.
inline constexpr const char* segments_name = "ttkCompactTriangulationIndex";

/// The other name under which segments are found in an input.
inline constexpr const char* ttk_segments_name = "_index";

/// The segment of each vertex, in input order, as the array `segments_name` (int32).
GALE_EXPORT io::PointArray segments_of(const Mesh& mesh);

/// Whether the array can be labels of segments: whole numbers, one a point.
GALE_EXPORT bool holds_segments(const io::PointArray& array);

/// The point array called `name`. Throws gale::Error, with the names that there are, if there is none.
GALE_EXPORT const io::PointArray& select_segments(const io::Dataset& dataset, const std::string& name);

/// The array that the dataset brings under one of the two names above, the first before the second; nullptr if neither
/// holds segments. Appends to `ignored` the names of arrays that are called so and don't hold segments.
GALE_EXPORT const io::PointArray* find_segments(const io::Dataset& dataset, std::vector<std::string>& ignored);

/// The label of each point, for `given_segmentation`. Throws gale::Error, with the array's name, unless
/// `holds_segments`.
GALE_EXPORT std::vector<std::int64_t> labels_of(const io::PointArray& segments);

}  // namespace gale::outputs
