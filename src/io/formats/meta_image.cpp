#include <algorithm>
#include <cmath>

#include <gale/io/bytes/text.hpp>
#include <gale/io/formats/volume.hpp>

namespace gale::io::detail {
namespace {

using Keys = std::initializer_list<const char*>;

/// The value of the first of the keys that is there, else nullptr.
const std::string* find(const TextHeader& header, const Keys& keys) {
  for (const char* const key : keys) {
    if (header.has(key)) return &header[key];
  }
  return nullptr;
}

bool is(const TextHeader& header, const Keys& keys, bool otherwise) {
  const std::string* const value = find(header, keys);
  if (value == nullptr || value->empty()) return otherwise;
  return (*value)[0] == 'T' || (*value)[0] == 't' || (*value)[0] == '1';
}

/// `count` numbers, or none if no key is there.
template <class T>
std::vector<T> numbers(const TextHeader& header, const Keys& keys, std::size_t count) {
  const std::string* const value = find(header, keys);
  if (value == nullptr) return {};
  std::vector<T> result = numbers_of<T>(*value, *keys.begin());
  if (result.size() < count) damaged(*keys.begin(), " has ", result.size(), " numbers, not ", count);
  return result;
}

template <class T>
T number_or(const TextHeader& header, const char* key, T otherwise) {
  const auto found = numbers<T>(header, {key}, 1);
  return found.empty() ? otherwise : found[0];
}

constexpr const char* data_file = "ElementDataFile";

/// Reads the `Key = Value` lines of a header, which end with ElementDataFile.
TextHeader read_meta_header(const InputFile& file) {
  TextHeader header;
  FileBytes bytes(file, 0);
  TextReader text(bytes);
  for (std::string line; !header.has(data_file) && text.line(line);) {
    const std::size_t equals = line.find('=');
    const std::string key = trimmed(line.substr(0, equals));
    if (equals == std::string::npos && key.empty()) continue;
    if (equals == std::string::npos || key.empty() || printable(key) != key)
      damaged("its line '", line.substr(0, 60), "' is not 'KEY = VALUE'");
    header.set(key, trimmed(line.substr(equals + 1)));
  }
  if (!header.has(data_file)) damaged("it has no ElementDataFile");
  header.end = file.size() - text.at_most();
  if (header[data_file].compare(0, 4, "LIST") == 0) header.read_list(text, false);
  return header;
}

ValueType type_of(const TextHeader& header) {
  static constexpr TypeNames types = {"MET_CHAR",         "MET_UCHAR",          "MET_SHORT",     "MET_USHORT",
                                      "MET_INT|MET_LONG", "MET_UINT|MET_ULONG", "MET_LONG_LONG", "MET_ULONG_LONG",
                                      "MET_FLOAT",        "MET_DOUBLE"};
  if (!header.has("ElementType")) damaged("it has no ElementType");
  const std::string &name = header["ElementType"], array = "_ARRAY";
  const std::size_t rest = name.size() - std::min(name.size(), array.size());
  const auto type = find_type(types, rest > 0 && name.substr(rest) == array ? name.substr(0, rest) : name);
  if (!type) damaged("its ElementType is ", name);
  return *type;
}

Volume volume_of(const TextHeader& header, std::size_t axes) {
  Volume volume;
  const auto sizes = numbers<std::int64_t>(header, {"DimSize"}, axes);
  if (sizes.empty()) damaged("it has no DimSize");
  for (std::size_t d = 0; d < axes; ++d) volume.dimensions[d] = sizes[d];
  volume.components = number_or<std::int64_t>(header, "ElementNumberOfChannels", 1);
  volume.type = type_of(header);
  const bool reversed = is(header, {"ElementByteOrderMSB", "BinaryDataByteOrderMSB"}, false);
  volume.order = reversed ? ByteOrder::big : ByteOrder::little;
  return volume;
}

void place(const TextHeader& header, std::size_t axes, Image& image) {
  auto spacing = numbers<double>(header, {"ElementSpacing", "ElementSize"}, axes);
  const auto origin = numbers<double>(header, {"Offset", "Position", "Origin", "ImagePosition", "ElementOrigin"}, axes);
  const auto turn =
      numbers<double>(header, {"TransformMatrix", "Rotation", "Orientation", "ElementDirection"}, axes * axes);
  spacing.resize(axes, 1);
  for (std::size_t d = 0; d < axes; ++d) {
    for (std::size_t k = 0; k < axes; ++k) {
      const double direction = turn.empty() ? (d == k ? 1 : 0) : turn[axes * k + d];  // a row an axis
      image.index_to_physical[d][k] = direction * std::abs(spacing[k]);
    }
    if (!origin.empty()) image.index_to_physical[d][3] = origin[d];
  }
  require_finite(image);
}

/// Where one data file is, raw or compressed; MetaIO looks for name.gz as well.
std::string find_data(const InputFile& file, const std::string& name, const ReadOptions& options, bool& compressed) {
  const std::string path = path_of_data(file.path(), name, options),
                    zipped = path_of_data(file.path(), name + ".gz", options);
  try {
    return InputFile(path).path();
  } catch (const Error&) {
    try {
      InputFile found(zipped);
      compressed = true;
      return zipped;
    } catch (const Error&) {
      return open_input(path)->path();  // says what is wrong with it
    }
  }
}

/// The names of data files, where there are several: one a slice, or as many slices as the list says.
std::vector<std::string> names_of_slices(const TextHeader& header, const std::vector<std::string>& words,
                                         std::size_t axes, const Volume& volume) {
  const auto slices = static_cast<std::size_t>(volume.dimensions[axes - 1]);
  if (words[0] == "LIST") {
    if (words.size() > 1) {
      const auto file_axes = number<std::int64_t>(words[1], "LIST");
      if (file_axes == static_cast<std::int64_t>(axes) && !header.list.empty()) return {header.list[0]};
      if (file_axes != static_cast<std::int64_t>(axes) - 1)
        refuse("its data files have ", words[1], " of ", axes, " dimensions, which isn't read");
    }
    return header.list;
  }
  std::size_t numbers_begin = words.size();
  const auto is_number = [](const std::string& word) {
    return word.find_first_not_of("0123456789") == std::string::npos;
  };
  while (numbers_begin > 1 && words.size() - numbers_begin < 3 && is_number(words[numbers_begin - 1])) --numbers_begin;
  std::string pattern = words[0];
  for (std::size_t k = 1; k < numbers_begin; ++k) pattern += " " + words[k];
  std::int64_t range[3] = {1, 0, 1};
  for (std::size_t k = numbers_begin; k < words.size(); ++k)
    range[k - numbers_begin] = number<std::int64_t>(words[k], data_file);
  if (words.size() - numbers_begin < 2) range[1] = range[0] + static_cast<std::int64_t>(slices) - 1;
  return names_of_pattern(pattern, range[0], range[1], range[2], slices);
}

PointArray::Values read_slices(const InputFile& file, const TextHeader& header, const std::vector<std::string>& words,
                               std::size_t axes, const Volume& volume, const ReadOptions& options) {
  const auto names = names_of_slices(header, words, axes, volume);
  const std::uint64_t bytes = volume.bytes();
  if (names.empty() || bytes % names.size() != 0)
    damaged("it has ", names.size(), " data files for ", volume.dimensions[axes - 1], " slices");
  std::vector<std::string> paths;
  for (const std::string& name : names) paths.push_back(path_of_data(file.path(), name, options));
  const auto begin = number_or<std::int64_t>(header, "HeaderSize", 0);
  if (begin < 0) damaged("HeaderSize is ", begin, " for several data files");
  const auto begin_of = [begin](const InputFile&) { return static_cast<std::uint64_t>(begin); };
  FileSequence source(paths, begin_of, bytes / names.size());
  return volume.read(source);
}

PointArray::Values read_data(const InputFile& file, const TextHeader& header, std::size_t axes, const Volume& volume,
                             const ReadOptions& options) {
  const std::string& name = header[data_file];
  const auto words = words_of(name);
  if (words.empty()) damaged("ElementDataFile is empty");
  const bool binary = is(header, {"BinaryData"}, true);
  bool compressed = is(header, {"CompressedData"}, false);
  if (words[0] == "LIST" || name.find('%') != std::string::npos) {
    if (compressed || !binary)
      throw Error("its values are in several files that are compressed or text, which isn't read");
    return read_slices(file, header, words, axes, volume, options);
  }
  const bool local = lower_case(name) == "local";
  std::unique_ptr<InputFile> other;
  if (!local) other = open_input(find_data(file, name, options, compressed));
  const InputFile& data = local ? file : *other;
  std::uint64_t begin = local ? header.end : 0;
  const auto skipped = number_or<std::int64_t>(header, "HeaderSize", 0);
  if (skipped > 0) begin = static_cast<std::uint64_t>(skipped);
  if (skipped == -1 && binary && !compressed && volume.bytes() <= data.size()) begin = data.size() - volume.bytes();
  if (skipped < -1) damaged("HeaderSize is ", skipped);
  return volume.read(data, begin, !binary ? Packing::text : compressed ? Packing::compressed : Packing::raw);
}

}  // namespace

Content read_meta_image(const InputFile& file, const ReadOptions& options) {
  const TextHeader header = read_meta_header(file);
  const std::string* const object = find(header, {"ObjectType"});
  if (object != nullptr && lower_case(*object) != "image") damaged("its ObjectType is ", *object);
  const auto axes = number_or<std::int64_t>(header, "NDims", 0);
  if (axes < 1 || axes > 3) damaged("NDims is ", axes, ", not 1 to 3");
  const Volume volume = volume_of(header, static_cast<std::size_t>(axes));
  Image image = volume.image("MetaImage", read_data(file, header, static_cast<std::size_t>(axes), volume, options));
  place(header, static_cast<std::size_t>(axes), image);
  rescale(image, number_or<double>(header, "ElementToIntensityFunctionSlope", 1),
          number_or<double>(header, "ElementToIntensityFunctionOffset", 0));
  return image;
}

}  // namespace gale::io::detail
