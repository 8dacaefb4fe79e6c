#pragma once

#include <optional>
#include <string>

#include <gale/io/dataset.hpp>
#include <gale/outputs/persistence.hpp>

namespace CLI {
class App;
}

namespace gale::app {

/// Adds --persistence X[%], which sets `persistence`.
void add_persistence(CLI::App& app, std::optional<outputs::Persistence>& persistence, const std::string& what);

/// The threshold of --persistence; names the option in what goes wrong.
double threshold_of_option(const outputs::Persistence& persistence, const io::PointArray& field);

}  // namespace gale::app
