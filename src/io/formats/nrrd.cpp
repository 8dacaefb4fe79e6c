#include <algorithm>
#include <cmath>

#include <gale/io/bytes/text.hpp>
#include <gale/io/formats/volume.hpp>

namespace gale::io::detail {
namespace {

std::int64_t integer(const TextHeader& header, const std::string& field, std::int64_t otherwise) {
  return header.has(field) ? number<std::int64_t>(header[field], field) : otherwise;
}

std::string without_spaces(std::string text) {
  std::string result;
  for (const char c : text) {
    if (c != ' ') result += c;
  }
  return result;
}

/// Fields have their names in lower case, without spaces.
TextHeader read_nrrd_header(const InputFile& file) {
  TextHeader header;
  FileBytes bytes(file, 0);
  TextReader text(bytes);
  std::string line;
  if (!text.line(line) || line.compare(0, 4, "NRRD") != 0) damaged("its first line is not 'NRRD...'");
  while (text.line(line) && !line.empty()) {
    if (line[0] == '#') continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) damaged("its line '", line.substr(0, 60), "' is not 'FIELD: VALUE'");
    if (line.compare(colon, 2, ":=") == 0) continue;  // for the user's own purposes
    const std::string field = without_spaces(lower_case(line.substr(0, colon)));
    header.set(field, trimmed(line.substr(colon + 1)));
    if (field != "datafile" || header[field].compare(0, 4, "LIST") != 0) continue;
    header.read_list(text, true);
    break;
  }
  header.end = file.size() - text.at_most();
  return header;
}

constexpr TypeNames nrrd_types = {
    "signed char|int8|int8_t",
    "uchar|unsigned char|uint8|uint8_t",
    "short|short int|signed short|signed short int|int16|int16_t",
    "ushort|unsigned short|unsigned short int|uint16|uint16_t",
    "int|signed int|int32|int32_t",
    "uint|unsigned int|uint32|uint32_t",
    "longlong|long long|long long int|signed long long|signed long long int|int64|int64_t",
    "ulonglong|unsigned long long|unsigned long long int|uint64|uint64_t",
    "float",
    "double"};

/// "(1,2,3)" as numbers; empty for "none".
std::vector<double> vector_of(const std::string& text, const std::string& field) {
  if (text == "none") return {};
  if (text.size() < 2 || text.front() != '(' || text.back() != ')') damaged(field, " is '", text, "'");
  std::vector<double> result;
  std::string rest = text.substr(1, text.size() - 2);
  while (true) {
    const std::size_t comma = rest.find(',');
    result.push_back(number<double>(trimmed(rest.substr(0, comma)), field));
    if (comma == std::string::npos) return result;
    rest = rest.substr(comma + 1);
  }
}

/// The axes of the file: components first, if any, then up to three of space, then others, of which the first
/// place alone is read.
struct FileAxes {
  std::vector<std::int64_t> sizes;
  std::size_t first_in_space = 0;
  std::uint64_t others = 1;
};

FileAxes axes_of(const TextHeader& header) {
  FileAxes axes;
  axes.sizes = numbers_of<std::int64_t>(header["sizes"], "sizes");
  const auto dimension = integer(header, "dimension", 0);
  if (dimension < 1 || dimension > 16 || axes.sizes.size() != static_cast<std::size_t>(dimension))
    damaged("it has ", axes.sizes.size(), " sizes for ", dimension, " dimensions");
  for (const std::int64_t size : axes.sizes) {
    if (size < 1) damaged("one of its sizes is ", size);
  }
  const auto kinds = words_of(lower_case(header["kinds"]));
  const auto directions = words_of(header["spacedirections"]);
  const auto spacings = words_of(header["spacings"]);
  const auto is_space = [&](std::size_t axis) {
    if (axis < directions.size()) return directions[axis] != "none";
    if (axis < kinds.size() && kinds[axis] != "???" && kinds[axis] != "none")
      return kinds[axis] == "domain" || kinds[axis] == "space";
    if (axis < spacings.size() && lower_case(spacings[axis]) == "nan") return false;
    return axis > 0 || dimension <= 3;  // the first of four without a word about them is taken for components
  };
  axes.first_in_space = is_space(0) ? 0 : 1;
  for (std::size_t axis = axes.first_in_space; axis < axes.sizes.size(); ++axis) {
    if (axis < axes.first_in_space + 3 && !is_space(axis)) damaged("its axis ", axis, " is not of space");
    if (axis >= axes.first_in_space + 3)
      axes.others = product({static_cast<std::int64_t>(axes.others), axes.sizes[axis]}, "sizes");
  }
  return axes;
}

void place(const TextHeader& header, const FileAxes& axes, Image& image) {
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
std::vector<std::string> data_files(const TextHeader& header) {
  if (!header.has("datafile")) return {};
  const std::string& value = header["datafile"];
  const auto words = words_of(value);
  if (words.empty()) damaged("its data file has no name");
  if (words[0] == "LIST") return header.list;
  if (words.size() < 4 || value.find('%') == std::string::npos) return {value};
  return names_of_pattern(words[0], number<std::int64_t>(words[1], "data file"),
                          number<std::int64_t>(words[2], "data file"), number<std::int64_t>(words[3], "data file"),
                          most_files);
}

/// Where a file goes on past the lines to skip.
std::uint64_t skip_lines(const InputFile& data, std::uint64_t begin, const TextHeader& header) {
  const auto lines = integer(header, "lineskip", 0);
  if (lines < 0) damaged("it skips ", lines, " lines");
  if (lines == 0) return begin;
  FileBytes source(data, begin);
  TextReader text(source);
  std::string line;
  for (std::int64_t k = 0; k < lines; ++k) {
    if (!text.line(line)) damaged("its file '", data.path(), "' ends before the ", lines, " lines to skip");
  }
  return data.size() - text.at_most();
}

/// The bytes to skip behind these lines; nothing where the values are the last bytes of their file.
std::optional<std::uint64_t> bytes_to_skip(const TextHeader& header, bool is_raw) {
  const auto bytes = integer(header, "byteskip", 0);
  if (bytes < -1) damaged("it skips ", bytes, " bytes");
  if (bytes == -1 && !is_raw) damaged("its byte skip is -1, which is for raw values alone");
  return bytes == -1 ? std::nullopt : std::optional(static_cast<std::uint64_t>(bytes));
}

/// Where the last bytes of a file begin, which come behind others.
std::uint64_t begin_of_last(std::uint64_t bytes, const InputFile& data, std::uint64_t behind) {
  if (bytes > data.size() - behind)
    damaged("its file '", data.path(), "' has ", data.size() - behind, " bytes of values, not ", bytes);
  return data.size() - bytes;
}

PointArray::Values read_data(const InputFile& file, const TextHeader& header, const Volume& volume,
                             const ReadOptions& options) {
  const std::string encoding = lower_case(header["encoding"]);
  const bool raw = encoding.empty() || encoding == "raw", zipped = encoding == "gzip" || encoding == "gz";
  const bool text = encoding == "ascii" || encoding == "txt" || encoding == "text";
  if (!raw && !zipped && !text) refuse("its encoding is '", printable(encoding), "': raw, gzip and text are read");
  std::vector<std::string> paths;
  for (const std::string& name : data_files(header)) paths.push_back(path_of_data(file.path(), name, options));
  if (header.has("datafile") && paths.empty()) damaged("it names no data file");
  const std::optional<std::uint64_t> skipped = bytes_to_skip(header, raw);
  if (paths.size() > 1) {
    if (!raw) refuse("its values are in several files of the encoding ", encoding, ", which isn't read");
    if (volume.bytes() % paths.size() != 0) damaged("its ", paths.size(), " data files don't have the same size");
    const std::uint64_t bytes = volume.bytes() / paths.size();
    const auto begin = [&](const InputFile& data) {
      const std::uint64_t behind_lines = skip_lines(data, 0, header);
      return skipped ? behind_lines + *skipped : begin_of_last(bytes, data, behind_lines);
    };
    FileSequence source(paths, begin, bytes);
    return volume.read(source);
  }
  std::unique_ptr<InputFile> other;
  if (!paths.empty()) other = open_input(paths[0]);
  const InputFile& data = other ? *other : file;
  const std::uint64_t behind_lines = skip_lines(data, other ? 0 : header.end, header);
  if (!skipped) return volume.read(data, begin_of_last(volume.bytes(), data, behind_lines), Packing::raw);
  return volume.read(data, behind_lines, text ? Packing::text : zipped ? Packing::compressed : Packing::raw, *skipped);
}

}  // namespace

Content read_nrrd(const InputFile& file, const ReadOptions& options) {
  const TextHeader header = read_nrrd_header(file);
  const FileAxes axes = axes_of(header);
  Volume volume;
  const auto type = find_type(nrrd_types, lower_case(header["type"]));
  if (!type) damaged("its type is '", lower_case(header["type"]), "'");
  volume.type = *type;
  if (axes.first_in_space == 1) volume.components = axes.sizes[0];
  for (std::size_t k = 0; k < 3 && axes.first_in_space + k < axes.sizes.size(); ++k)
    volume.dimensions[k] = axes.sizes[axes.first_in_space + k];
  const std::string endian = lower_case(header["endian"]);
  if (!endian.empty() && endian != "little" && endian != "big") damaged("its endian is '", endian, "'");
  if (!endian.empty()) volume.order = endian == "big" ? ByteOrder::big : ByteOrder::little;
  if (axes.others > 1 && (integer(header, "byteskip", 0) < 0 || header.has("datafile")))
    refuse("it has ", axes.sizes.size(), " axes in data files of their own, which isn't read");
  Image image = volume.image("ImageFile", read_data(file, header, volume, options));
  if (axes.others > 1)
    image.notices.push_back("left out all but the first of " + std::to_string(axes.others) + " volumes");
  place(header, axes, image);
  return image;
}

}  // namespace gale::io::detail
