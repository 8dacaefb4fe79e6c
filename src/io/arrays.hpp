#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include <gale/base/error.hpp>
#include <gale/export.hpp>
#include <gale/io/dataset.hpp>

namespace gale::io {

/// How many points `array` has values for.
GALE_EXPORT std::size_t point_count(const PointArray& array);

/// The points that `ids` names, in that order: row k of the result is row `ids[k]` of `array`. `ids` is anything with
/// `size()` and `operator[]` (a vector, a rank-one View on the host). Throws `Error` for an id that `array` has no row
/// for.
template <class Ids>
PointArray gather(const PointArray& array, const Ids& ids);

/// Component `component` (counted from 0) of every point as an array of its own, called `array.name`_`component`.
GALE_EXPORT PointArray extract_component(const PointArray& array, int component);

namespace detail {

[[noreturn]] GALE_EXPORT void refuse_row(const PointArray& array, std::size_t row);

}  // namespace detail

template <class Ids>
PointArray gather(const PointArray& array, const Ids& ids) {
  const std::size_t rows = point_count(array), width = array.components, count = ids.size();
  const auto pick = [&](const auto& from) -> PointArray::Values {
    std::decay_t<decltype(from)> to(count * width);
    for (std::size_t k = 0; k < count; ++k) {
      const auto row = static_cast<std::size_t>(ids[k]);  // a negative id becomes a huge one
      if (row >= rows) detail::refuse_row(array, row);
      for (std::size_t c = 0; c < width; ++c) to[k * width + c] = from[row * width + c];
    }
    return to;
  };
  return {array.name, array.components, std::visit(pick, array.values)};
}

}  // namespace gale::io
