#pragma once

#include <memory>
#include <string>

#include <gale/app/commands/command.hpp>

namespace gale::app {

// Each adds its subcommand to the command line, which must outlive it.
std::unique_ptr<Command> add_info(CLI::App& app);
std::unique_ptr<Command> add_segment(CLI::App& app);
std::unique_ptr<Command> add_critical_points(CLI::App& app);
std::unique_ptr<Command> add_discrete_gradient(CLI::App& app);
std::unique_ptr<Command> add_morse_smale(CLI::App& app);
std::unique_ptr<Command> add_persistence_diagram(CLI::App& app);
std::unique_ptr<Command> add_relations(CLI::App& app);
std::unique_ptr<Command> add_generate(CLI::App& app);

/// The analyses, their options and results (outputs/analyses.hpp), as JSON.
std::string analyses_as_json();

/// The table of all subcommands, in the order of the help.
using AddCommand = std::unique_ptr<Command> (*)(CLI::App& app);
inline constexpr AddCommand all_commands[] = {
    add_info,      add_segment, add_critical_points, add_discrete_gradient, add_morse_smale, add_persistence_diagram,
    add_relations, add_generate};

}  // namespace gale::app
