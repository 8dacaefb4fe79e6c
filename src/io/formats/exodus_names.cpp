#include <algorithm>
#include <cctype>
#include <utility>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/cells/cell_types.hpp>
#include <gale/io/formats/exodus_names.hpp>

namespace gale::io::detail {

namespace {

// Exodus has the middles of edges between bottom and top before those of the top, VTK behind them.
const std::vector<std::uint8_t> hexahedron_20 = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15};
const std::vector<std::uint8_t> hexahedron_27 = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 16, 17,
                                                 18, 19, 12, 13, 14, 15, 23, 24, 25, 26, 21, 22, 20};
const std::vector<std::uint8_t> wedge_15 = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11};
const std::vector<std::uint8_t> wedge_18 = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11, 15, 16, 17};

constexpr int any = 0, as_many = 0;

/// Elements whose names begin like that.
struct Family {
  const char* name;
  int element_points;  ///< or any
  int cell_type;
  int cell_points;  ///< or as many as the element has
  const std::vector<std::uint8_t>* order = nullptr;
};

const Family families[] = {{"TET", 10, 24, 10},
                           {"TET", 11, 24, 10},
                           {"TET", 15, 71, 15},
                           {"TET", any, tetrahedron_type, 4},
                           {"HEX", 20, 25, 20, &hexahedron_20},
                           {"HEX", 21, 25, 20, &hexahedron_20},
                           {"HEX", 27, 29, 27, &hexahedron_27},
                           {"HEX", any, hexahedron_type, 8},
                           {"WED", 15, 26, 15, &wedge_15},
                           {"WED", 18, 32, 18, &wedge_18},
                           {"WED", 21, 73, 21},
                           {"WED", any, 13, 6},
                           {"PYR", 13, 27, 13},
                           {"PYR", any, 14, 5},
                           {"TRI", 6, 22, 6},
                           {"TRI", any, 5, 3},
                           {"QUA", 8, 23, 8},
                           {"QUA", 9, 28, 9},
                           {"QUA", any, 9, 4},
                           {"SHE", 3, 5, 3},
                           {"SHE", 8, 23, 8},
                           {"SHE", 9, 23, 8},
                           {"SHE", any, 9, 4},
                           {"TRU", 3, 21, 3},
                           {"TRU", any, 3, 2},
                           {"BEA", 3, 21, 3},
                           {"BEA", any, 3, 2},
                           {"BAR", 3, 21, 3},
                           {"BAR", any, 3, 2},
                           {"EDG", 3, 21, 3},
                           {"EDG", any, 3, 2},
                           {"STR", any, 3, 2},
                           {"SPH", any, 1, 1},
                           {"CIR", any, 1, 1},
                           {"SUP", any, 2, as_many}};

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

/// What is before those endings in all of the names that begin at `first`; empty if they don't end so.
std::string common_name(const std::vector<PointArray>& arrays, std::size_t first,
                        const std::vector<std::string>& endings) {
  if (arrays.size() - first < endings.size()) return "";
  std::string common;
  for (std::size_t k = 0; k < endings.size(); ++k) {
    const PointArray& array = arrays[first + k];
    const std::string& name = array.name;
    const std::size_t rest = name.size() - std::min(name.size(), endings[k].size());
    if (upper_case(name.substr(rest)) != endings[k] || array.values.index() != arrays[first].values.index()) return "";
    if (k == 0) common = name.substr(0, rest);
    if (name.substr(0, rest) != common) return "";
  }
  return common;
}

PointArray joined(const std::vector<PointArray>& arrays, std::size_t first, std::size_t count, std::string name,
                  std::size_t components) {
  return std::visit(
      [&](const auto& example) {
        using Vector = std::decay_t<decltype(example)>;
        Vector all(example.size() * components);
        for (std::size_t c = 0; c < count; ++c) {
          const auto& from = std::get<Vector>(arrays[first + c].values);
          for (std::size_t k = 0; k < from.size(); ++k) all[k * components + c] = from[k];
        }
        return PointArray{std::move(name), static_cast<int>(components), std::move(all)};
      },
      arrays[first].values);
}

}  // namespace

ElementType find_element_type(const std::string& name, std::uint64_t points, const std::string& array) {
  const std::string all = upper_case(name);
  for (const Family& family : families) {
    const bool is_it = all.compare(0, 3, family.name) == 0 &&
                       (family.element_points == any || static_cast<std::uint64_t>(family.element_points) == points);
    if (!is_it || points < static_cast<std::uint64_t>(family.cell_points)) continue;
    const std::size_t used = family.cell_points == as_many ? points : static_cast<std::size_t>(family.cell_points);
    return {family.cell_type, used, family.order != nullptr ? *family.order : std::vector<std::uint8_t>()};
  }
  throw Error("its '" + printable(array) + "' has elements of the type '" + printable(name) + "' with " +
              std::to_string(points) + " points each, which is unknown");
}

std::vector<PointArray> with_vectors(std::vector<PointArray> arrays, std::uint64_t dimensions) {
  static const std::vector<std::string> endings[] = {{"XX", "YY", "ZZ", "XY", "XZ", "YZ"}, {"X", "Y", "Z"}, {"X", "Y"}};
  std::vector<PointArray> result;
  for (std::size_t k = 0; k < arrays.size();) {
    std::size_t count = 1;
    for (const auto& some : endings) {
      std::string name = common_name(arrays, k, some);
      if (name.empty()) continue;
      count = some.size();
      result.push_back(joined(arrays, k, count, std::move(name), count == 2 && dimensions == 2 ? 3 : count));
      break;
    }
    if (count == 1) result.push_back(std::move(arrays[k]));
    k += count;
  }
  return result;
}

}  // namespace gale::io::detail
