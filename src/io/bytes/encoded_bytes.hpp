#pragma once

#include <vector>

#include <gale/io/atomic_file.hpp>
#include <gale/io/bytes/output_file.hpp>

namespace gale::io::detail {

/// Writes bytes to a file as they are, or as one piece of base64.
class EncodedBytes {
 public:
  /// The file must outlive it.
  EncodedBytes(OutputFile& file, Encoding encoding) : file_(file), encoding_(encoding) {}

  void write(const void* bytes, std::size_t size);

  /// To be called at the end: writes what is left, with padding.
  void end();

 private:
  OutputFile& file_;
  Encoding encoding_;
  unsigned char rest_[3] = {};  ///< what doesn't make four characters yet
  std::size_t rest_size_ = 0;
  std::vector<char> text_;
};

/// What stands for some bytes by themselves; as many characters for as many bytes, whatever these are.
std::vector<char> encoded(const void* bytes, std::size_t size, Encoding encoding);

}  // namespace gale::io::detail
