#pragma once

#include <gale/io/bytes/byte_source.hpp>

namespace gale::io::detail {

/// What base64 text stands for, up to its padding. The source must outlive it. Throws gale::Error for a character that
/// is none of base64's.
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

/// Bytes in memory, which must outlive it.
class MemoryBytes : public ByteSource {
 public:
  explicit MemoryBytes(const std::string& bytes) : bytes_(bytes) {}
  std::size_t read(char* to, std::size_t bytes) override;
  std::uint64_t at_most() const override { return bytes_.size() - at_; }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

}  // namespace gale::io::detail
