#pragma once

#include <cstdint>

namespace gale {

/// Number of a simplex among those of its dimension, or of a segment; counted from 0.
using Id = std::int32_t;

/// Number of a vertex or a tetrahedron in a mesh that lies on several ranks; 0 or more, not necessarily without gaps.
using GlobalId = std::int64_t;

/// Position in an array that may have more than 2^31 entries.
using Offset = std::int64_t;

/// No simplex, or no segment.
inline constexpr Id no_id = -1;

}  // namespace gale
