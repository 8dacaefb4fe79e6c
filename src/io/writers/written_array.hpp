#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include <gale/io/bytes/value_type.hpp>
#include <gale/io/write.hpp>

namespace gale::io::detail {

/// An array on its way into a file. Its values stay where they are, or are made when they are asked for.
struct WrittenArray {
  std::string name;
  int components;
  ValueType type;
  std::uint64_t count;  ///< values, not rows

  /// Puts the values [begin, end) to `to`, in this machine's order of bytes. Any number of threads may call it.
  std::function<void(std::uint64_t begin, std::uint64_t end, char* to)> copy;
};

/// An array of values that outlive it.
WrittenArray written(const PointArray& array);
WrittenArray written(const Dataset::Positions& points);

/// All arrays. The later of two with one name takes the place of the earlier. One without a name is called "unnamed",
/// as VTK reads no other.
std::vector<WrittenArray> written(std::initializer_list<const std::vector<PointArray>*> arrays);

/// Whose k-th value is value(k).
template <class T, class Value>
WrittenArray made(const std::string& name, std::uint64_t count, const Value& value) {
  return {name, 1, value_type_of<T>(), count, [value](std::uint64_t begin, std::uint64_t end, char* to) {
            for (std::uint64_t k = begin; k < end; ++k, to += sizeof(T)) {
              const T made = static_cast<T>(value(k));
              std::memcpy(to, &made, sizeof(T));
            }
          }};
}

/// An array of integers, in the narrower of two types that holds values of up to `most`.
template <class Value>
WrittenArray made_integers(const std::string& name, std::uint64_t count, std::uint64_t most, const Value& value) {
  return most <= std::numeric_limits<std::int32_t>::max() ? made<std::int32_t>(name, count, value)
                                                          : made<std::int64_t>(name, count, value);
}

}  // namespace gale::io::detail
