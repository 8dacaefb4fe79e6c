#pragma once

#include <gale/base/types.hpp>

namespace gale::detail {

/// The first of 0 to count - 1 of which is_before doesn't hold, which holds for all before it; `count` if there is
/// none.
template <class IsBefore>
Id first_from(Id count, const IsBefore& is_before) {
  Id first = 0;
  for (Id last = count; first < last;) {
    const Id middle = first + (last - first) / 2;
    if (is_before(middle)) {
      first = middle + 1;
    } else {
      last = middle;
    }
  }
  return first;
}

}  // namespace gale::detail
