#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gale/io/bytes/descriptor.hpp>

namespace gale::io::detail {

/// A file that is written from its beginning on, but for places that are filled in later. Each function throws
/// gale::Error, without the path, where the system takes no more: a full disk, a limit of the file's size.
class OutputFile {
 public:
  /// Opens a file that is there, which loses what it has.
  explicit OutputFile(const std::string& path);

  void write(const void* bytes, std::size_t size);
  void write(const std::string& text) { write(text.data(), text.size()); }

  /// Replaces bytes that were written: those from `at` on.
  void rewrite(std::uint64_t at, const void* bytes, std::size_t size);

  /// The bytes written so far.
  std::uint64_t size() const { return flushed_ + buffered_.size(); }

  /// To be called at the end: the system has all of it then.
  void flush();

 private:
  Descriptor descriptor_;
  std::uint64_t flushed_ = 0;
  std::vector<char> buffered_;
};

}  // namespace gale::io::detail
