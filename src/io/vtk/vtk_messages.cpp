#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <mutex>

#include <vtkErrorCode.h>
#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <gale/base/error.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/vtk/vtk_messages.hpp>

namespace gale::io::detail {
namespace {

std::mutex one_at_a_time;

/// VTK's "ERROR: In FILE, line N\nvtkClass (0x...): the message\n\n" without all that comes before the message.
std::string message_of(const std::string& text) {
  std::string message = text.substr(std::min(text.find('\n') + 1, text.size()));
  const std::size_t object = message.find("): ");
  if (message.compare(0, 3, "vtk") == 0 && object != std::string::npos) message.erase(0, object + 3);
  return message;
}

/// The text as one short line that can be printed, without a full stop.
std::string one_line(const std::string& text) {
  std::string line = printable(text);
  if (!line.empty() && line.back() == '.') line.pop_back();
  return line;
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

struct VtkMessages::State {
  std::string verdict;
  std::lock_guard<std::mutex> lock{one_at_a_time};
  vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkSmartPointer<SilentWindow> window = vtkSmartPointer<SilentWindow>::New();
  vtkLogger::Verbosity verbosity = vtkLogger::GetCurrentVerbosityCutoff();
};

VtkMessages::VtkMessages(const std::string& verdict) : state_(std::make_unique<State>()) {
  state_->verdict = verdict;
  vtkOutputWindow::SetInstance(state_->window);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages() {
  vtkLogger::SetStderrVerbosity(state_->verbosity);
  vtkOutputWindow::SetInstance(state_->before);
}

void VtkMessages::check(unsigned long code) const {
  if (!state_->window->first_error.empty()) fail(state_->window->first_error);
  if (code != vtkErrorCode::NoError) fail(vtkErrorCode::GetStringFromErrorCode(code));
}

void VtkMessages::check_written(unsigned long code) const {
  const int last = errno;
  if (code == vtkErrorCode::NoError && state_->window->first_error.empty()) return;
  for (const unsigned long reason : {code, static_cast<unsigned long>(last)}) {  // VTK's code may be the system's
    if (says_why_not_written(reason)) throw Error(std::strerror(static_cast<int>(reason)));
  }
  const std::string said = one_line(without_addresses(state_->window->first_error));
  refuse("not all of it could be written", (said.empty() ? "" : " (VTK: " + said + ")"));
}

void VtkMessages::fail(const std::string& reason) const { refuse(state_->verdict, " (", one_line(reason), ")"); }

}  // namespace gale::io::detail
