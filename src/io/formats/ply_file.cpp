#include <algorithm>
#include <cstring>
#include <limits>

#include <gale/base/stop.hpp>
#include <gale/io/formats/ply_file.hpp>

namespace gale::io::detail {
namespace {

constexpr TypeNames ply_types = {"char|int8",   "uchar|uint8", "short|int16", "ushort|uint16", "int|int32",
                                 "uint|uint32", "int64",       "uint64",      "float|float32", "double|float64"};

ValueType type_in(std::string_view word, const std::string& of) {
  const std::optional<ValueType> type = find_type(ply_types, word);
  if (!type) damaged("the type of ", of, " is '", std::string(word.substr(0, 40)), "'");
  return *type;
}

bool is_whole(ValueType type) { return type < ValueType::float32; }

/// Names a property in messages.
std::string its(const PlyElement& element, std::size_t property) {
  return "'" + element.properties[property].name + "' of '" + element.name + "'";
}

}  // namespace

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& property) { return property.count_type.has_value(); });
}

std::optional<std::size_t> PlyElement::find(const std::string& property) const {
  for (std::size_t p = 0; p < properties.size(); ++p) {
    if (properties[p].name == property) return p;
  }
  return std::nullopt;
}

PlyFile::PlyFile(const InputFile& file) : bytes_(file, 0), text_(bytes_) { read_header(); }

void PlyFile::read_header() {
  std::string line;
  if (!text_.line(line) || trimmed(line) != "ply") damaged("its first line is not 'ply'");
  bool has_form = false;
  while (true) {
    if (!text_.line(line)) damaged("its header doesn't end");
    Words words(line);
    const std::string_view keyword = words.next();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      const std::string_view form = words.next();
      has_form = true;
      if (form == "ascii") {
        form_ = Form::ascii;
      } else if (form == "binary_little_endian") {
        form_ = Form::little;
      } else if (form == "binary_big_endian") {
        form_ = Form::big;
      } else {
        damaged("its format is '", std::string(form.substr(0, 40)), "'");
      }
    } else if (keyword == "element") {
      PlyElement element;
      element.name = words.next();
      element.count = number<std::uint64_t>(words.next(), "the number of its elements '" + element.name + "'");
      const bool is_known = std::any_of(elements_.begin(), elements_.end(),
                                        [&](const PlyElement& other) { return other.name == element.name; });
      if (is_known) damaged("it has the elements '", element.name, "' twice");
      elements_.push_back(std::move(element));
    } else if (keyword == "property") {
      add_property(words);
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      damaged("its header has the line '", line.substr(0, 80), "'");
    }
  }
  if (!has_form) damaged("its header has no format");
}

void PlyFile::add_property(Words& words) {
  if (elements_.empty()) damaged("its header has a property before the first element");
  std::vector<PlyProperty>& properties = elements_.back().properties;
  const std::string of = "property " + std::to_string(properties.size()) + " of '" + elements_.back().name + "'";
  PlyProperty property;
  std::string_view type = words.next();
  if (type == "list") {
    property.count_type = type_in(words.next(), of);
    if (!is_whole(*property.count_type)) damaged("the length of ", of, " is no whole number");
    type = words.next();
  }
  property.type = type_in(type, of);
  property.name = words.next();
  if (property.name.empty()) damaged(of, " has no name");
  properties.push_back(std::move(property));
}

void PlyFile::require_to_come(const PlyElement& element) const {
  std::uint64_t least = 0;  // bytes of an element: a digit and a space for each number of a text
  for (const PlyProperty& property : element.properties)
    least += form_ == Form::ascii ? 2 : size_of(property.count_type.value_or(property.type));
  if (least > 0 && element.count > (text_.at_most() + 1) / least)
    damaged("it has no room for ", element.count, " elements '", element.name, "'");
}

template <class T>
T PlyFile::value(const PlyElement& element, std::size_t property) {
  T value{};
  if (form_ == Form::ascii) {
    const std::string_view word = text_.word();
    if (word.empty()) damaged("it ends before a value of ", its(element, property));
    if (!parse(word, value))
      damaged("a value of ", its(element, property), " is '", std::string(word.substr(0, 40)), "'");
    return value;
  }
  if (text_.read(reinterpret_cast<char*>(&value), sizeof(T)) < sizeof(T))
    damaged("it ends before a value of ", its(element, property));
  to_machine_order(&value, 1, form_ == Form::big ? ByteOrder::big : ByteOrder::little);
  return value;
}

