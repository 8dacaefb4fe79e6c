#pragma once

#include <map>
#include <string>
#include <vector>

#include <gale/outputs/analyses.hpp>

#include "mesh.hpp"

namespace gale::python {

/// A persistence diagram in columns.
nb::dict numpy_of(const std::vector<outputs::DiagramPoint>& diagram);

/// What an analysis has found, by the names of its results, and a "note" of the order, which may be empty.
nb::dict results_of(std::map<std::string, outputs::Outcome> found, const std::string& note);

/// What an analysis is given.
outputs::Settings settings_of(const GivenOptions& given);

}  // namespace gale::python
