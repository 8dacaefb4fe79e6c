#include <cmath>
#include <map>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/numbers.hpp>
#include <gale/io/formats/volume.hpp>

namespace gale::io::detail {

namespace {

struct NrrdHeader {
  std::map<std::string, std::string> fields;  ///< by their names in lower case, without spaces
  std::vector<std::string> list;              ///< of data files, if there is one
  std::uint64_t end = 0;                      ///< where what follows it begins

  /// Empty if it isn't there.
  const std::string& operator[](const std::string& field) const {
    static const std::string none;
    const auto found = fields.find(field);
    return found == fields.end() ? none : found->second;
  }

  bool has(const std::string& field) const { return fields.count(field) > 0; }

  std::int64_t integer(const std::string& field, std::int64_t otherwise) const {
    return has(field) ? number<std::int64_t>((*this)[field], field) : otherwise;
  }
};

std::string without_spaces(std::string text) {
  std::string result;
  for (const char c : text) {
    if (c != ' ') result += c;
  }
  return result;
}

NrrdHeader read_nrrd_header(const InputFile& file) {
  constexpr std::size_t most_fields = 1000, most_files = 100000;
  NrrdHeader header;
  FileBytes bytes(file, 0);
  TextReader text(bytes);
  std::string line;
  if (!text.line(line) || line.compare(0, 4, "NRRD") != 0) damaged("its first line is not 'NRRD...'");
  while (text.line(line) && !line.empty()) {
    if (line[0] == '#') continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) damaged("its line '" + line.substr(0, 60) + "' is not 'FIELD: VALUE'");
    if (line.compare(colon, 2, ":=") == 0) continue;  // for the user's own purposes
    if (header.fields.size() == most_fields) damaged("it has more than " + std::to_string(most_fields) + " fields");
    const std::string field = without_spaces(lower_case(line.substr(0, colon)));
    header.fields[field] = trimmed(line.substr(colon + 1));
    if (field != "datafile" || header.fields[field].compare(0, 4, "LIST") != 0) continue;
    while (text.line(line) && !trimmed(line).empty()) {
      header.list.push_back(trimmed(line));
      if (header.list.size() > most_files) damaged("it lists more than " + std::to_string(most_files) + " files");
    }
    break;
  }
  header.end = file.size() - text.at_most();
  return header;
}

ValueType type_named(const std::string& name) {
  static const std::map<std::string, ValueType> types = {{"signed char", ValueType::int8},
                                                         {"int8", ValueType::int8},
                                                         {"int8_t", ValueType::int8},
                                                         {"uchar", ValueType::uint8},
                                                         {"unsigned char", ValueType::uint8},
                                                         {"uint8", ValueType::uint8},
                                                         {"uint8_t", ValueType::uint8},
                                                         {"short", ValueType::int16},
                                                         {"short int", ValueType::int16},
                                                         {"signed short", ValueType::int16},
                                                         {"signed short int", ValueType::int16},
                                                         {"int16", ValueType::int16},
                                                         {"int16_t", ValueType::int16},
                                                         {"ushort", ValueType::uint16},
                                                         {"unsigned short", ValueType::uint16},
                                                         {"unsigned short int", ValueType::uint16},
                                                         {"uint16", ValueType::uint16},
                                                         {"uint16_t", ValueType::uint16},
                                                         {"int", ValueType::int32},
                                                         {"signed int", ValueType::int32},
                                                         {"int32", ValueType::int32},
                                                         {"int32_t", ValueType::int32},
                                                         {"uint", ValueType::uint32},
                                                         {"unsigned int", ValueType::uint32},
                                                         {"uint32", ValueType::uint32},
                                                         {"uint32_t", ValueType::uint32},
                                                         {"longlong", ValueType::int64},
                                                         {"long long", ValueType::int64},
                                                         {"long long int", ValueType::int64},
                                                         {"signed long long", ValueType::int64},
                                                         {"signed long long int", ValueType::int64},
                                                         {"int64", ValueType::int64},
                                                         {"int64_t", ValueType::int64},
                                                         {"ulonglong", ValueType::uint64},
                                                         {"unsigned long long", ValueType::uint64},
                                                         {"unsigned long long int", ValueType::uint64},
                                                         {"uint64", ValueType::uint64},
                                                         {"uint64_t", ValueType::uint64},
                                                         {"float", ValueType::float32},
                                                         {"double", ValueType::float64}};
  const auto found = types.find(name);
  if (found == types.end()) damaged("its type is '" + name + "'");
  return found->second;
}

/// "(1,2,3)" as numbers; empty for "none".
std::vector<double> vector_of(const std::string& text, const std::string& field) {
  if (text == "none") return {};
  if (text.size() < 2 || text.front() != '(' || text.back() != ')') damaged(field + " is '" + text + "'");
  std::vector<double> result;
  std::string rest = text.substr(1, text.size() - 2);
  while (true) {
    const std::size_t comma = rest.find(',');
    result.push_back(number<double>(trimmed(rest.substr(0, comma)), field));
    if (comma == std::string::npos) return result;
    rest = rest.substr(comma + 1);
  }
}

/// What the axes of the file are: components first, if any, then up to three of space, then others, of which the first
/// place alone is read.
struct Axes {
  std::vector<std::int64_t> sizes;
  std::size_t first_in_space = 0;
  std::uint64_t others = 1;
};

Axes axes_of(const NrrdHeader& header) {
  Axes axes;
  for (const std::string& word : words_of(header["sizes"])) axes.sizes.push_back(number<std::int64_t>(word, "sizes"));
  const auto dimension = header.integer("dimension", 0);
  if (dimension < 1 || dimension > 16 || axes.sizes.size() != static_cast<std::size_t>(dimension)) {
    damaged("it has " + std::to_string(axes.sizes.size()) + " sizes for " + std::to_string(dimension) + " dimensions");
  }
  for (const std::int64_t size : axes.sizes) {
    if (size < 1) damaged("one of its sizes is " + std::to_string(size));
  }
  const auto kinds = words_of(lower_case(header["kinds"]));
  const auto directions = words_of(header["spacedirections"]);
  const auto spacings = words_of(header["spacings"]);
  const auto is_space = [&](std::size_t axis) {
    if (axis < directions.size()) return directions[axis] != "none";
    if (axis < kinds.size() && kinds[axis] != "???" && kinds[axis] != "none")
      return kinds[axis] == "domain" || kinds[axis] == "space";
    if (axis < spacings.size() && lower_case(spacings[axis]) == "nan") return false;
    return axis > 0 || dimension <= 3;  // of four without a word about them, the first is taken for components
  };
  axes.first_in_space = is_space(0) ? 0 : 1;
  for (std::size_t axis = axes.first_in_space; axis < axes.sizes.size(); ++axis) {
    if (axis < axes.first_in_space + 3 && !is_space(axis))
      damaged("its axis " + std::to_string(axis) + " is not of space");
    if (axis >= axes.first_in_space + 3)
      axes.others = product({static_cast<std::int64_t>(axes.others), axes.sizes[axis]}, "sizes");
  }
  return axes;
}

void place(const NrrdHeader& header, const Axes& axes, Image& image) {
  const auto spacings = words_of(header["spacings"]);
  const auto directions = words_of(header["spacedirections"]);
  const auto origin =
      header.has("spaceorigin") ? vector_of(header["spaceorigin"], "space origin") : std::vector<double>();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t axis = axes.first_in_space + k;
    if (axis < directions.size()) {
      const auto direction = vector_of(directions[axis], "space directions");
      for (std::size_t d = 0; d < 3; ++d) image.index_to_physical[d][k] = d < direction.size() ? direction[d] : 0;
    } else if (axis < spacings.size() && lower_case(spacings[axis]) != "nan") {
      image.index_to_physical[k][k] = number<double>(spacings[axis], "spacings");
    }
    if (k < origin.size()) image.index_to_physical[k][3] = origin[k];
  }
  require_finite(image);
}

