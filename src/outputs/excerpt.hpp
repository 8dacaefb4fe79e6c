#pragma once

#include <gale/algorithms/morse_smale.hpp>
#include <gale/export.hpp>
#include <gale/io/dataset.hpp>
#include <gale/mesh/mesh.hpp>

namespace gale::outputs {

/// The mesh of a complex's excerpt, which lives as long as the complex. Collective: it is made where it isn't there, or
/// all ranks throw gale::Error.
GALE_EXPORT const Mesh& mesh_of_excerpt(const MorseSmaleComplex& complex);

/// The points of an excerpt's vertices (`MorseSmaleComplex::excerpt`), and their values of all arrays, by its input
/// ids, from the datasets of the ranks that own them, which are by input ids of their parts `mesh`, and have the same
/// arrays. Without cells. Collective.
GALE_EXPORT io::Dataset dataset_of(const Mesh& excerpt, const Mesh& mesh, const io::Dataset& dataset);

/// Which values of an array there are: those of all vertices that a rank holds, by input id, or of those alone that it
/// owns, in the order of their input ids, which follow one another.
enum class ValuesOf { held_vertices, owned_vertices };

/// The values of one array likewise. Collective.
GALE_EXPORT io::PointArray array_of(const Mesh& excerpt, const Mesh& mesh, const io::PointArray& array,
                                    ValuesOf values = ValuesOf::held_vertices);

/// Points and field of what an analysis has found in an excerpt, or where there is none, in the mesh itself.
class GALE_EXPORT AtExcerpt {
 public:
  /// Collective. Refers to the dataset and the field of the mesh. With the field alone there is nothing of an excerpt
  /// in dataset().
  AtExcerpt(const Mesh& excerpt, const Mesh& mesh, const io::Dataset& dataset, const io::PointArray& field,
            bool field_alone = false, ValuesOf values = ValuesOf::held_vertices);

  /// Points and arrays, by input ids of the excerpt, or of the mesh.
  const io::Dataset& dataset() const { return is_excerpt_ ? own_dataset_ : dataset_; }

  /// The field likewise.
  const io::PointArray& field() const { return is_excerpt_ ? own_field_ : field_; }

 private:
  const io::Dataset& dataset_;
  const io::PointArray& field_;
  const bool is_excerpt_;
  io::Dataset own_dataset_;
  io::PointArray own_field_;
};

namespace detail {

/// An array for `count` points, as a plan brings its values to them. Collective.
GALE_EXPORT io::PointArray brought(const gale::detail::ExchangePlan& plan, const Ranks& ranks,
                                   const io::PointArray& array, std::size_t count);

}  // namespace detail

}  // namespace gale::outputs
