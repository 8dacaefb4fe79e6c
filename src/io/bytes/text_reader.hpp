#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gale/io/bytes/byte_source.hpp>

namespace gale::io::detail {

/// Words, lines and raw bytes of a source, which must outlive it.
class TextReader : public ByteSource {
 public:
  explicit TextReader(ByteSource& source);

  /// The next word, without the white space before it; empty at the end. Valid until the next call. Throws gale::Error
  /// for a word of more than 64 KiB.
  std::string_view word();

  /// What is left of the line, without its end; an empty line is "". False at the end of the source. Throws gale::Error
  /// for a line of more than a MiB.
  bool line(std::string& text);

  /// As many bytes as come next, whatever they are.
  std::size_t read(char* to, std::size_t bytes) override;

  std::uint64_t at_most() const override { return (end_ - at_) + source_.at_most(); }

 private:
  /// Makes room and reads more behind what is left of the buffer. False at the end of the source.
  bool refill();

  ByteSource& source_;
  std::vector<char> buffer_;
  std::size_t at_ = 0, end_ = 0;
};

}  // namespace gale::io::detail