/// The data files' names; empty if the values follow the header.
std::vector<std::string> data_files(const NrrdHeader& header) {
  if (!header.has("datafile")) return {};
  const std::string& value = header["datafile"];
  const auto words = words_of(value);
  if (words.empty()) damaged("its data file has no name");
  if (words[0] == "LIST") return header.list;
  if (words.size() < 4 || value.find('%') == std::string::npos) return {value};
  constexpr std::size_t most_files = 100000;
  return names_of_pattern(words[0], number<std::int64_t>(words[1], "data file"),
                          number<std::int64_t>(words[2], "data file"), number<std::int64_t>(words[3], "data file"),
                          most_files);
}

/// Past so many lines and bytes.
std::uint64_t skip(const InputFile& data, std::uint64_t begin, const NrrdHeader& header, std::uint64_t bytes_at_end) {
  const auto lines = header.integer("lineskip", 0), bytes = header.integer("byteskip", 0);
  if (lines < 0 || bytes < -1)
    damaged("it skips " + std::to_string(lines) + " lines and " + std::to_string(bytes) + " bytes");
  if (lines > 0) {
    FileBytes source(data, begin);
    TextReader text(source);
    std::string line;
    for (std::int64_t k = 0; k < lines; ++k) {
      if (!text.line(line)) damaged("it ends before the " + std::to_string(lines) + " lines to skip");
    }
    begin = data.size() - text.at_most();
  }
  if (bytes >= 0) return begin + static_cast<std::uint64_t>(bytes);
  if (bytes_at_end > data.size())
    damaged("it has " + std::to_string(data.size()) + " bytes, not " + std::to_string(bytes_at_end));
  return data.size() - bytes_at_end;
}

