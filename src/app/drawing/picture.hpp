#pragma once

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/app/drawing/scene.hpp>
#include <gale/io/write.hpp>

namespace gale::app {

/// A picture of a complex: the mesh without the octant of its high corner, its skin in a pale colour for each
/// Morse-Smale manifold that is as bright as `field` is high; in the octant the critical simplices, as balls, and the
/// lines of `separatrices1`, as smooth tubes: where they are many, those along which the field changes most and the
/// critical simplices that they join; and a legend. `critical` and `separatrices1` are what outputs/ makes of the
/// complex; of `numbers` only `on_surface` is read.
Scene picture_of(const io::Dataset& dataset, const io::PointArray& field, const MorseSmaleComplex& complex,
                 const SimplexNumbers& numbers, const io::PointSet& critical, const io::Surface& separatrices1);

}  // namespace gale::app
