#pragma once

#include <gale/export.hpp>
#include <gale/io/dataset.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>

namespace gale::outputs::detail {

/// An array for `count` points, as a plan brings its values to them. Collective.
GALE_EXPORT io::PointArray brought(const gale::detail::ExchangePlan& plan, const Ranks& ranks,
                                   const io::PointArray& array, std::size_t count);

}  // namespace gale::outputs::detail
