#include <cstddef>

#include <gale/io/writers/xml_text.hpp>

namespace gale::io::detail {

namespace {

unsigned byte(const std::string& text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0;
}

/// The bytes of the character of UTF-8 that begins there; 0 if none does, or none that XML may have.
std::size_t utf8_size(const std::string& text, std::size_t at) {
  const unsigned first = byte(text, at);
  if (first >> 6 == 2) return 0;
  const std::size_t size = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  unsigned code = size == 1 ? first : first & (0xff >> (size + 1));
  for (std::size_t k = 1; k < size; ++k) {
    if (byte(text, at + k) >> 6 != 2) return 0;
    code = code << 6 | (byte(text, at + k) & 0x3f);
  }
  constexpr unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_no_character = code > 0x10ffff || (code >= 0xd800 && code < 0xe000) || code == 0xfffe || code == 0xffff;
  return first >= 0xf8 || code < least[size] || is_no_character ? 0 : size;
}

bool is_utf8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = utf8_size(text, at);
    if (size == 0) return false;
    at += size;
  }
  return true;
}

}  // namespace

std::string xml_text(const std::string& text) {
  const bool latin1 = !is_utf8(text);
  std::string escaped;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    const bool is_space = c == '\t' || c == '\n' || c == '\r';
    if (c == '&' || c == '<' || c == '>' || c == '"' || c == '\'' || is_space || (latin1 && code >= 0x80)) {
      escaped += "&#" + std::to_string(code) + ";";
    } else {
      escaped += code < 0x20 ? '?' : c;
    }
  }
  return escaped;
}

std::string xml_attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + xml_text(value) + "\"";
}

}  // namespace gale::io::detail
