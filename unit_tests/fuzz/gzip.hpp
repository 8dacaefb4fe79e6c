#pragma once

#include <string>

namespace gale::fuzz {

/// Between a file and what gzip makes of it.
std::string zipped(const std::string& content);
std::string unzipped(const std::string& content);

}  // namespace gale::fuzz
