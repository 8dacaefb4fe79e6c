#pragma once

#include <cstdint>
#include <vector>

#include <gale/algorithms/critical_simplices.hpp>
#include <gale/app/console.hpp>
#include <gale/app/report.hpp>
#include <gale/app/session.hpp>

namespace gale::app {

/// Says and reports how many critical points there are, by CriticalType but `regular`.
void tell_points(const std::vector<std::int64_t>& counts, const Console& console, Report& report);

/// Says and reports how many critical simplices there are.
void tell(const CriticalSimplices& critical, Session& session);
void tell_simplices(const std::vector<std::int64_t>& counts, const Console& console, Report& report);

}  // namespace gale::app
