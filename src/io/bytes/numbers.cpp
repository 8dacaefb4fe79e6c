#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <type_traits>

#include <gale/io/bytes/numbers.hpp>

namespace gale::io::detail {

template <class T>
bool parse(std::string_view word, T& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const auto [stop, failure] = std::from_chars(word.data(), end, value);
  if (stop != end || word.empty()) return false;
  if (failure == std::errc()) return true;
  if constexpr (std::is_floating_point_v<T>) {
    if (failure == std::errc::result_out_of_range) {
      value = static_cast<T>(std::strtod(std::string(word).c_str(), nullptr));
      return true;
    }
  }
  return false;
}

template bool parse(std::string_view, std::int8_t&);
template bool parse(std::string_view, std::uint8_t&);
template bool parse(std::string_view, std::int16_t&);
template bool parse(std::string_view, std::uint16_t&);
template bool parse(std::string_view, std::int32_t&);
template bool parse(std::string_view, std::uint32_t&);
template bool parse(std::string_view, std::int64_t&);
template bool parse(std::string_view, std::uint64_t&);
template bool parse(std::string_view, float&);
template bool parse(std::string_view, double&);

}  // namespace gale::io::detail
