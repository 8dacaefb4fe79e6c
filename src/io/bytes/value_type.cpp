#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/value_type.hpp>

namespace gale::io::detail {

std::size_t size_of(ValueType type) {
  return with_type(type, [](auto value) { return sizeof(value); });
}

const char* name_of(ValueType type) {
  static const char* const names[] = {"int8",   "uint8", "int16",  "uint16",  "int32",
                                      "uint32", "int64", "uint64", "float32", "float64"};
  return names[static_cast<int>(type)];
}

const char* xml_name_of(ValueType type) {
  static const char* const names[] = {"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                      "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  return names[static_cast<int>(type)];
}

void require_size(const PointArray& array, std::uint64_t points) {
  const auto components = static_cast<std::uint64_t>(array.components);
  if (count_of(array.values) / components == points && count_of(array.values) % components == 0) return;
  damaged("the array '" + array.name + "' has " + std::to_string(count_of(array.values) / components) + " tuples for " +
          std::to_string(points) + " points");
}

}  // namespace gale::io::detail
