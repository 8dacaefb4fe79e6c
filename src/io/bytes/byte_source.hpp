#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gale/io/bytes/input_file.hpp>

namespace gale::io::detail {

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

/// The bytes [begin, end) of a file, which must outlive it.
class FileBytes : public ByteSource {
 public:
  FileBytes(const InputFile& file, std::uint64_t begin, std::uint64_t end);
  FileBytes(const InputFile& file, std::uint64_t begin);
  std::size_t read(char* to, std::size_t bytes) override;
  std::uint64_t at_most() const override { return end_ - at_; }

 private:
  const InputFile& file_;
  std::uint64_t at_, end_;
};

/// What several files have in the same place: the bytes [begin, begin + bytes) of each, one after the other. One is
/// open at a time.
class FileSequence : public ByteSource {
 public:
  /// Throws gale::Error, naming the file, if one can't be opened, is shorter, or is there twice.
  FileSequence(const std::vector<std::string>& paths, std::uint64_t begin, std::uint64_t bytes);
  std::size_t read(char* to, std::size_t bytes) override;
  std::uint64_t at_most() const override { return (paths_.size() - current_) * bytes_ - read_; }

 private:
  std::vector<std::string> paths_;
  std::uint64_t begin_, bytes_;
  std::size_t current_ = 0;
  std::uint64_t read_ = 0;  ///< of the current file
  std::unique_ptr<InputFile> file_;
};

}  // namespace gale::io::detail
