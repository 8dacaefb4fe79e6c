#pragma once

#include <vector>

#include <gale/io/atomic_file.hpp>
#include <gale/io/bytes/input_file.hpp>
#include <gale/io/bytes/output_file.hpp>

namespace gale::io::detail {

/// The bytes that base64 text stands for, up to its padding. The source must outlive it. Throws gale::Error for a
/// character that is none of base64's.
class Base64Bytes : public ByteSource {
 public:
  explicit Base64Bytes(ByteSource& text) : text_(text) {}
  std::size_t read(char* to, std::size_t bytes) override;
  std::uint64_t at_most() const override {
    return count_ - at_ + (buffer_.size() - buffer_at_ + text_.at_most()) / 4 * 3 + 3;
  }

  /// Makes what follows the padding readable: another piece of base64.
  void begin_next();

 private:
  /// Decodes the next four characters; false at the end.
  bool decode();

  ByteSource& text_;
  char decoded_[3] = {};
  std::size_t at_ = 0, count_ = 0;
  bool ended_ = false;
  std::vector<char> buffer_;
  std::size_t buffer_at_ = 0;
};

/// Encodes some bytes by themselves; as many characters for as many bytes, whatever these are.
std::vector<char> encode_bytes(const void* bytes, std::size_t size, Encoding encoding);

/// Writes bytes to a file as they are, or as one piece of base64.
class EncodedBytes {
 public:
  /// The file must outlive it.
  EncodedBytes(OutputFile& file, Encoding encoding) : file_(file), encoding_(encoding) {}

  void write(const void* bytes, std::size_t size);

  /// To be called at the end: writes what is left, with padding.
  void end() { write_first(waiting_.size()); }

 private:
  void write_first(std::size_t bytes);

  OutputFile& file_;
  Encoding encoding_;
  std::vector<char> waiting_;  ///< what isn't written yet
};

}  // namespace gale::io::detail
