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

}  // namespace gale::io::detail
