#pragma once

#include <string>

#include <gale/algorithms/vertex_order.hpp>
#include <gale/export.hpp>
#include <gale/io/dataset.hpp>

namespace gale::outputs::detail {

/// The dataset's point array of that name, or nullptr. Of several the first.
GALE_EXPORT const io::PointArray* find_array(const io::Dataset& dataset, const std::string& name);

/// "the input has A, B": for messages.
GALE_EXPORT std::string names_of_arrays(const io::Dataset& dataset);

}  // namespace gale::outputs::detail

namespace gale::outputs {

/// Whether an array can be the field where none is named: one number a point, neither a segmentation (`find_segments`)
/// nor an order (its name ends in _Order), nor what a mesh in pieces says of its points (GlobalPointIds, vtkGhostType).
/// `is_whole`: its type is one of whole numbers.
GALE_EXPORT bool may_be_field(const std::string& name, int components, bool is_whole);

/// A copy of the point array to analyse, which has one component: the array called `name`, or component K (from 0) of
/// NAME where `name` is NAME_K. With an empty `name` the first array that `may_be_field`. Throws gale::Error, with the
/// names that there are, if there is none, or if the array called `name` has several components.
GALE_EXPORT io::PointArray select_field(const io::Dataset& dataset, const std::string& name);

/// The name of the array that add_height() makes.
inline constexpr const char* height_name = "Height";

/// Gives a dataset the coordinate `axis` (0 to 2) of its points as its first array, `Height`, in the points' type: a
/// field for surfaces that have none. An array of the input that has this name goes.
GALE_EXPORT void add_height(io::Dataset& dataset, int axis);

/// The mesh of a dataset's tetrahedra, or of its triangles where it has these. Throws gale::Error as Mesh does.
GALE_EXPORT Mesh mesh_of(const io::Dataset& dataset, const Segmentation& segmentation);

/// Whether a mesh is that of a dataset, whose points may be elsewhere: it has as many vertices, and its cells are the
/// same, each with its corners in any order. In parallel on the host, O(cells); of two grids O(1) or O(points / 64).
GALE_EXPORT bool is_mesh_of(const Mesh& mesh, const io::Dataset& dataset);

/// The value of a field at an input vertex, which must be there.
inline double value_at(const io::PointArray& field, Id vertex) {
  return std::visit([vertex](const auto& values) { return static_cast<double>(values[vertex]); }, field.values);
}

/// Whether a field has whole numbers beyond 2^53, which value_at may round.
GALE_EXPORT bool is_rounded(const io::PointArray& field);

/// What orders vertices: the field's values; or, where the dataset has an array NAME_Order of one component beside the
/// field NAME, that one. Refers to either.
GALE_EXPORT const io::PointArray& order_array(const io::Dataset& dataset, const io::PointArray& field);

/// What orders so many vertices: their order_array. Throws as order_of does but for NaN. `note` is told where that
/// contradicts the field.
GALE_EXPORT const io::PointArray& order_values(const io::Dataset& dataset, const io::PointArray& field,
                                               std::size_t vertices, std::string* note = nullptr);

/// A note for a field NAME whose NAME_Order has a vertex right after one with a higher value.
GALE_EXPORT std::string contradiction(const std::string& field, GlobalId lower, GlobalId before);

/// A note if an array that orders the vertices of a mesh, which lies on several ranks, contradicts the field; else
/// empty. Both have values by input id of the part. Throws SharedError if the order isn't a permutation of 0 to
/// vertices-1. Collective.
GALE_EXPORT std::string note_of_order(const Mesh& mesh, const io::PointArray& order, const io::PointArray& field);

/// The order of the field's values; or, where the dataset has an array NAME_Order of one component beside the field
/// NAME, that order, whatever the values: `note` is told of the first vertex that contradicts it. Throws gale::Error,
/// with array and vertex, if NAME_Order isn't a permutation of 0 to vertices-1, and as `VertexOrder` does.
GALE_EXPORT VertexOrder order_of(const Mesh& mesh, const io::Dataset& dataset, const io::PointArray& field,
                                 std::string* note = nullptr);

}  // namespace gale::outputs
