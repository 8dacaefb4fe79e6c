#include <cstdio>

#include <gale/app/step.hpp>

namespace gale::app {

namespace {

char step[512] = "starting";  // allocates nothing, as it is for when memory has run out
bool ended = false;

}  // namespace

void end_steps() { ended = true; }
bool steps_ended() { return ended; }

void begin_step(const char* doing, const std::string& what) {
  if (what.empty()) {
    std::snprintf(step, sizeof step, "%s", doing);
  } else {
    std::snprintf(step, sizeof step, "%s '%s'", doing, what.c_str());
  }
}

const char* current_step() { return step; }

}  // namespace gale::app
