#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <gale/io/bytes/text.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/formats/legacy_file.hpp>

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

constexpr std::int64_t most_components = 1 << 20, most_arrays = 100000;

void require_components(std::int64_t components, const std::string& array) {
  if (components < 1 || components > most_components) damaged("the components of ", array, " are ", components);
}

/// Adds an array, or the notice where it has no `values` but such of another `type`.
void add(const std::string& name, std::int64_t components, std::optional<PointArray::Values> values,
         const std::string& type, bool are_scalars, LegacyAttributes& to) {
  to.names.push_back(name);
  if (!values) {
    to.left_out.push_back(note_array(name, "its values are of type " + type));
    return;
  }
  const bool first = are_scalars && !to.has_scalars;
  to.has_scalars |= first;
  to.arrays.insert(first ? to.arrays.begin() : to.arrays.end(),
                   PointArray{name, static_cast<int>(components), std::move(*values)});
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

/// Strings of a text are one a line; else each is behind its length, whose first two bits say how long that is.
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

bool read_attribute(LegacyFile& file, const std::string& keyword, std::uint64_t count, LegacyAttributes& to) {
  constexpr int in_file = 0;
  static const std::map<std::string, int> all = {{"vectors", 3},
                                                 {"normals", 3},
                                                 {"tensors", 9},
                                                 {"tensors6", 6},
                                                 {"global_ids", 1},
                                                 {"pedigree_ids", 1},
                                                 {"edge_flags", 1},
                                                 {"scalars", in_file},
                                                 {"color_scalars", in_file},
                                                 {"texture_coordinates", in_file}};
  if (keyword == "lookup_table") {
    file.name("the name of a lookup table");
    file.skip_table(static_cast<std::uint64_t>(file.count("the size of a lookup table")));
    return true;
  }
  if (keyword == "field") {
    read_field(file, &count, to);
    return true;
  }
  const auto known = all.find(keyword);
  if (known == all.end()) return false;
  const std::string name = file.name("the name of an array"), its_components = "the components of " + name;
  const bool are_scalars = keyword == "scalars", are_colors = keyword == "color_scalars";
  std::int64_t components = known->second;
  std::string type;
  if (are_scalars) {  // SCALARS name type [components] LOOKUP_TABLE table
    type = lower_case(file.name("the type of an array"));
    std::string word = lower_case(file.name("LOOKUP_TABLE"));
    const bool says_components = word != "lookup_table";
    components = says_components ? number<std::int64_t>(word, its_components) : 1;
    if (says_components) word = lower_case(file.name("LOOKUP_TABLE"));
    if (word != "lookup_table") damaged("no LOOKUP_TABLE follows the scalars ", name);
    file.name("the name of a lookup table");
  } else {
    if (components == in_file) components = file.count(its_components.c_str());
    if (!are_colors) type = lower_case(file.name("the type of an array"));
  }
  require_components(components, name);
  const std::uint64_t size = product(count, static_cast<std::uint64_t>(components));
  add(name, components, are_colors ? file.colors(size) : file.array(type, size), type, are_scalars || are_colors, to);
  return true;
}

void read_field(LegacyFile& file, const std::uint64_t* count, LegacyAttributes& to) {
  file.name("the name of a field");
  const std::int64_t arrays = file.count("the number of a field's arrays");
  if (arrays > most_arrays) damaged("a field has ", arrays, " arrays");
  for (std::int64_t k = 0; k < arrays; ++k) {
    std::string name = file.name("the name of an array");
    if (name == "METADATA") {  // belongs to the array before
      file.skip_metadata();
      name = file.name("the name of an array");
    }
    if (name == "NULL_ARRAY") continue;
    const std::int64_t components = file.count("the components of an array");
    const std::int64_t tuples = file.count("the tuples of an array");
    const std::string type = lower_case(file.name("the type of an array"));
    auto values = file.array(type, product({components, tuples}, "an array"));
    if (values && count != nullptr && static_cast<std::uint64_t>(tuples) != *count)
      refuse("the array '", printable(name), "' has ", tuples, " tuples for ", *count, " points");
    if (values) require_components(components, name);
    add(name, components, std::move(values), type, false, to);
  }
}

}  // namespace gale::io::detail
