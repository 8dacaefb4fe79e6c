#pragma once

#include <vector>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/app/drawing/shown_paths.hpp>
#include <gale/io/write.hpp>

namespace gale::app {

/// A picture of a complex: the mesh without the octant of its high corner, its skin in a pale colour for each
/// Morse-Smale manifold that is as bright as `field` is high; in the octant the critical simplices, as balls, and the
/// lines of `separatrices1`, as smooth tubes: where they are many, those along which the field changes most and the
/// critical simplices that they join; and a legend. `critical` and `separatrices1` are what outputs/ makes of the
/// complex; of `numbers` only `on_surface` is read.
Scene picture_of(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex,
                 const SimplexNumbers& numbers, const io::PointSet& critical, const io::Surface& separatrices1);

/// Colours of critical simplices, by dimension.
inline constexpr Color color_of_dimension[] = {{26, 89, 217}, {0, 140, 90}, {245, 150, 16}, {214, 31, 36}};
/// Colours of 1-separatrices, by type: descending, connectors, ascending.
inline constexpr Color color_of_type[] = {{60, 110, 225}, {110, 110, 118}, {225, 70, 60}};

/// Size of a picture, and the part of its width that is left of the legend.
inline constexpr int picture_width = 1200, picture_height = 800;
inline constexpr double part_left_of_legend = 0.74;

/// The legend of a picture of a complex: what it has of each kind, in which colour, and what of it is shown. `skin` are
/// colours of manifolds.
Flat legend_of(const MorseSmaleComplex& complex, const ShownPaths& shown, const std::vector<Color>& skin);

}  // namespace gale::app
