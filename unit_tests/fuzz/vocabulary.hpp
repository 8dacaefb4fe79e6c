#pragma once

#include <string>
#include <vector>

namespace gale::fuzz {

/// Texts that numbers of a header are changed to: at and beyond the limits of their types, and what is no number.
extern const std::vector<std::string> numbers;

/// Words of the formats, those that may stand in one place together.
extern const std::vector<std::vector<std::string>> words;

}  // namespace gale::fuzz
