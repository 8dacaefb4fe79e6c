#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>

#include <gale/io/bytes/compression.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/formats/volume.hpp>

namespace gale::io::detail {

std::uint64_t Volume::count() const {
  for (const std::int64_t n : {dimensions[0], dimensions[1], dimensions[2], components}) {
    if (n < 1 || n > std::numeric_limits<int>::max())
      damaged("it has ", dimensions[0], " x ", dimensions[1], " x ", dimensions[2], " voxels of ", components,
              " components");
  }
  return product({dimensions[0], dimensions[1], dimensions[2], components}, "dimensions");
}

std::uint64_t Volume::bytes() const { return product(count(), size_of(type)); }

PointArray::Values Volume::read(ByteSource& source) const { return read_values(source, type, count(), order); }

PointArray::Values Volume::read(const InputFile& file, std::uint64_t begin, Packing packing,
                                std::uint64_t behind) const {
  FileBytes content(file, packing == Packing::compressed ? begin : begin + behind);
  if (packing == Packing::raw) return read(content);
  if (packing == Packing::text) {
    TextReader text(content);
    return read_text_values(text, type, count());
  }
  if (auto values = read_at_once(file, begin, behind)) return std::move(*values);
  const auto whole = inflated(file, begin);  // which tells what is wrong
  skip_all(*whole, behind, "what comes before its values");
  PointArray::Values values = read(*whole);
  check_sum(*whole);
  return values;
}

std::optional<PointArray::Values> Volume::read_at_once(const InputFile& file, std::uint64_t begin,
                                                       std::uint64_t behind) const {
  const std::uint64_t all = behind + bytes();
  return with_type(type, [&](auto example) -> std::optional<PointArray::Values> {
    using T = decltype(example);
    std::vector<T> values;
    const auto content = [&] { return reinterpret_cast<char*>(values.data()); };
    const auto room = [&] {
      values.resize((all + sizeof(T) - 1) / sizeof(T));
      return content();
    };
    if (!inflate_at_once(file, begin, all, room)) return std::nullopt;
    std::memmove(content(), content() + behind, bytes());
    values.resize(count());
    to_machine_order(values.data(), values.size(), order);
    return values;
  });
}

Image Volume::image(const std::string& name, PointArray::Values values) const {
  Image image;
  for (int d = 0; d < 3; ++d) image.dimensions[d] = static_cast<int>(dimensions[d]);
  image.arrays.push_back({name, static_cast<int>(components), std::move(values)});
  return image;
}

Image oriented_image(const std::array<std::int64_t, 3>& low, const std::array<std::int64_t, 3>& high,
                     const std::vector<double>& origin, const std::vector<double>& spacing,
                     const std::vector<double>& direction) {
  Image image;
  for (int d = 0; d < 3; ++d) {
    if (high[d] < low[d] || high[d] - low[d] >= std::numeric_limits<std::int32_t>::max())
      damaged("it extends from ", low[d], " to ", high[d]);
    image.dimensions[d] = static_cast<int>(high[d] - low[d] + 1);
    auto& row = image.index_to_physical[d];
    row[3] = origin[d];
    for (int k = 0; k < 3; ++k) {
      row[k] = direction[3 * d + k] * spacing[k];
      row[3] += row[k] * static_cast<double>(low[k]);
    }
  }
  require_finite(image);
  return image;
}

void check_sum(ByteSource& source) {
  char next;
  source.read(&next, 1);  // asked for more at its end, a compressed source looks at its sum
}

void require_finite(const Image& image) {
  for (const auto& row : image.index_to_physical) {
    for (const double value : row) {
      if (!std::isfinite(value)) damaged("the position of its voxels has a value of ", value);
    }
  }
}

std::string path_of_data(const std::string& header, const std::string& name, const ReadOptions& options) {
  namespace fs = std::filesystem;
  std::error_code unknown;
  const fs::path folder = fs::absolute(header, unknown).parent_path();
  const fs::path path = folder / name;
  for (const std::string& output : options.outputs) {
    if (fs::equivalent(output, path, unknown))
      refuse("its data file '", printable(name), "' is to be written, as '", output, "'");
  }
  if (options.outside_files) return path.string();
  const fs::path real_folder = fs::weakly_canonical(folder, unknown), real = fs::weakly_canonical(path, unknown);
  const auto [stop, ignored] = std::mismatch(real_folder.begin(), real_folder.end(), real.begin(), real.end());
  if (name.empty() || name.find('\0') != std::string::npos || stop != real_folder.end())
    refuse("its data file '", printable(name),
           "' is outside of its folder: reading that has to be allowed (--outside-files)");
  return path.string();
}

std::vector<std::string> names_of_pattern(const std::string& pattern, std::int64_t first, std::int64_t last,
                                          std::int64_t step, std::size_t most) {
  const std::size_t percent = pattern.find('%');
  std::size_t end = percent + 1;
  const bool zeros = end < pattern.size() && pattern[end] == '0';
  std::size_t width = 0;
  while (end < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[end])) && width < 100)
    width = 10 * width + static_cast<std::size_t>(pattern[end++] - '0');
  const bool ends_in_d = end < pattern.size() && (pattern[end] == 'd' || pattern[end] == 'i' || pattern[end] == 'u');
  if (percent == std::string::npos || !ends_in_d || width >= 100 || pattern.find('%', end) != std::string::npos)
    damaged("'", pattern, "' is no pattern of file names such as slice%03d.raw");
  if (step < 1 || first < 0 || last < first || static_cast<std::uint64_t>(last - first) / step >= most)
    damaged("its data files go from ", first, " to ", last, " by ", step, ", where at most ", most, " are needed");
  std::vector<std::string> names;
  for (std::int64_t k = first; k <= last; k += step) {
    std::string number = std::to_string(k);
    if (number.size() < width) number.insert(0, width - number.size(), zeros ? '0' : ' ');
    names.push_back(pattern.substr(0, percent) + number + pattern.substr(end + 1));
  }
  return names;
}

const std::string& TextHeader::operator[](const std::string& field) const {
  static const std::string none;
  const auto found = fields.find(field);
  return found == fields.end() ? none : found->second;
}

void TextHeader::set(const std::string& field, const std::string& value) {
  constexpr std::size_t most = 1000;
  if (fields.size() == most) damaged("it has more than ", most, " fields");
  fields[field] = value;
}

void TextHeader::read_list(TextReader& text, bool empty_line_ends_it) {
  for (std::string line; text.line(line);) {
    const std::string name = trimmed(line);
    if (name.empty() && empty_line_ends_it) return;
    if (!name.empty()) list.push_back(name);
    if (list.size() > most_files) damaged("it lists more than ", most_files, " files");
  }
}

std::vector<Step> steps_at(const InputFile& input, const std::vector<double>& times) {
  if (times.size() > most_files) damaged("it has ", times.size(), " times, more than ", most_files);
  if (times.size() < 2) return {{times.empty() || !std::isfinite(times[0]) ? 0 : times[0], input.path()}};
  std::vector<Step> steps;
  for (const double time : times) {
    if (!std::isfinite(time)) damaged("its time ", steps.size(), " is ", time);
    steps.push_back({time, input.path(), steps.size()});
  }
  return steps;
}

std::uint64_t chosen_time(const ReadOptions& options, std::uint64_t times, std::vector<std::string>& notices) {
  const std::uint64_t time = options.time.value_or(0);
  if (time > 0 && time >= times) damaged("it has ", times, " times, and the one at ", time, " is wanted");
  if (times > 1 && !options.time)
    notices.push_back("left out all but the first of " + std::to_string(times) + " time steps");
  return time;
}

}  // namespace gale::io::detail