std::int64_t PlyFile::integer(ValueType type, const PlyElement& element, std::size_t property) {
  return with_type(
      type, [&](auto example) { return static_cast<std::int64_t>(value<decltype(example)>(element, property)); });
}

/// Reads binary elements without lists, many at once.
void PlyFile::read_records(const PlyElement& element, PlyColumns& to) {
  std::vector<std::size_t> begin;
  std::size_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    begin.push_back(bytes);
    bytes += size_of(property.type);
  }
  constexpr std::uint64_t bytes_at_once = 1 << 20;
  const std::uint64_t at_once = std::max<std::uint64_t>(1, bytes_at_once / bytes);
  std::vector<char> buffer(static_cast<std::size_t>(std::min(at_once, element.count)) * bytes);
  for (std::uint64_t row = 0; row < element.count; row += at_once) {
    gale::detail::stop_if_asked();
    const auto some = static_cast<std::size_t>(std::min(at_once, element.count - row));
    read_all(text_, buffer.data(), some * bytes, "an element");
    for (std::size_t p = 0; p < begin.size(); ++p) {
      std::visit(
          [&](auto& values) {
            using T = typename std::decay_t<decltype(values)>::value_type;
            const std::size_t first = values.size();
            values.resize(first + some);
            for (std::size_t k = 0; k < some; ++k)
              std::memcpy(&values[first + k], buffer.data() + k * bytes + begin[p], sizeof(T));
            to_machine_order(&values[first], some, form_ == Form::big ? ByteOrder::big : ByteOrder::little);
          },
          to.values[p]);
    }
  }
}

void PlyFile::read_list(const PlyElement& element, std::size_t property, bool is_wanted, PlyColumns& to) {
  const PlyProperty& list = element.properties[property];
  const std::int64_t count = integer(*list.count_type, element, property);
  if (count < 0) damaged("a list ", its(element, property), " has ", count, " numbers");
  for (std::int64_t k = 0; k < count; ++k) {
    if (!is_wanted && !is_whole(list.type)) {
      with_type(list.type, [&](auto example) { value<decltype(example)>(element, property); });
      continue;
    }
    const std::int64_t number = integer(list.type, element, property);
    if (!is_wanted) continue;
    if (number < std::numeric_limits<std::int32_t>::min() || number > std::numeric_limits<std::int32_t>::max())
      damaged("a number of ", its(element, property), " is ", number);
    to.lists[property].push_back(static_cast<std::int32_t>(number));
  }
  if (is_wanted) to.ends[property].push_back(static_cast<std::int64_t>(to.lists[property].size()));
}

PlyColumns PlyFile::read(const PlyElement& element, const std::string& list) {
  const std::size_t width = element.properties.size();
  PlyColumns columns;
  columns.ends.resize(width);
  columns.lists.resize(width);
  if (width == 0) return columns;
  require_to_come(element);
  for (std::size_t p = 0; p < width; ++p) {
    const PlyProperty& property = element.properties[p];
    columns.values.push_back(no_values(property.type));
    if (property.count_type && property.name == list && !is_whole(property.type))
      damaged(its(element, p), " has values of type ", name_of(property.type));
    if (property.count_type) continue;
    std::visit([&](auto& values) { values.reserve(static_cast<std::size_t>(element.count)); }, columns.values.back());
  }
  if (form_ != Form::ascii && !element.has_lists()) {
    read_records(element, columns);
    return columns;
  }
  for (std::uint64_t row = 0; row < element.count; ++row) {
    gale::detail::stop_if_asked_at(static_cast<std::int64_t>(row));
    for (std::size_t p = 0; p < width; ++p) {
      if (element.properties[p].count_type) {
        read_list(element, p, element.properties[p].name == list, columns);
      } else {
        std::visit(
            [&](auto& values) {
              values.push_back(value<typename std::decay_t<decltype(values)>::value_type>(element, p));
            },
            columns.values[p]);
      }
    }
  }
  return columns;
}

void PlyFile::skip(const PlyElement& element) {
  PlyColumns unused;
  if (element.properties.empty()) return;
  require_to_come(element);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    gale::detail::stop_if_asked_at(static_cast<std::int64_t>(row));
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      if (element.properties[p].count_type) {
        read_list(element, p, false, unused);
      } else {
        with_type(element.properties[p].type, [&](auto example) { value<decltype(example)>(element, p); });
      }
    }
  }
}

}  // namespace gale::io::detail
