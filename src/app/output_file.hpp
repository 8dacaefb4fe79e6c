#pragma once

#include <string>

namespace gale::app {

/// Throws gale::Error, naming the path, unless a file can be made there now. A file that is there stays as it is.
void require_writable(const std::string& path);

/// Writes `text` to `path`, whole or not at all. Throws gale::Error, naming the path.
void write_text(const std::string& path, const std::string& text);

}  // namespace gale::app
