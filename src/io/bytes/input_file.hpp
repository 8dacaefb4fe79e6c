#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

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

  /// Copies the bytes [at, at + bytes) to `to`. Throws gale::Error if the file ends before, or cannot be read.
  void read(std::uint64_t at, char* to, std::size_t bytes) const;

 private:
  std::string path_;
  int descriptor_;
  std::uint64_t size_;
};

/// One of the files that another one names. Throws gale::Error, naming its path, if it can't be opened.
std::unique_ptr<InputFile> open_input(const std::string& path);

}  // namespace gale::io::detail
