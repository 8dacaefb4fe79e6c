#pragma once

#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/simplex_numbers.hpp>
#include <gale/app/drawing/scene.hpp>
#include <gale/io/write.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/heights.hpp>

namespace gale::app {

using namespace outputs;

/// A picture of a complex: the mesh without the octant of its high corner, its skin in a colour for each Morse-Smale
/// manifold that is as bright as the field is high; in the octant the critical simplices, as balls, and the lines of
/// `separatrices1`, as smooth tubes.
Scene picture_of(const io::Dataset& dataset, const MorseSmaleComplex& complex, const SimplexNumbers& numbers,
                 const io::PointSet& critical, const io::Surface& separatrices1, const Heights& heights);

}  // namespace gale::app
