#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include <gale/app/options/parse.hpp>
#include <gale/app/usage_error.hpp>

namespace gale::app {

namespace {

/// What a unit stands for; nothing if it is none.
std::optional<double> factor_of(std::string unit) {
  std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
  if (unit.empty() || unit == "b") return 1;
  static const std::string prefixes = "kmgt";
  const auto power = prefixes.find(unit[0]);
  const std::string rest = unit.substr(1);
  if (power == std::string::npos || (!rest.empty() && rest != "b" && rest != "ib")) return std::nullopt;
  return std::pow(1024.0, static_cast<double>(power + 1));
}

std::optional<double> bytes_of(const std::string& text) {
  const auto end = std::min(text.find_first_not_of("0123456789."), text.size());
  const std::string number = text.substr(0, end);
  if (number.find_first_of("0123456789") == std::string::npos || number.find('.') != number.rfind('.'))
    return std::nullopt;
  const auto unit = text.find_first_not_of(' ', end);
  const auto factor = factor_of(unit == std::string::npos ? "" : text.substr(unit));
  if (!factor) return std::nullopt;
  return std::strtod(number.c_str(), nullptr) * *factor;
}

}  // namespace

std::size_t parse_size(const std::string& option, const std::string& text) {
  constexpr double limit = 9.2e18;  // below 2^63
  const auto bytes = bytes_of(text);
  if (bytes && *bytes >= 1 && *bytes <= limit) return static_cast<std::size_t>(*bytes);
  throw UsageError(option + ": '" + text + "' is no size of memory, such as 512MiB, 1.5GiB, 8G or 1000000 (bytes)");
}

outputs::Persistence parse_persistence(const std::string& option, const std::string& text) {
  outputs::Persistence persistence;
  persistence.is_percent = !text.empty() && text.back() == '%';
  const std::string number = persistence.is_percent ? text.substr(0, text.size() - 1) : text;
  char* end = nullptr;
  persistence.value = std::strtod(number.c_str(), &end);
  const bool is_number =
      !number.empty() && number.find_first_not_of("0123456789.eE+-") == std::string::npos && *end == '\0';
  if (is_number && std::isfinite(persistence.value) && persistence.value >= 0) return persistence;
  throw UsageError(option + ": '" + text +
                   "' is no difference of values of at least 0, such as 0.5, nor a part of their range, such as 20%");
}

std::optional<std::int64_t> parse_random(const std::string& option, const std::string& text) {
  const std::string prefix = "random:";
  if (text.rfind(prefix, 0) != 0) return std::nullopt;
  std::int64_t count = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data() + prefix.size(), end, count);
  if (parsed.ec != std::errc() || parsed.ptr != end || count < 1)
    throw UsageError(option + ' ' + text + ": random:K takes a whole number K of at least 1");
  return count;
}

}  // namespace gale::app
