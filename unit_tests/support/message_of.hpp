#pragma once

#include <functional>
#include <string>

#include <gale/base/error.hpp>

namespace gale::test {

/// What the gale::Error that an action throws says; "no error" if it throws none.
inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace gale::test
