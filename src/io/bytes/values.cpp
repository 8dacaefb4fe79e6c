#include <algorithm>
#include <limits>
#include <string>

#include <gale/base/stop.hpp>
#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/numbers.hpp>
#include <gale/io/bytes/values.hpp>

namespace gale::io::detail {

namespace {

constexpr std::size_t bytes_at_once = 1 << 20;  // they stay in the cache between the steps

[[noreturn]] void ends_early(std::uint64_t has, std::uint64_t count, ValueType type) {
  damaged("it ends after " + std::to_string(has) + " of " + std::to_string(count) + " values of type " + name_of(type));
}

[[noreturn]] void has_too_little(std::uint64_t can_come, std::uint64_t count, ValueType type) {
  damaged("no more than " + std::to_string(can_come) + " of " + std::to_string(count) + " values of type " +
          name_of(type) + " can follow");
}

/// The next number of the text; false at its end.
template <class T>
bool next(TextReader& text, ValueType type, T& value) {
  const std::string_view word = text.word();
  if (word.empty()) return false;
  if (!parse(word, value)) {
    damaged("'" + std::string(word.substr(0, 40)) + "' is no value of type " + name_of(type));
  }
  return true;
}

}  // namespace

PointArray::Values read_values(ByteSource& source, ValueType type, std::uint64_t count, ByteOrder order) {
  return with_type(type, [&](auto example) -> PointArray::Values {
    using T = decltype(example);
    const std::uint64_t can_come = source.at_most() / sizeof(T);
    if (count > can_come) has_too_little(can_come, count, type);
    std::vector<T> values;
    values.reserve(count);
    while (values.size() < count) {
      gale::detail::stop_if_asked();
      const std::size_t begin = values.size();
      const std::size_t wanted = std::min<std::size_t>(count - begin, bytes_at_once / sizeof(T));
      values.resize(begin + wanted);
      const std::size_t got = source.read(reinterpret_cast<char*>(&values[begin]), wanted * sizeof(T));
      if (got < wanted * sizeof(T)) ends_early(begin + got / sizeof(T), count, type);
      to_machine_order(&values[begin], wanted, order);
    }
    return values;
  });
}

PointArray::Values read_text_values(TextReader& text, ValueType type, std::uint64_t count) {
  return with_type(type, [&](auto example) -> PointArray::Values {
    using T = decltype(example);
    const std::uint64_t can_come = text.at_most() / 2 + 1;  // a digit and a space each
    if (count > can_come) has_too_little(can_come, count, type);
    std::vector<T> values;
    values.reserve(count);
    for (T value; values.size() < count; values.push_back(value)) {
      if (!next(text, type, value)) ends_early(values.size(), count, type);
    }
    return values;
  });
}

PointArray::Values read_all_text_values(TextReader& text, ValueType type) {
  return with_type(type, [&](auto example) -> PointArray::Values {
    using T = decltype(example);
    std::vector<T> values;
    for (T value; next(text, type, value);) values.push_back(value);
    return values;
  });
}

std::uint64_t product(std::initializer_list<std::int64_t> factors, const char* what) {
  constexpr std::uint64_t most = std::uint64_t(1) << 62;
  std::uint64_t result = 1;
  for (const std::int64_t factor : factors) {
    if (factor < 0) damaged(std::string(what) + " of " + std::to_string(factor));
    if (factor > 0 && result > most / static_cast<std::uint64_t>(factor)) {
      damaged(std::string(what) + " whose product no file can have");
    }
    result *= static_cast<std::uint64_t>(factor);
  }
  return result;
}

}  // namespace gale::io::detail
