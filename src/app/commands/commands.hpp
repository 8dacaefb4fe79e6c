#pragma once

#include <memory>

#include <gale/app/commands/command.hpp>

namespace gale::app {

/// Adds a subcommand to the command line. `app` must outlive it.
using AddCommand = std::unique_ptr<Command>(CLI::App& app);

AddCommand add_info;
AddCommand add_segment;
AddCommand add_critical_points;
AddCommand add_discrete_gradient;
AddCommand add_morse_smale;
AddCommand add_relations;
AddCommand add_generate;

/// All subcommands, in the order of the help.
inline constexpr AddCommand* all_commands[] = {
    add_info, add_segment, add_critical_points, add_discrete_gradient, add_morse_smale, add_relations, add_generate};

}  // namespace gale::app
