#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <type_traits>
#include <variant>

#include <gale/io/bytes/text.hpp>
#include <gale/io/dataset.hpp>

/// Values as files have them: their types, the order of their bytes, and how they are read.
namespace gale::io::detail {

/// The types of values in files, in the order of the alternatives of `PointArray::Values`.
enum class ValueType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// How a format calls these types, in their order; of several names, separated by '|', the first is written.
using TypeNames = std::array<std::string_view, 10>;

inline constexpr TypeNames xml_types = {"Int8",   "UInt8",           "Int16",  "UInt16",  "Int32",
                                        "UInt32", "Int64|vtkIdType", "UInt64", "Float32", "Float64"};

/// vtkIdType stands for int in legacy files: so it is written.
inline constexpr TypeNames legacy_types = {"signed_char|char",
                                           "unsigned_char",
                                           "short",
                                           "unsigned_short",
                                           "int|vtkidtype",
                                           "unsigned_int",
                                           "vtktypeint64|long",
                                           "vtktypeuint64|unsigned_long",
                                           "float",
                                           "double"};

/// The type that has the name; nothing for a name that none has.
std::optional<ValueType> find_type(const TypeNames& names, std::string_view name);

/// The name that is written.
std::string_view name_in(const TypeNames& names, ValueType type);

/// "int8" to "float64", for messages.
const char* name_of(ValueType type);

/// The size of a value in bytes.
std::size_t size_of(ValueType type);

/// The type of values of the C++ type T.
template <class T>
ValueType value_type_of() {
  return static_cast<ValueType>(PointArray::Values(std::vector<T>()).index());
}

/// A vector of none, in the C++ type of `type`.
GALE_EXPORT const PointArray::Values& no_values(ValueType type);

/// Calls use(T()) with the C++ type of `type`, and returns what that returns.
template <class Use>
decltype(auto) with_type(ValueType type, const Use& use) {
  return std::visit(
      [&](const auto& none) -> decltype(auto) { return use(typename std::decay_t<decltype(none)>::value_type()); },
      no_values(type));
}

/// How many values there are, of whatever type.
inline std::size_t count_of(const PointArray::Values& values) {
  return std::visit([](const auto& v) { return v.size(); }, values);
}

/// Throws gale::Error unless the array has values for so many points.
void require_size(const PointArray& array, std::uint64_t points);

enum class ByteOrder { little, big };

constexpr ByteOrder byte_order_of_machine() {
  return __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? ByteOrder::little : ByteOrder::big;
}

inline std::uint16_t reversed(std::uint16_t bits) { return __builtin_bswap16(bits); }
inline std::uint32_t reversed(std::uint32_t bits) { return __builtin_bswap32(bits); }
inline std::uint64_t reversed(std::uint64_t bits) { return __builtin_bswap64(bits); }

/// Makes `count` values, which lie as `order` says, values of this machine.
template <class T>
void to_machine_order(T* values, std::size_t count, ByteOrder order) {
  using Bits = std::conditional_t<sizeof(T) == 2, std::uint16_t,
                                  std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>;
  if (sizeof(T) == 1 || order == byte_order_of_machine()) return;
  for (std::size_t k = 0; k < count; ++k) {
    Bits bits = 0;
    std::memcpy(&bits, values + k, sizeof(T));
    bits = reversed(bits);
    std::memcpy(values + k, &bits, sizeof(T));
  }
}

/// The next `count` values. Memory is taken as they arrive: a file that claims more than it has costs nothing. Throws
/// gale::Error if the source ends before.
PointArray::Values read_values(ByteSource& source, ValueType type, std::uint64_t count, ByteOrder order);

/// The next `count` numbers of a text, or all up to its end. Throws gale::Error if there are less, or for one that the
/// type doesn't hold.
PointArray::Values read_text_values(TextReader& text, ValueType type, std::optional<std::uint64_t> count);

/// The product of the factors. Throws gale::Error if it is above 2^62, or a factor below 0. `what` they are is for the
/// message.
std::uint64_t product(std::initializer_list<std::int64_t> factors, const char* what);

/// The product of two sizes of an array. Throws gale::Error if it is above 2^62.
inline std::uint64_t product(std::uint64_t a, std::uint64_t b) {
  return product({static_cast<std::int64_t>(a), static_cast<std::int64_t>(b)}, "an array");
}

}  // namespace gale::io::detail
