#pragma once

#include <functional>

#include <gale/algorithms/excerpt/wider_gradient.hpp>
#include <gale/algorithms/morse_smale.hpp>
#include <gale/algorithms/morse_smale/parts.hpp>

namespace gale::detail {

/// Makes the excerpt of a complex: of the simplices that its separatrices pass, which are those of a wider gradient,
/// and of all critical ones there; of all vertices there, where most are passed. From then on the complex names them as
/// the excerpt does. The excerpt knows which simplices are critical, and nothing else of the gradient; of a grid it is
/// made when somebody first asks for it. On this rank alone; throws what making a mesh does. The connectors are those
/// that `find_connectors` finds, if there is such a function; while it has kernels do so the host names what is on
/// paths.
void name_in_excerpt(const WiderGradient& wider, const std::function<FoundConnectors()>& find_connectors,
                     MorseSmaleComplex& complex);

}  // namespace gale::detail
