#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include <gale/io/dataset.hpp>

namespace gale::io::detail {

/// The types of values in files, in the order of the alternatives of `PointArray::Values`.
enum class ValueType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// In bytes.
std::size_t size_of(ValueType type);

/// "int8" to "float64", for messages.
const char* name_of(ValueType type);

/// "Int8" to "Float64", as VTK's XML files have them.
const char* xml_name_of(ValueType type);

/// The type of values of the C++ type T.
template <class T>
ValueType value_type_of() {
  return static_cast<ValueType>(PointArray::Values(std::vector<T>()).index());
}

/// Calls use(T()) with the C++ type of `type`, and returns what that returns.
template <class Use>
decltype(auto) with_type(ValueType type, const Use& use) {
  switch (type) {
    case ValueType::int8:
      return use(std::int8_t());
    case ValueType::uint8:
      return use(std::uint8_t());
    case ValueType::int16:
      return use(std::int16_t());
    case ValueType::uint16:
      return use(std::uint16_t());
    case ValueType::int32:
      return use(std::int32_t());
    case ValueType::uint32:
      return use(std::uint32_t());
    case ValueType::int64:
      return use(std::int64_t());
    case ValueType::uint64:
      return use(std::uint64_t());
    case ValueType::float32:
      return use(float());
    case ValueType::float64:
      break;
  }
  return use(double());
}

/// How many values there are, of whatever type.
inline std::size_t count_of(const PointArray::Values& values) {
  return std::visit([](const auto& v) { return v.size(); }, values);
}

/// Throws gale::Error unless the array has values for so many points.
void require_size(const PointArray& array, std::uint64_t points);

}  // namespace gale::io::detail
