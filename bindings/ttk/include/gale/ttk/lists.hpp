#pragma once

#include <algorithm>
#include <vector>

#include <gale/base/types.hpp>

// The lists of all rows that TTK can ask for: made anew each time, in memory that is kept.

namespace gale::ttk::detail {

/// find(i): the members of the i-th.
template <class List, class Find>
const List* list(List& all, Id count, const Find& find) {
  all.resize(count);
  for (Id i = 0; i < count; ++i) {
    const auto& found = find(i);
    std::copy(found.begin(), found.end(), all[i].begin());
  }
  return &all;
}

/// size(i) entries in row i: entry(i, k).
template <class SimplexId, class Size, class Entry>
const std::vector<std::vector<SimplexId>>* list_rows(std::vector<std::vector<SimplexId>>& all, Id count,
                                                     const Size& size, const Entry& entry) {
  all.resize(count);
  for (Id simplex = 0; simplex < count; ++simplex) {
    all[simplex].resize(size(simplex));
    for (int k = 0; k < static_cast<int>(all[simplex].size()); ++k) all[simplex][k] = entry(simplex, k);
  }
  return &all;
}

}  // namespace gale::ttk::detail
