#pragma once

#include <atomic>

/// A library that is loaded before a program (LD_PRELOAD) and makes one of its calls fail: see server.cpp for how it is
/// told which.
namespace gale::faults {

enum class Kind { none, allocation, file, thread };

/// The fault of this process, and what happened so far; shared with the process that asked for it.
struct Fault {
  std::atomic<Kind> kind{Kind::none};
  std::atomic<long> at{0};          ///< the call that fails, from 1 on
  std::atomic<long> more{0};        ///< how many after that fail too
  std::atomic<int> error{0};        ///< errno of calls of files
  std::atomic<long> calls{0};       ///< of that kind
  std::atomic<long> failed{0};      ///< of these
  std::atomic<bool> counts{false};  ///< only while main runs
};

extern Fault* fault;

/// Counts a call. Whether it is to fail.
bool fails(Kind kind);

}  // namespace gale::faults
