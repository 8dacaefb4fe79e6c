#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <string>

#include <vtkErrorCode.h>
#include <vtkObjectFactory.h>

#include <gale/app/drawing/module/vtk_messages.hpp>

namespace gale::app {
namespace {

/// VTK's "ERROR: In FILE, line N\nvtkClass (0x...): the message\n\n" without all that comes before the message.
std::string message_of(const std::string& text) {
  std::string message = text.substr(std::min(text.find('\n') + 1, text.size()));
  const std::size_t object = message.find("): ");
  if (message.compare(0, 3, "vtk") == 0 && object != std::string::npos) message.erase(0, object + 3);
  message.erase(message.find_last_not_of(" \n.") + 1);
  return message;
}

/// VTK names its objects by their addresses too, as in "vtkPNGWriter(0x55e6)": these say nothing to a user.
std::string without_addresses(std::string text) {
  for (std::size_t at = 0; (at = text.find("(0x", at)) != std::string::npos;) {
    const std::size_t end = text.find_first_not_of("0123456789abcdef", at + 3);
    if (end == std::string::npos || text[end] != ')') {
      at += 3;
    } else {
      text.erase(at, end + 1 - at);
    }
  }
  return text;
}

/// Whether a value of errno that was left after writing can be what went wrong then.
bool says_why_not_written(unsigned long error) {
  static constexpr unsigned long reasons[] = {ENOSPC, EDQUOT, EFBIG, EIO,    EROFS, ENXIO,
                                              ENODEV, ESTALE, EPIPE, ENOMEM, EMFILE};
  return std::find(std::begin(reasons), std::end(reasons), error) != std::end(reasons);
}

}  // namespace

/// Keeps what VTK says to itself.
class SilentWindow : public vtkOutputWindow {
 public:
  static SilentWindow* New();
  vtkTypeMacro(SilentWindow, vtkOutputWindow);

  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override { remember(text); }
  void DisplayGenericWarningText(const char* text) override { remember(text); }
  void DisplayWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}

  std::string first_error;

 private:
  void remember(const char* text) {
    if (first_error.empty()) first_error = message_of(text);
  }
};

vtkStandardNewMacro(SilentWindow);

VtkMessages::VtkMessages() : window_(vtkSmartPointer<SilentWindow>::New()) {
  vtkOutputWindow::SetInstance(window_);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages() {
  vtkLogger::SetStderrVerbosity(verbosity_);
  vtkOutputWindow::SetInstance(before_);
}

void VtkMessages::check() const {
  if (!window_->first_error.empty()) throw std::runtime_error("VTK gave up (" + window_->first_error + ')');
}

void VtkMessages::check_written(unsigned long code) const {
  const int last = errno;
  const std::string& error = window_->first_error;
  if (code == vtkErrorCode::NoError && error.empty()) return;
  for (const unsigned long reason : {code, static_cast<unsigned long>(last)}) {  // VTK's code may be the system's
    if (says_why_not_written(reason)) throw std::runtime_error(std::strerror(static_cast<int>(reason)));
  }
  throw std::runtime_error("not all of it could be written" +
                           (error.empty() ? "" : " (VTK: " + without_addresses(error) + ')'));
}

}  // namespace gale::app
