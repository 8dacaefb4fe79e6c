#pragma once

#include <vector>

#include <gale/app/drawing/scene.hpp>
#include <gale/outputs/persistence.hpp>

namespace gale::app {

/// A persistence diagram and beside it its curve, both axes of which are logarithmic. What has a birth or a death that
/// isn't finite isn't drawn.
Flat plot_of(const std::vector<outputs::DiagramPoint>& diagram, const std::string& field);

}  // namespace gale::app
