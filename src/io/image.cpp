#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/types.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/image.hpp>

namespace gale::io {
namespace {

using detail::refuse;

std::string component_name(const PointArray& array, int component) {
  return array.name + "_" + std::to_string(component);
}

/// The array of that name, or the component of that name as a new array at the end. `arrays.end()` if there is neither.
auto find_or_extract(std::vector<PointArray>& arrays, const std::string& name) {
  const auto named = std::find_if(arrays.begin(), arrays.end(), [&](const PointArray& a) { return a.name == name; });
  if (named != arrays.end()) return named;
  for (const PointArray& array : arrays) {
    for (int c = 0; array.components > 1 && c < array.components; ++c) {
      if (component_name(array, c) != name) continue;
      PointArray component = extract_component(array, c);
      arrays.push_back(std::move(component));
      return std::prev(arrays.end());
    }
  }
  return arrays.end();
}

std::string names(const std::vector<PointArray>& arrays) {
  std::string list;
  for (const PointArray& array : arrays) list += (list.empty() ? "'" : ", '") + array.name + "'";
  return list;
}

}  // namespace

void select_scalars(Image& image, const std::string& name) {
  if (image.arrays.empty()) throw Error("the image has no scalars");
  const auto chosen = name.empty() ? image.arrays.begin() : find_or_extract(image.arrays, name);
  if (chosen == image.arrays.end()) refuse("the image has no array '", name, "', only ", names(image.arrays));
  if (chosen->components != 1)
    refuse("the array '", chosen->name, "' has ", chosen->components, " components: choose one of '",
           component_name(*chosen, 0), "' to '", component_name(*chosen, chosen->components - 1), "'");
  std::rotate(image.arrays.begin(), chosen, chosen + 1);
}

void rescale(Image& image, double slope, double intercept) {
  const bool changes =
      slope != 0 && std::isfinite(slope) && std::isfinite(intercept) && !(slope == 1 && intercept == 0);
  if (!changes) return;
  const auto scaled = [&](const auto& from) -> PointArray::Values {
    using From = typename std::decay_t<decltype(from)>::value_type;
    using To = std::conditional_t<(sizeof(From) < 4) || std::is_same_v<From, float>, float, double>;
    std::vector<To> to(from.size());
    std::transform(from.begin(), from.end(), to.begin(),
                   [&](From v) { return static_cast<To>(slope * v + intercept); });
    return to;
  };
  for (PointArray& array : image.arrays) array.values = std::visit(scaled, array.values);
}

void detail::require_ids_for(const std::string& these, double count, const std::string& of_what) {
  if (count <= std::numeric_limits<Id>::max()) return;
  std::ostringstream digits;
  digits << std::fixed << std::setprecision(0) << count;
  refuse(these, " ", digits.str(), " ", of_what, ", more than the ", std::numeric_limits<Id>::max(),
         " that 32-bit ids can number");
}

}  // namespace gale::io
