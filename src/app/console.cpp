#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <memory>

#include <gale/app/console.hpp>
#include <gale/base/error.hpp>

namespace gale::app {

namespace {

/// A progress bar on the terminal. Its destructor erases it, so that it also goes when a sweep throws.
class Bar {
 public:
  explicit Bar(const std::string& title) : title_(title) {}
  ~Bar() { erase(); }
  Bar(const Bar&) = delete;
  Bar& operator=(const Bar&) = delete;

  void draw(Id done, Id all) {
    const double part = all > 0 ? static_cast<double>(done) / all : 1.0;
    const std::string bar(static_cast<std::size_t>(part * width), '=');
    std::fprintf(stderr, "\r%-16s [%-*s] %3.0f %%", title_.c_str(), width, bar.c_str(), 100 * part);
    drawn_ = true;
    if (done >= all) erase();
    std::fflush(stderr);
  }

 private:
  static constexpr int width = 40;

  void erase() {
    if (drawn_) std::fprintf(stderr, "\r%*s\r", width + 26, "");
    drawn_ = false;
  }

  std::string title_;
  bool drawn_ = false;
};

char step[512] = "starting";  // allocates nothing, as it is for when memory has run out
bool ended = false;

}  // namespace

void Console::say(const std::string& name, const std::string& value) const {
  if (quiet_) return;
  std::printf("%-16s %s\n", name.c_str(), value.c_str());
  require_output();
}

std::function<void(Id, Id)> Console::progress(const std::string& title) const {
  if (quiet_ || isatty(STDERR_FILENO) == 0) return {};
  return [bar = std::make_shared<Bar>(title)](Id done, Id all) { bar->draw(done, all); };
}

void require_output() {
  const int failure = std::cout.flush() && std::fflush(stdout) == 0 ? 0 : errno;
  if (failure == 0 && std::ferror(stdout) == 0) return;
  const std::string reason = failure != 0 ? std::string(": ") + std::strerror(failure) : "";
  throw Error("cannot write to standard output" + reason);
}

void end_steps() { ended = true; }
bool steps_ended() { return ended; }

void begin_step(const char* doing, const std::string& what) {
  const char* const quote = what.empty() ? "" : "'";
  std::snprintf(step, sizeof step, "%s%s%s%s%s", doing, what.empty() ? "" : " ", quote, what.c_str(), quote);
}

const char* current_step() { return step; }

std::string formatted(const char* format, double value, const char* unit) {
  char text[64];
  std::snprintf(text, sizeof text, format, value, unit);
  return text;
}

std::string seconds(double value) { return formatted("%.3f s", value); }

std::string bytes(double value) {
  static const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  int unit = 0;
  for (; value >= 1024 && unit < 4; ++unit) value /= 1024;
  return formatted(unit == 0 ? "%.0f %s" : "%.1f %s", value, units[unit]);
}

}  // namespace gale::app
