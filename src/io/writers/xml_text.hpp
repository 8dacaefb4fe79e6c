#pragma once

#include <string>

namespace gale::io::detail {

/// As the value of an attribute in XML of UTF-8. Text that isn't UTF-8 is taken for Latin-1; control characters, which
/// XML has none of, become '?'.
std::string xml_text(const std::string& text);

/// ' name="value"', with such text.
std::string xml_attribute(const std::string& name, const std::string& value);

}  // namespace gale::io::detail
