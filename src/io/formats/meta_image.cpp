#include <cmath>
#include <map>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/numbers.hpp>
#include <gale/io/formats/volume.hpp>

namespace gale::io::detail {

namespace {

/// The `Key = Value` lines of a header, which end with ElementDataFile, and where what follows them begins.
struct Header {
  std::map<std::string, std::string> fields;
  std::vector<std::string> list;  ///< the lines that follow, if the values are in a list of files
  std::uint64_t end = 0;

  /// The value of the first of the keys that is there, else nullptr.
  const std::string* find(std::initializer_list<const char*> keys) const {
    for (const char* const key : keys) {
      const auto found = fields.find(key);
      if (found != fields.end()) return &found->second;
    }
    return nullptr;
  }

  bool is(std::initializer_list<const char*> keys, bool otherwise) const {
    const std::string* const value = find(keys);
    if (value == nullptr || value->empty()) return otherwise;
    return (*value)[0] == 'T' || (*value)[0] == 't' || (*value)[0] == '1';
  }

  /// `count` numbers, or none if no key is there.
  template <class T>
  std::vector<T> numbers(std::initializer_list<const char*> keys, std::size_t count) const {
    const std::string* const value = find(keys);
    std::vector<T> result;
    if (value == nullptr) return result;
    for (const std::string& word : words_of(*value)) result.push_back(number<T>(word, *keys.begin()));
    if (result.size() < count) {
      damaged(std::string(*keys.begin()) + " has " + std::to_string(result.size()) + " numbers, not " +
              std::to_string(count));
    }
    return result;
  }

