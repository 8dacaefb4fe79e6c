#pragma once

#include <system_error>
#include <thread>
#include <utility>

#include <gale/base/error.hpp>

namespace gale::detail {

/// A new thread that runs `body`. Throws Error where the system starts no more.
template <class Body>
std::thread start_thread(Body&& body) {
  try {
    return std::thread(std::forward<Body>(body));
  } catch (const std::system_error& error) {
    throw Error(std::string("the system starts no more threads (") + error.code().message() +
                "): take fewer, or raise its limit of threads or of memory");
  }
}

}  // namespace gale::detail
