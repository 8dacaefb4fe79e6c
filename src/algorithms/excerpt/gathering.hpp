#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gale/export.hpp>
#include <gale/mesh/ranks.hpp>

namespace gale::detail {

/// Throws gale::Error on all ranks if one would gather more bytes than `most`, or for 0 than its share of what memory
/// its machine has left: `what` it is, and how much. `bytes` are what this rank has for each. Memory beside what is
/// sent, to sort it, is taken into account. Collective.
GALE_EXPORT void require_room(const Ranks& ranks, const char* what, const std::vector<std::int64_t>& bytes,
                              std::size_t most);

}  // namespace gale::detail
