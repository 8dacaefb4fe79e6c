#pragma once

#include <array>
#include <cstdint>

#include <gale/app/session.hpp>

namespace gale::app {

/// Says and reports how many critical points there are, by CriticalType but `regular`.
void tell_points(const std::array<std::int64_t, 5>& counts, Session& session);

/// Says and reports how many critical simplices there are, by dimension.
void tell_simplices(const std::array<std::int64_t, 4>& counts, Session& session);

}  // namespace gale::app
