#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gale/io/bytes/descriptor.hpp>

/// Files that are read, and bytes that come one after the other, from these or elsewhere.
namespace gale::io::detail {

/// A regular file that is read at any place, by any number of threads at the same time.
class InputFile {
 public:
  /// Throws gale::Error, which doesn't name the path: no such file, a directory, no regular file, no permission.
  explicit InputFile(const std::string& path);

  const std::string& path() const { return path_; }

  /// The size in bytes when it was opened.
  std::uint64_t size() const { return size_; }

  /// Which file it is, by whatever name: its device and its number there.
  std::pair<std::uint64_t, std::uint64_t> identity() const { return identity_; }

  /// Copies the bytes [at, at + bytes) to `to`. Throws gale::Error if the file ends before, or cannot be read.
  void read(std::uint64_t at, char* to, std::size_t bytes) const;

  /// Whether the file's first bytes are these.
  bool begins_with(const std::string& magic) const;

 private:
  std::string path_;
  Descriptor descriptor_;
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

/// Bytes that come one after the other.
class ByteSource {
 public:
  virtual ~ByteSource() = default;

  /// Copies what comes next to `to`; returns how much, which is less than `bytes` at the end alone.
  virtual std::size_t read(char* to, std::size_t bytes) = 0;

  /// No more than this can still come: known without reading, so that nothing is allocated that no file can fill.
  virtual std::uint64_t at_most() const = 0;
};

/// Throws gale::Error unless `source` had all of them. `what` they are is for the message.
void read_all(ByteSource& source, char* to, std::size_t bytes, const char* what);

/// Reads bytes that nobody wants. Throws gale::Error unless `source` had all of them.
void skip_all(ByteSource& source, std::uint64_t bytes, const char* what);

/// The bytes of a file, which must outlive it, from `begin` on.
class FileBytes : public ByteSource {
 public:
  FileBytes(const InputFile& file, std::uint64_t begin);
  std::size_t read(char* to, std::size_t bytes) override;
  std::uint64_t at_most() const override { return file_.size() - at_; }

 private:
  const InputFile& file_;
  std::uint64_t at_;
};

/// Values that several files have: the bytes [begin, begin + bytes) of each, one after the other. One is open at a
/// time.
class FileSequence : public ByteSource {
 public:
  /// Finds where the values of a file begin.
  using Begin = std::function<std::uint64_t(const InputFile& file)>;

  /// Throws gale::Error, naming the file, if one can't be opened, is shorter, or is there twice, and what begin()
  /// throws.
  FileSequence(const std::vector<std::string>& paths, const Begin& begin, std::uint64_t bytes);
  std::size_t read(char* to, std::size_t bytes) override;
  std::uint64_t at_most() const override { return (paths_.size() - current_) * bytes_ - read_; }

 private:
  std::vector<std::string> paths_;
  std::vector<std::uint64_t> begin_;  ///< in each file
  std::uint64_t bytes_;
  std::size_t current_ = 0;
  std::uint64_t read_ = 0;  ///< how much of the current file
  std::unique_ptr<InputFile> file_;
};

/// Bytes in memory, which must outlive it.
class MemoryBytes : public ByteSource {
 public:
  explicit MemoryBytes(std::string_view bytes) : bytes_(bytes) {}
  std::size_t read(char* to, std::size_t bytes) override;
  std::uint64_t at_most() const override { return bytes_.size() - at_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace gale::io::detail
