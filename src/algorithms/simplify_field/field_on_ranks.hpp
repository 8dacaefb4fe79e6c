#pragma once

#include <functional>

#include <gale/algorithms/simplify_field.hpp>

namespace gale::detail {

/// simplify_field of a mesh that lies on several ranks: it is gathered on the first one (`WholeMesh`), simplified
/// there, and each rank gets what it holds. Collective; throws gale::Error on all ranks, before anything is sent, where
/// there is no room.
SimplifiedField simplified_on_ranks(const VertexOrder& order, const std::function<double(Id)>& value, double threshold,
                                    const ComputeOptions& options, Computed* computed);

/// simplify_field by the extrema that stay, of which each rank names some that it holds, by its input ids.
SimplifiedField simplified_on_ranks(const VertexOrder& order, const StayingExtrema& staying,
                                    const ComputeOptions& options, Computed* computed);

}  // namespace gale::detail
