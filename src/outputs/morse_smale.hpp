#pragma once

#include <optional>
#include <vector>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/export.hpp>
#include <gale/io/write.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/excerpt.hpp>
#include <gale/outputs/persistence.hpp>

// A Morse-Smale complex from the gradient to its outputs, for those who want all of them.

namespace gale::outputs {

/// A part of a complex that users can switch on or off.
struct PartOfComplex {
  const char* option;                ///< the name of the option that does so
  bool MorseSmaleParts::*is_wanted;  ///< what it sets
  const char* property;              ///< its name among the properties of VTK's filters
  const char* help;                  ///< what the part is
};

/// All of them.
inline constexpr PartOfComplex parts_of_complexes[] = {
    {"descending_separatrices", &MorseSmaleParts::descending_separatrices, "ComputeDescendingSeparatrices1",
     "The 1-separatrices from 1-saddles down to minima"},
    {"ascending_separatrices", &MorseSmaleParts::ascending_separatrices, "ComputeAscendingSeparatrices1",
     "The 1-separatrices from 2-saddles up to maxima"},
    {"saddle_connectors", &MorseSmaleParts::saddle_connectors, "ComputeSaddleConnectors",
     "The 1-separatrices from 1-saddles to 2-saddles"},
    {"separatrices2", &MorseSmaleParts::separatrices2, "ComputeSeparatrices2",
     "The 2-separatrices, walls of triangles below 2-saddles and of polygons above 1-saddles. Large"},
    {"descending_segmentation", &MorseSmaleParts::descending_manifolds, "ComputeDescendingSegmentation",
     "The minimum that each vertex falls to"},
    {"ascending_segmentation", &MorseSmaleParts::ascending_manifolds, "ComputeAscendingSegmentation",
     "The maximum that each vertex rises to"}};

/// What a user asks of a Morse-Smale complex.
struct GALE_EXPORT MorseSmaleRequest {
  MorseSmaleParts parts;                   ///< what is wanted
  std::optional<Persistence> persistence;  ///< simplify below this threshold
  bool extrema_only = false;               ///< cancel no saddles with one another

  /// What has to be found for that: a simplification needs the connectors, and so do the arrays of walls.
  MorseSmaleParts needed_parts() const;
};

/// The complex of a gradient with the needed parts, simplified if that is wanted. `field` is that of the gradient.
/// Throws as find_morse_smale_complex, simplify and threshold_of do.
GALE_EXPORT MorseSmaleComplex find_complex(const DiscreteGradient& gradient, const io::PointArray& field,
                                           const MorseSmaleRequest& request, const ComputeOptions& options = {},
                                           Computed* computed = nullptr);

/// What files and pictures show of a complex, but for walls and manifolds, which are made when they are asked for.
class GALE_EXPORT ShownComplex {
 public:
  /// Takes out of a complex the separatrices that aren't wanted, and were found because something else needed them.
  /// Refers to complex, dataset and field. Adds the time that this takes to `seconds`, but for what numbers take.
  /// Collective.
  ShownComplex(MorseSmaleComplex& found, const MorseSmaleParts& wanted, const io::Dataset& dataset,
               const io::PointArray& field, const ComputeOptions& options, Computed& computed, double& seconds);

  /// The walls, if they were found. Collective.
  io::Surface separatrices2() const;

  const MorseSmaleComplex& complex;  ///< with what is wanted of it
  SimplexNumbers numbers;            ///< numbers of what `named_simplices` names
  io::PointSet critical_points;      ///< to_point_set, and manifold_sizes
  io::Surface separatrices1;         ///< lines

 private:
  Separatrices<TriangleVertices> connectors_;  ///< the ends of all, wanted or not: they bound walls
  std::optional<AtExcerpt> at_;
  KnownSimplices critical_;
};

/// Everything that a complex is written as. What isn't wanted is empty.
struct MorseSmaleOutputs {
  io::PointSet critical_points;           ///< to_point_set, and manifold_sizes
  io::Surface separatrices1;              ///< lines
  io::Surface separatrices2;              ///< polygons
  std::vector<io::PointArray> manifolds;  ///< arrays of the mesh's vertices, in input order
  KeptBelow kept_below;                   ///< pairs of saddles that simplification had to leave
};

/// Finds the complex and makes its outputs. `dataset` has the points and arrays that travel with the critical points.
/// Throws as what it calls.
GALE_EXPORT MorseSmaleOutputs morse_smale(const DiscreteGradient& gradient, const io::Dataset& dataset,
                                          const io::PointArray& field, const MorseSmaleRequest& request,
                                          const ComputeOptions& options = {}, Computed* computed = nullptr);

}  // namespace gale::outputs