PointArray::Values read_data(const InputFile& file, const NrrdHeader& header, const Volume& volume,
                             const ReadOptions& options) {
  const std::string encoding = lower_case(header["encoding"]);
  const bool raw = encoding.empty() || encoding == "raw", zipped = encoding == "gzip" || encoding == "gz";
  const bool text = encoding == "ascii" || encoding == "txt" || encoding == "text";
  if (!raw && !zipped && !text)
    throw Error("its encoding is '" + printable(encoding) + "': raw, gzip and text are read");
  std::vector<std::string> paths;
  for (const std::string& name : data_files(header)) paths.push_back(path_of_data(file.path(), name, options));
  if (header.has("datafile") && paths.empty()) damaged("it names no data file");
  if (paths.size() > 1) {
    if (!raw) throw Error("its values are in several files of the encoding " + encoding + ", which isn't read");
    if (volume.bytes() % paths.size() != 0)
      damaged("its " + std::to_string(paths.size()) + " data files don't have the same size");
    FileSequence source(paths, static_cast<std::uint64_t>(std::max<std::int64_t>(0, header.integer("byteskip", 0))),
                        volume.bytes() / paths.size());
    return volume.read(source);
  }
  std::unique_ptr<InputFile> other;
  if (!paths.empty()) other = open_input(paths[0]);
  const InputFile& data = other ? *other : file;
  const std::uint64_t begin = skip(data, other ? 0 : header.end, header, volume.bytes());
  return volume.read(data, begin, text ? Encoding::text : zipped ? Encoding::compressed : Encoding::raw);
}

}  // namespace

Content read_nrrd(const InputFile& file, const ReadOptions& options) {
  const NrrdHeader header = read_nrrd_header(file);
  const Axes axes = axes_of(header);
  Volume volume;
  volume.type = type_named(lower_case(header["type"]));
  if (axes.first_in_space == 1) volume.components = axes.sizes[0];
  for (std::size_t k = 0; k < 3 && axes.first_in_space + k < axes.sizes.size(); ++k)
    volume.dimensions[k] = axes.sizes[axes.first_in_space + k];
  const std::string endian = lower_case(header["endian"]);
  if (!endian.empty() && endian != "little" && endian != "big") damaged("its endian is '" + endian + "'");
  if (!endian.empty()) volume.order = endian == "big" ? ByteOrder::big : ByteOrder::little;
  if (axes.others > 1 && (header.integer("byteskip", 0) < 0 || header.has("datafile")))
    throw Error("it has " + std::to_string(axes.sizes.size()) + " axes in data files of their own, which isn't read");
  Image image = volume.image("ImageFile", read_data(file, header, volume, options));
  if (axes.others > 1)
    image.notices.push_back("left out all but the first of " + std::to_string(axes.others) + " volumes");
  place(header, axes, image);
  return image;
}

}  // namespace gale::io::detail
