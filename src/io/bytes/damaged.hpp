#pragma once

#include <string>

#include <gale/base/error.hpp>

namespace gale::io::detail {

/// Throws gale::Error about a file whose content isn't what its format says. `reason` names the value at fault; bytes
/// of the file that it quotes become printable, and it is cut where it is long.
[[noreturn]] void damaged(const std::string& reason);

/// `text` from a file as one short line that can be printed.
std::string printable(const std::string& text);

}  // namespace gale::io::detail