  template <class T>
  T number_or(const char* key, T otherwise) const {
    const auto found = numbers<T>({key}, 1);
    return found.empty() ? otherwise : found[0];
  }
};

constexpr const char* data_file = "ElementDataFile";

Header read_header(const InputFile& file) {
  constexpr std::size_t most_fields = 1000, most_files = 100000;
  Header header;
  FileBytes bytes(file, 0);
  TextReader text(bytes);
  for (std::string line; text.line(line);) {
    const std::size_t equals = line.find('=');
    const std::string key = trimmed(line.substr(0, equals));
    if (equals == std::string::npos && key.empty()) continue;
    if (equals == std::string::npos || key.empty() || printable(key) != key)
      damaged("its line '" + line.substr(0, 60) + "' is not 'KEY = VALUE'");
    if (header.fields.size() == most_fields) damaged("it has more than " + std::to_string(most_fields) + " fields");
    header.fields[key] = trimmed(line.substr(equals + 1));
    if (key == data_file) break;
  }
  if (header.find({data_file}) == nullptr) damaged("it has no ElementDataFile");
  header.end = file.size() - text.at_most();
  if (header.fields[data_file].compare(0, 4, "LIST") == 0) {
    for (std::string line; text.line(line);) {
      if (!trimmed(line).empty()) header.list.push_back(trimmed(line));
      if (header.list.size() > most_files) damaged("it lists more than " + std::to_string(most_files) + " files");
    }
  }
  return header;
}

ValueType type_of(const Header& header) {
  static const std::map<std::string, ValueType> types = {
      {"MET_CHAR", ValueType::int8},         {"MET_UCHAR", ValueType::uint8},   {"MET_SHORT", ValueType::int16},
      {"MET_USHORT", ValueType::uint16},     {"MET_INT", ValueType::int32},     {"MET_UINT", ValueType::uint32},
      {"MET_LONG", ValueType::int32},        {"MET_ULONG", ValueType::uint32},  {"MET_LONG_LONG", ValueType::int64},
      {"MET_ULONG_LONG", ValueType::uint64}, {"MET_FLOAT", ValueType::float32}, {"MET_DOUBLE", ValueType::float64}};
  const std::string* const name = header.find({"ElementType"});
  if (name == nullptr) damaged("it has no ElementType");
  const std::string array = "_ARRAY";
  const bool is_array =
      name->size() > array.size() && name->compare(name->size() - array.size(), array.size(), array) == 0;
  const auto found = types.find(is_array ? name->substr(0, name->size() - array.size()) : *name);
  if (found == types.end()) damaged("its ElementType is " + *name);
  return found->second;
}

Volume volume_of(const Header& header, std::size_t axes) {
  Volume volume;
  const auto sizes = header.numbers<std::int64_t>({"DimSize"}, axes);
  if (sizes.empty()) damaged("it has no DimSize");
  for (std::size_t d = 0; d < axes; ++d) volume.dimensions[d] = sizes[d];
  volume.components = header.number_or<std::int64_t>("ElementNumberOfChannels", 1);
  volume.type = type_of(header);
  const bool reversed = header.is({"ElementByteOrderMSB", "BinaryDataByteOrderMSB"}, false);
  volume.order = reversed ? ByteOrder::big : ByteOrder::little;
  return volume;
}

void place(const Header& header, std::size_t axes, Image& image) {
  auto spacing = header.numbers<double>({"ElementSpacing", "ElementSize"}, axes);
  const auto origin = header.numbers<double>({"Offset", "Position", "Origin", "ImagePosition", "ElementOrigin"}, axes);
  const auto turn =
      header.numbers<double>({"TransformMatrix", "Rotation", "Orientation", "ElementDirection"}, axes * axes);
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
std::vector<std::string> names_of_slices(const Header& header, const std::vector<std::string>& words, std::size_t axes,
                                         const Volume& volume) {
  const auto slices = static_cast<std::size_t>(volume.dimensions[axes - 1]);
  if (words[0] == "LIST") {
    if (words.size() > 1) {
      const auto file_axes = number<std::int64_t>(words[1], "LIST");
      if (file_axes == static_cast<std::int64_t>(axes) && !header.list.empty()) return {header.list[0]};
      if (file_axes != static_cast<std::int64_t>(axes) - 1)
        throw Error("its data files have " + words[1] + " of " + std::to_string(axes) +
                    " dimensions, which isn't read");
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

PointArray::Values read_slices(const InputFile& file, const Header& header, const std::vector<std::string>& words,
                               std::size_t axes, const Volume& volume, const ReadOptions& options) {
  const auto names = names_of_slices(header, words, axes, volume);
  const std::uint64_t bytes = volume.bytes();
  if (names.empty() || bytes % names.size() != 0) {
    damaged("it has " + std::to_string(names.size()) + " data files for " +
            std::to_string(volume.dimensions[axes - 1]) + " slices");
  }
  std::vector<std::string> paths;
  for (const std::string& name : names) paths.push_back(path_of_data(file.path(), name, options));
  const auto begin = header.number_or<std::int64_t>("HeaderSize", 0);
  if (begin < 0) damaged("HeaderSize is " + std::to_string(begin) + " for several data files");
  FileSequence source(paths, static_cast<std::uint64_t>(begin), bytes / names.size());
  return volume.read(source);
}

PointArray::Values read_data(const InputFile& file, const Header& header, std::size_t axes, const Volume& volume,
                             const ReadOptions& options) {
  const std::string& name = *header.find({data_file});
  const auto words = words_of(name);
  if (words.empty()) damaged("ElementDataFile is empty");
  const bool binary = header.is({"BinaryData"}, true);
  bool compressed = header.is({"CompressedData"}, false);
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
  const auto skipped = header.number_or<std::int64_t>("HeaderSize", 0);
  if (skipped > 0) begin = static_cast<std::uint64_t>(skipped);
  if (skipped == -1 && binary && !compressed && volume.bytes() <= data.size()) begin = data.size() - volume.bytes();
  if (skipped < -1) damaged("HeaderSize is " + std::to_string(skipped));
  return volume.read(data, begin, !binary ? Encoding::text : compressed ? Encoding::compressed : Encoding::raw);
}

}  // namespace

Content read_meta_image(const InputFile& file, const ReadOptions& options) {
  const Header header = read_header(file);
  const std::string* const object = header.find({"ObjectType"});
  if (object != nullptr && lower_case(*object) != "image") damaged("its ObjectType is " + *object);
  const auto axes = header.number_or<std::int64_t>("NDims", 0);
  if (axes < 1 || axes > 3) damaged("NDims is " + std::to_string(axes) + ", not 1 to 3");
  const Volume volume = volume_of(header, static_cast<std::size_t>(axes));
  Image image = volume.image("MetaImage", read_data(file, header, static_cast<std::size_t>(axes), volume, options));
  place(header, static_cast<std::size_t>(axes), image);
  rescale(image, header.number_or<double>("ElementToIntensityFunctionSlope", 1),
          header.number_or<double>("ElementToIntensityFunctionOffset", 0));
  return image;
}

}  // namespace gale::io::detail
