#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gale/outputs/analyses.hpp>

#include "arrays.hpp"

namespace gale::python {

/// A persistence diagram in columns.
nb::dict numpy_of(const std::vector<outputs::DiagramPoint>& diagram);

/// What an analysis has found, by the names of its results.
nb::dict results_of(std::map<std::string, outputs::Outcome> found);

/// What an analysis is given, by the names of its options; of a threshold also whether it is a share of the range.
outputs::Settings settings_of(const std::map<std::string, bool>& flags,
                              const std::map<std::string, std::pair<double, bool>>& thresholds,
                              const std::map<std::string, std::string>& choices,
                              const std::map<std::string, int>& numbers);

}  // namespace gale::python
