#include <algorithm>
#include <string>

#include <gale/base/stop.hpp>
#include <gale/io/bytes/values.hpp>

namespace gale::io::detail {
namespace {

constexpr std::size_t bytes_at_once = 1 << 20;  // so few stay in the cache between the steps

[[noreturn]] void ends_early(std::uint64_t has, std::uint64_t count, ValueType type) {
  damaged("it ends after ", has, " of ", count, " values of type ", name_of(type));
}

/// Throws gale::Error if less can come.
void require_to_come(std::uint64_t can_come, std::uint64_t count, ValueType type) {
  if (count > can_come)
    damaged("no more than ", can_come, " of ", count, " values of type ", name_of(type), " can follow");
}

/// The first of the names in such a list; what is behind it stays.
std::string_view take_name(std::string_view& list) {
  const std::string_view name = list.substr(0, list.find('|'));
  list.remove_prefix(std::min(list.size(), name.size() + 1));
  return name;
}

}  // namespace

std::optional<ValueType> find_type(const TypeNames& names, std::string_view name) {
  for (std::size_t k = 0; k < names.size(); ++k) {
    for (std::string_view list = names[k]; !list.empty();) {
      if (take_name(list) == name) return static_cast<ValueType>(k);
    }
  }
  return std::nullopt;
}

std::string_view name_in(const TypeNames& names, ValueType type) {
  std::string_view list = names[static_cast<std::size_t>(type)];
  return take_name(list);
}

const char* name_of(ValueType type) {
  static const char* const names[] = {"int8",   "uint8", "int16",  "uint16",  "int32",
                                      "uint32", "int64", "uint64", "float32", "float64"};
  return names[static_cast<int>(type)];
}

std::size_t size_of(ValueType type) {
  return with_type(type, [](auto value) { return sizeof(value); });
}

const PointArray::Values& no_values(ValueType type) {
  static const PointArray::Values none[] = {std::vector<std::int8_t>(),  std::vector<std::uint8_t>(),
                                            std::vector<std::int16_t>(), std::vector<std::uint16_t>(),
                                            std::vector<std::int32_t>(), std::vector<std::uint32_t>(),
                                            std::vector<std::int64_t>(), std::vector<std::uint64_t>(),
                                            std::vector<float>(),        std::vector<double>()};
  return none[static_cast<int>(type)];
}

void require_size(const PointArray& array, std::uint64_t points) {
  const auto components = static_cast<std::uint64_t>(array.components);
  const std::uint64_t tuples = count_of(array.values) / components;
  if (tuples != points || count_of(array.values) % components != 0)
    damaged("the array '", array.name, "' has ", tuples, " tuples for ", points, " points");
}

PointArray::Values read_values(ByteSource& source, ValueType type, std::uint64_t count, ByteOrder order) {
  return with_type(type, [&](auto example) -> PointArray::Values {
    using T = decltype(example);
    require_to_come(source.at_most() / sizeof(T), count, type);
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

PointArray::Values read_text_values(TextReader& text, ValueType type, std::optional<std::uint64_t> count) {
  return with_type(type, [&](auto value) -> PointArray::Values {
    if (count) require_to_come(text.at_most() / 2 + 1, *count, type);  // a digit and a space each
    std::vector<decltype(value)> values;
    values.reserve(count.value_or(0));
    while (values.size() != count) {
      const std::string_view word = text.word();
      if (word.empty() && !count) break;
      if (word.empty()) ends_early(values.size(), *count, type);
      if (!parse(word, value)) damaged("'", word.substr(0, 40), "' is no value of type ", name_of(type));
      values.push_back(value);
    }
    return values;
  });
}

std::uint64_t product(std::initializer_list<std::int64_t> factors, const char* what) {
  constexpr std::uint64_t most = std::uint64_t(1) << 62;
  std::uint64_t result = 1;
  for (const std::int64_t factor : factors) {
    if (factor < 0) damaged(what, " of ", factor);
    if (factor > 0 && result > most / static_cast<std::uint64_t>(factor))
      damaged(what, " whose product no file can have");
    result *= static_cast<std::uint64_t>(factor);
  }
  return result;
}

}  // namespace gale::io::detail
