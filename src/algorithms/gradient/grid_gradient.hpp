#pragma once

#include <gale/algorithms/gradient/gradient_store.hpp>
#include <gale/runtime/sweep_options.hpp>

namespace gale::detail {

/// Pairs all lower stars of a grid by threads of the host, without a structure.
void pair_on_grid(GradientStore& store, int consumers, const SweepOptions& options);

}  // namespace gale::detail
