#pragma once

#include <string_view>

#include <gale/base/error.hpp>
#include <gale/io/bytes/damaged.hpp>

namespace gale::io::detail {

/// The number that `word` writes, which may have a sign, or be nan or inf if T is of floating point. False unless all
/// of it is a number that T holds; one too small for T is 0, one too large an infinity.
template <class T>
bool parse(std::string_view word, T& value);

/// The number that a word is; throws gale::Error, with `what` it should be, for one that isn't.
template <class T>
T number(std::string_view word, const std::string& what) {
  T value;
  if (!parse(word, value)) damaged(what + " is '" + std::string(word.substr(0, 40)) + "'");
  return value;
}

}  // namespace gale::io::detail
