#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/io/dataset.hpp>

namespace gale::outputs {

/// The point array to analyse: the one called `name`, or NAME_K for component K of an array NAME with several; without
/// a name the first of one component that is neither a segmentation nor an order. Throws gale::Error, naming the arrays
/// that there are.
io::PointArray select_field(const io::Dataset& dataset, const std::string& name);

/// The order of the field's values, or of the array NAME_Order where the dataset has one beside the field NAME. Throws
/// gale::Error if that isn't a permutation of 0..vertices-1.
VertexOrder order_of(const Mesh& mesh, const io::Dataset& dataset, const io::PointArray& field);

/// The names under which segments are found; the first one is ours to write, too.
inline constexpr const char* segments_name = "ttkCompactTriangulationIndex";
inline constexpr const char* ttk_segments_name = "_index";

/// Whether the array can be labels of segments: whole numbers, one a point.
bool holds_segments(const io::PointArray& array);

/// The point array called `name`. Throws gale::Error if there is none.
const io::PointArray& select_segments(const io::Dataset& dataset, const std::string& name);

/// The segments that the dataset brings under a name that we know, or nullptr. `ignored`: arrays of such a name that
/// don't hold segments.
const io::PointArray* find_segments(const io::Dataset& dataset, std::vector<std::string>& ignored);

/// The label of each point. Throws gale::Error unless `holds_segments`.
std::vector<std::int64_t> labels_of(const io::PointArray& segments);

}  // namespace gale::outputs
