#pragma once

#include <gale/algorithms/critical_simplices.hpp>
#include <gale/app/session.hpp>

namespace gale::app {

/// Says and reports how many critical simplices there are.
void tell(const CriticalSimplices& critical, Session& session);

}  // namespace gale::app
