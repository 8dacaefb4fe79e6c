#pragma once

#include <csignal>
#include <string>

#include <gale/export.hpp>

namespace gale::io {

/// From now on the signals that end a process, and an `exit`, remove the temporary files of all `AtomicFile`s first;
/// the process still ends by the signal. A signal that is ignored or has a handler keeps that. For an application that
/// has none of its own: the library never calls it.
GALE_EXPORT void remove_temporary_files_at_end();

/// Removes the temporary files of all `AtomicFile`s now, in a signal handler too: for who ends the process otherwise.
GALE_EXPORT void remove_temporary_files();

namespace detail {

/// While it lives, the handler of the above waits, two seconds at most, before it ends the process: what is begun on
/// this thread is done. To be destroyed on the thread that made it.
class GALE_EXPORT Uninterrupted {
 public:
  Uninterrupted();
  ~Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;

 private:
  sigset_t before_;
};

/// The name of a file that goes with this object, whether there is one or not, or with the process.
class GALE_EXPORT TemporaryName {
 public:
  TemporaryName() = default;
  explicit TemporaryName(const std::string& path);
  ~TemporaryName();
  TemporaryName(TemporaryName&& other) noexcept;
  TemporaryName& operator=(TemporaryName&& other) noexcept;

  /// The file has another name now, or none.
  void forget();

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  char* copy_ = nullptr;   ///< for the handler; null when there is nothing to remove
  void* place_ = nullptr;  ///< where the handler finds it
};

}  // namespace detail
}  // namespace gale::io
