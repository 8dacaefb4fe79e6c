#include <algorithm>
#include <cmath>
#include <cstring>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/formats/legacy_file.hpp>
#include <gale/io/formats/volume.hpp>

namespace gale::io::detail {
namespace {

/// "%20" and the like as the bytes that they stand for.
std::string decoded(const std::string& text) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string result;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool escape = text[k] == '%' && k + 2 < text.size() && digit(text[k + 1]) >= 0 && digit(text[k + 2]) >= 0;
    result += escape ? static_cast<char>(16 * digit(text[k + 1]) + digit(text[k + 2])) : text[k];
    if (escape) k += 2;
  }
  return result;
}

}  // namespace

LegacyFile::LegacyFile(const InputFile& file) : bytes_(file, 0), text_(bytes_) {
  const std::string start = "# vtk DataFile Version ";
  std::string line;
  if (!text_.line(line) || line.compare(0, start.size(), start) != 0) damaged("its first line is not '", start, "...'");
  const std::string version = trimmed(line.substr(start.size()));
  major_version_ = number<int>(version.substr(0, version.find('.')), "the version");
  if (!text_.line(line)) damaged("it ends after its first line");
  const std::string kind = keyword();
  if (kind != "ascii" && kind != "binary") damaged("its third line is '", kind, "', neither ASCII nor BINARY");
  binary_ = kind == "binary";
}

std::string LegacyFile::keyword() {
  while (true) {
    const std::string word = lower_case(std::string(text_.word()));
    if (word != "metadata") return word;
    skip_metadata();
  }
}

void LegacyFile::skip_metadata() {
  std::string line;
  end_line();
  while (text_.line(line) && !trimmed(line).empty()) {
  }
}

std::string LegacyFile::name(const char* what) {
  const std::string_view word = text_.word();
  if (word.empty()) damaged("it ends before ", what);
  return decoded(std::string(word));
}

std::int64_t LegacyFile::count(const char* what) {
  const auto result = number<std::int64_t>(text_.word(), what);
  if (result < 0) damaged(what, " is ", result);
  return result;
}

std::vector<double> LegacyFile::numbers(std::size_t count, const char* what) {
  std::vector<double> result;
  for (std::size_t k = 0; k < count; ++k) result.push_back(number<double>(text_.word(), what));
  return result;
}

void LegacyFile::end_line() {
  std::string rest;
  text_.line(rest);
}

PointArray::Values LegacyFile::values(ValueType type, std::uint64_t count) {
  if (!binary_) return read_text_values(text_, type, count);
  end_line();
  return read_values(text_, type, count, ByteOrder::big);
}

std::optional<PointArray::Values> LegacyFile::array(const std::string& type, std::uint64_t count) {
  const std::string name = lower_case(type);
  if (const auto known = find_type(legacy_types, name)) return values(*known, count);
  if (name == "bit") {
    if (binary_) end_line();
    binary_ ? skip_bytes(count / 8 + (count % 8 != 0)) : skip_words(count);
  } else if (name == "string" || name == "utf8_string") {
    skip_strings(count);
  } else if (name == "variant") {
    skip_words(2 * count);
  } else {
    damaged("an array has values of the unknown type '", type, "'");
  }
  return std::nullopt;
}

PointArray::Values LegacyFile::array_of_numbers(std::uint64_t count, const char* what) {
  const std::string type = name(what);
  auto values = array(type, count);
  if (!values) damaged("the values of ", what, " are of type ", type);
  return std::move(*values);
}

std::vector<std::int32_t> LegacyFile::integers(std::uint64_t count) {
  return std::get<std::vector<std::int32_t>>(values(ValueType::int32, count));
}

PointArray::Values LegacyFile::colors(std::uint64_t count) {
  if (binary_) return values(ValueType::uint8, count);
  const auto shades = std::get<std::vector<float>>(values(ValueType::float32, count));
  std::vector<std::uint8_t> bytes(shades.size());
  std::transform(shades.begin(), shades.end(), bytes.begin(), [](float shade) {
    return static_cast<std::uint8_t>(std::clamp(255.0 * (std::isnan(shade) ? 0 : shade) + 0.5, 0.0, 255.0));
  });
  return bytes;
}

void LegacyFile::skip_table(std::uint64_t colors) {
  const std::uint64_t count = product({static_cast<std::int64_t>(colors), 4}, "colors");
  if (!binary_) return skip_words(count);
  end_line();
  skip_bytes(count);
}

void LegacyFile::skip_words(std::uint64_t count) {
  for (std::uint64_t k = 0; k < count; ++k) {
    if (text_.word().empty()) damaged("it ends before ", count, " values");
  }
}

void LegacyFile::skip_bytes(std::uint64_t count) {
  if (count > text_.at_most()) damaged("it ends before ", count, " bytes of values");
  skip_all(text_, count, "it");
}

/// In a text one a line; else each behind its length, whose first two bits say how long that is.
void LegacyFile::skip_strings(std::uint64_t count) {
  end_line();
  for (std::uint64_t k = 0; k < count; ++k) {
    std::string line;
    if (!binary_) {
      if (!text_.line(line)) damaged("it ends before ", count, " strings");
      continue;
    }
    unsigned char first = 0, rest[7] = {};
    read_all(text_, reinterpret_cast<char*>(&first), 1, "a string");
    const int more_bytes[] = {7, 3, 1, 0};
    const int more = more_bytes[first >> 6];
    read_all(text_, reinterpret_cast<char*>(rest), static_cast<std::size_t>(more), "a string");
    std::uint64_t length = first & 63;
    for (int b = 0; b < more; ++b) length = length << 8 | rest[b];
    skip_bytes(length);
  }
}

}  // namespace gale::io::detail
