#pragma once

#include <string>

namespace gale::app {

/// Says what the command does from now on, for an error that doesn't say where it happened.
void begin_step(const char* doing, const std::string& what = {});

/// Everything was written: what fails now is only tidying up.
void end_steps();
bool steps_ended();

/// What was begun last: "reading 'mesh.vtu'".
const char* current_step();

}  // namespace gale::app
