#include <gale/outputs/find_array.hpp>

namespace gale::outputs::detail {

const io::PointArray* find_array(const io::Dataset& dataset, const std::string& name) {
  for (const auto& array : dataset.arrays) {
    if (array.name == name) return &array;
  }
  return nullptr;
}

std::string names_of_arrays(const io::Dataset& dataset) {
  std::string names;
  for (const auto& array : dataset.arrays) names += (names.empty() ? "" : ", ") + array.name;
  return names.empty() ? "the input has no point arrays" : "the input has " + names;
}

}  // namespace gale::outputs::detail
