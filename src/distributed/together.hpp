#pragma once

#include <exception>
#include <string>

#include <gale/base/error.hpp>
#include <gale/distributed/communicator.hpp>

namespace gale::detail {

/// Throws SharedError if one rank has `failed`: what the lowest such rank says, with its name.
inline void fail_together(const Communicator& ranks, bool failed, const std::string& failure) {
  const std::int64_t first = ranks.least(std::int64_t(failed ? ranks.rank() : ranks.size()));
  if (first == ranks.size()) return;
  const std::string message = ranks.broadcast(failure, static_cast<int>(first));
  throw SharedError(ranks.size() == 1 ? message : "rank " + std::to_string(first) + ": " + message);
}

/// Runs an action on each rank that sends nothing to others. If it throws on some, all ranks throw the same SharedError
/// when all have ended: nobody waits for a rank that has given up.
template <class Action>
void together(const Communicator& ranks, const Action& action) {
  std::string failure;
  bool failed = true;
  try {
    action();
    failed = false;
  } catch (const std::exception& error) {
    failure = error.what();
  } catch (...) {
    failure = "unknown exception";
  }
  fail_together(ranks, failed, failure);
}

}  // namespace gale::detail
