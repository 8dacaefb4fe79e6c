#pragma once

#include <string>
#include <type_traits>

#include <gale/base/error.hpp>

namespace gale::io::detail {

/// The parts one behind the other; numbers as std::to_string() writes them.
template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::string text;
  const auto add = [&text](const auto& part) {
    using Part = std::decay_t<decltype(part)>;
    if constexpr (std::is_arithmetic_v<Part> && !std::is_same_v<Part, char>) {
      text += std::to_string(part);
    } else {
      text += part;
    }
  };
  (add(parts), ...);
  return text;
}

/// Throws gale::Error with a message of these parts.
template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  throw Error(text_of(parts...));
}

/// `text` from a file as one short line that can be printed.
std::string printable(const std::string& text);

/// Throws gale::Error about a file whose content isn't what its format says. The parts are the reason, which names the
/// value at fault; bytes of the file that it quotes become printable, and it is cut where it is long.
template <class... Parts>
[[noreturn]] void damaged(const Parts&... parts) {
  refuse("it is damaged, incomplete or of another format (", printable(text_of(parts...)), ")");
}

}  // namespace gale::io::detail
