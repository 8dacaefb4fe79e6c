#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include <gale/app/options.hpp>
#include <gale/app/output_names.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/base/error.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/formats.hpp>

namespace gale::app {

namespace fs = std::filesystem;

namespace {

/// Where a path leads, as far as links can be followed, whether there is a file or not.
fs::path real_path(const std::string& path) {
  std::error_code failure;
  std::string end = path;
  try {
    end = io::detail::end_of_links(path);
  } catch (const Error&) {
    // Who opens it says what is wrong.
  }
  const fs::path absolute = fs::absolute(end, failure), real = fs::weakly_canonical(absolute, failure);
  return failure ? absolute.lexically_normal() : real;
}

/// Which file a path leads to, by whatever link: its device and its number there; zeros if there is none.
std::pair<dev_t, ino_t> identity_of(const std::string& path) {
  struct stat status;
  return stat(path.c_str(), &status) == 0 ? std::pair(status.st_dev, status.st_ino) : std::pair(dev_t(0), ino_t(0));
}

}  // namespace

WrittenFiles files_written(const std::vector<std::string>& named, std::size_t steps, const Ranks& ranks) {
  WrittenFiles written;
  const auto add = [&](const std::string& file, int writer) {
    written.all.push_back(file);
    if (writer == ranks.rank()) written.own.push_back(file);
  };
  for (const std::string& file : named) {
    for (std::size_t step = 0; step < std::max<std::size_t>(steps, 1); ++step) {
      const std::string here = steps > 0 ? name_of_step(file, step) : file;
      add(here, 0);
      for (int rank = 0; rank < ranks.size() && has_pieces(here); ++rank) add(piece_of(here, rank), rank);
    }
    if (steps > 0 && !name_of_series(file).empty()) add(name_of_series(file), 0);
  }
  return written;
}

void require_distinct(const std::vector<std::string>& files, const std::vector<std::string>& inputs) {
  std::set<fs::path> all;
  std::set<std::pair<dev_t, ino_t>> read;
  for (const std::string& input : inputs) {
    all.insert(real_path(input));
    read.insert(identity_of(input));
  }
  read.erase({0, 0});
  for (const std::string& file : files) {
    if (!all.insert(real_path(file)).second || read.count(identity_of(file)) > 0)
      throw UsageError("'" + file + "' is named for two files");
  }
}

std::string name_of_step(const std::string& path, std::size_t step) {
  const fs::path all(path);
  const std::string number = std::to_string(step);
  return fs::path(all).replace_extension().string() + '_' +
         std::string(4 - std::min<std::size_t>(4, number.size()), '0') + number + all.extension().string();
}

std::string name_of_series(const std::string& path) {
  const io::Format* const format = io::format_of(path);
  return format != nullptr && format->series != nullptr ? format->series(path) : "";
}

bool has_pieces(const std::string& path) {
  const io::Format* const format = io::format_of(path);
  return Launch::are_several() && format != nullptr && format->pieces != nullptr;
}

std::string piece_of(const std::string& path, int rank) {
  const io::Format* const format = io::format_of(path);
  const char* const extension = format == nullptr ? nullptr : format->pieces;
  return fs::path(path).replace_extension().string() + '_' + std::to_string(rank) +
         (extension == nullptr ? fs::path(path).extension().string() : extension);
}

}  // namespace gale::app
