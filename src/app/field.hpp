#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/io/dataset.hpp>

namespace gale::app {

/// The point array to analyse: the one called `name`, or NAME_K for component K of an array NAME with several; without a name the first of one
/// component that is neither a segmentation nor an order. Throws gale::Error, naming the arrays that there are.
io::PointArray select_field(const io::Dataset& dataset, const std::string& name);

/// The order of the field's values, or of the array NAME_Order where the dataset has one beside the field NAME. Throws gale::Error if that
/// isn't a permutation of 0..vertices-1.
VertexOrder order_of(const Mesh& mesh, const io::Dataset& dataset, const io::PointArray& field);

/// The labels of the segments that the dataset brings: the array called `name`; without a name those that TTK's users know, or none.
/// Throws gale::Error if there is no such array, or if it isn't of whole numbers, one a point.
const io::PointArray* find_segments(const io::Dataset& dataset, const std::string& name);
std::vector<std::int64_t> labels_of(const io::PointArray& segments);

/// The name under which segments are written, and found.
inline constexpr const char* segments_name = "ttkCompactTriangulationIndex";

}  // namespace gale::app
