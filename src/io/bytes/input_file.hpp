#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace gale::io::detail {

/// A regular file that is read at any place, by any number of threads at the same time.
class InputFile {
 public:
  /// Throws gale::Error, which doesn't name the path: no such file, a directory, no regular file, no permission.
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return path_; }

  /// In bytes, when it was opened.
  std::uint64_t size() const { return size_; }

  /// Which file it is, by whatever name: its device and its number there.
  std::pair<std::uint64_t, std::uint64_t> identity() const { return identity_; }

  /// Copies the bytes [at, at + bytes) to `to`. Throws gale::Error if the file ends before, or cannot be read.
  void read(std::uint64_t at, char* to, std::size_t bytes) const;

 private:
  std::string path_;
  int descriptor_;
  std::uint64_t size_;
  std::pair<std::uint64_t, std::uint64_t> identity_;
};

/// Names of files that another one names. One that is named twice would stand for more than it holds.
class DistinctFiles {
 public:
  /// Throws gale::Error if `file`, which the other one calls `name`, has been added by whatever name.
  void add(const InputFile& file, const std::string& name);

 private:
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::string> names_;
};

/// One of the files that another one names. Throws gale::Error, naming its path, if it can't be opened.
std::unique_ptr<InputFile> open_input(const std::string& path);

}  // namespace gale::io::detail
