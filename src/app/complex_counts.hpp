#pragma once

#include <array>
#include <cstdint>

#include <gale/algorithms/morse_smale.hpp>
#include <gale/app/console.hpp>
#include <gale/app/report.hpp>

namespace gale::app {

/// How many separatrices and manifolds a complex has.
struct ComplexCounts {
  std::int64_t descending = 0, ascending = 0, connectors = 0;  ///< separatrices
  std::int64_t ascending_manifolds = 0, descending_manifolds = 0, morse_smale_manifolds = 0;
};

/// Says and reports them; those of parts that aren't wanted are null.
void tell(const ComplexCounts& counts, const MorseSmaleParts& wanted, const Console& console, Report& report);

}  // namespace gale::app
