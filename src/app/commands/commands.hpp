#pragma once

#include <gale/app/options.hpp>

// The subcommands. Each does what its name says with the input that the options name; throws gale::Error or UsageError.

namespace gale::app {

void info(const Options& options);
void segment(const Options& options);
void critical_points(const Options& options);
void discrete_gradient(const Options& options);
void morse_smale(const Options& options);
void relations(const Options& options);
void generate(const Options& options);

}  // namespace gale::app
