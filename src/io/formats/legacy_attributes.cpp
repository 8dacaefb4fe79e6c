#include <iterator>
#include <utility>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/cells/cells.hpp>
#include <gale/io/formats/legacy_file.hpp>

namespace gale::io::detail {
namespace {

constexpr std::int64_t most_components = 1 << 20, most_arrays = 100000;

void require_components(std::int64_t components, const std::string& array) {
  if (components < 1 || components > most_components) damaged("the components of ", array, " are ", components);
}

/// Reads attributes of one set of points or cells.
class AttributeReader {
 public:
  AttributeReader(LegacyFile& file, std::uint64_t count) : file_(file), count_(count) {}

  /// False, with nothing read, if the keyword begins no attribute.
  bool read(std::string& keyword) {
    static const std::pair<const char*, int> of_fixed_size[] = {
        {"vectors", 3},    {"normals", 3},      {"tensors", 9},   {"tensors6", 6},
        {"global_ids", 1}, {"pedigree_ids", 1}, {"edge_flags", 1}};
    for (const auto& [known, components] : of_fixed_size) {
      if (keyword != known) continue;
      const std::string name = name_of_array();
      take(name, components);
      return next(keyword);
    }
    if (keyword == "scalars") {
      read_scalars();
    } else if (keyword == "color_scalars") {
      const std::string name = name_of_array();
      const std::int64_t components = components_of(name);
      add(name, components, file_.colors(size(components)), true);
    } else if (keyword == "texture_coordinates") {
      const std::string name = name_of_array();
      take(name, components_of(name));
    } else if (keyword == "lookup_table") {
      file_.name("the name of a lookup table");
      file_.skip_table(static_cast<std::uint64_t>(file_.count("the size of a lookup table")));
    } else if (keyword == "field") {
      LegacyAttributes field = read_field(file_, &count_);
      move_to_end(field.arrays, found_.arrays);
      move_to_end(field.names, found_.names);
      move_to_end(field.left_out, found_.left_out);
    } else {
      return false;
    }
    return next(keyword);
  }

  LegacyAttributes take_found() { return std::move(found_); }

 private:
  template <class T>
  static void move_to_end(std::vector<T>& from, std::vector<T>& to) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  }

  bool next(std::string& keyword) {
    keyword = file_.keyword();
    return true;
  }

  std::string name_of_array() { return file_.name("the name of an array"); }

  std::int64_t components_of(const std::string& array) {
    const std::int64_t components = file_.count(("the components of " + array).c_str());
    require_components(components, array);
    return components;
  }

  std::uint64_t size(std::int64_t components) const { return product(count_, static_cast<std::uint64_t>(components)); }

  void add(const std::string& name, std::int64_t components, std::optional<PointArray::Values> values, bool scalars,
           const std::string& type = "") {
    const bool first = values && scalars && !has_scalars_;
    has_scalars_ |= first;
    found_.add(name, components, std::move(values), type, first);
  }

  void take(const std::string& name, std::int64_t components) {
    const std::string type = lower_case(file_.name("the type of an array"));
    add(name, components, file_.array(type, size(components)), false, type);
  }

  /// SCALARS name type [components] LOOKUP_TABLE table
  void read_scalars() {
    const std::string name = name_of_array();
    const std::string type = lower_case(file_.name("the type of an array"));
    std::string word = lower_case(file_.name("LOOKUP_TABLE"));
    std::int64_t components = 1;
    if (word != "lookup_table") {
      components = number<std::int64_t>(word, "the components of " + name);
      require_components(components, name);
      word = lower_case(file_.name("LOOKUP_TABLE"));
    }
    if (word != "lookup_table") damaged("no LOOKUP_TABLE follows the scalars ", name);
    file_.name("the name of a lookup table");
    add(name, components, file_.array(type, size(components)), true, type);
  }

  LegacyFile& file_;
  std::uint64_t count_;
  LegacyAttributes found_;
  bool has_scalars_ = false;
};

}  // namespace

void LegacyAttributes::add(const std::string& name, std::int64_t components, std::optional<PointArray::Values> values,
                           const std::string& type, bool first) {
  names.push_back(name);
  if (!values) {
    left_out.push_back(note_array(name, "its values are of type " + type));
  } else {
    arrays.insert(first ? arrays.begin() : arrays.end(),
                  PointArray{name, static_cast<int>(components), std::move(*values)});
  }
}

LegacyAttributes read_attributes(LegacyFile& file, std::uint64_t count, std::string& keyword) {
  AttributeReader reader(file, count);
  while (reader.read(keyword)) {
  }
  return reader.take_found();
}

LegacyAttributes read_field(LegacyFile& file, const std::uint64_t* count) {
  LegacyAttributes found;
  file.name("the name of a field");
  const std::int64_t arrays = file.count("the number of a field's arrays");
  if (arrays > most_arrays) damaged("a field has ", arrays, " arrays");
  for (std::int64_t k = 0; k < arrays; ++k) {
    std::string name = file.name("the name of an array");
    if (name == "METADATA") {  // of the array before
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
    found.add(name, components, std::move(values), type, false);
  }
  return found;
}

}  // namespace gale::io::detail
