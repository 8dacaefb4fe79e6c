#pragma once

#include <limits>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/types.hpp>

namespace gale {

/// Throws gale::Error if so many of what `name` says, e.g. "edges", are more than an Id counts.
inline void require_ids(const char* name, Offset count) {
  if (count <= std::numeric_limits<Id>::max()) return;
  throw Error(std::to_string(count) + ' ' + name + " are too many: ids have 32 bits, at most 2147483647 fit");
}

}  // namespace gale
