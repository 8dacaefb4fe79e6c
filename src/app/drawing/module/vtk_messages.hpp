#pragma once

#include <vtkLogger.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

namespace gale::app {

class SilentWindow;

/// Keeps VTK's messages from the terminal while it lives, and remembers the first error.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// Throws std::runtime_error with the first error if there was one.
  void check() const;

  /// Throws std::runtime_error unless all of a file was written: with what the system says, as far as that is known.
  /// `errno` must have been 0 before VTK's writer ran; `code` is its `GetErrorCode`.
  void check_written(unsigned long code) const;

 private:
  vtkSmartPointer<vtkOutputWindow> before_ = vtkOutputWindow::GetInstance();
  vtkSmartPointer<SilentWindow> window_;
  vtkLogger::Verbosity verbosity_ = vtkLogger::GetCurrentVerbosityCutoff();
};

}  // namespace gale::app
