#pragma once

#include <memory>
#include <string>

#include <gale/export.hpp>

namespace gale::io::detail {

/// Keeps VTK's messages from the terminal while it lives, and remembers the first error. VTK reports through one window
/// for the whole process, so only one of these lives at a time; others wait for it.
class GALE_EXPORT VtkMessages {
 public:
  /// `verdict` is what an error means to the user.
  explicit VtkMessages(const std::string& verdict);
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// Throws `Error` with the first error, as one line, if there was one. `code` is the `GetErrorCode` of the filter or
  /// writer.
  void check(unsigned long code) const;

  /// Throws `Error` unless all of a file was written: with what the system says, as far as that is known. `errno` must
  /// have been 0 before VTK's writer ran; `code` is its `GetErrorCode`.
  void check_written(unsigned long code) const;

  /// Throws `Error`: the verdict and, in brackets, `reason` as one short line.
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gale::io::detail
