#include <algorithm>
#include <cstring>

#include <gale/io/writers/written_array.hpp>

namespace gale::io::detail {

namespace {

template <class T>
WrittenArray of_values(const std::string& name, int components, const T* values, std::uint64_t count) {
  return {name, components, value_type_of<T>(), count, [values](std::uint64_t begin, std::uint64_t end, char* to) {
            if (end > begin) std::memcpy(to, values + begin, (end - begin) * sizeof(T));
          }};
}

}  // namespace

WrittenArray written(const PointArray& array) {
  return std::visit(
      [&](const auto& values) { return of_values(array.name, array.components, values.data(), values.size()); },
      array.values);
}

WrittenArray written(const Dataset::Positions& points) {
  return std::visit([](const auto& xyz) { return of_values("Points", 3, xyz.data(), 3 * xyz.extent(0)); }, points);
}

std::vector<WrittenArray> written(std::initializer_list<const std::vector<PointArray>*> arrays) {
  std::vector<WrittenArray> all;
  for (const auto* some : arrays) {
    for (const PointArray& array : *some) {
      WrittenArray one = written(array);
      if (one.name.empty()) one.name = "unnamed";
      const auto before =
          std::find_if(all.begin(), all.end(), [&](const WrittenArray& other) { return other.name == one.name; });
      if (before == all.end()) {
        all.push_back(std::move(one));
      } else {
        *before = std::move(one);
      }
    }
  }
  return all;
}

}  // namespace gale::io::detail
