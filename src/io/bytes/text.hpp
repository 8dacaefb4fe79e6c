#pragma once

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/input_file.hpp>

namespace gale::io::detail {

/// Words, lines and raw bytes of a source, which must outlive it.
class TextReader : public ByteSource {
 public:
  explicit TextReader(ByteSource& source) : source_(source), buffer_(1 << 17) {}

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

/// The number that `word` writes, which may have a sign, or be nan or inf if T is of floating point. False unless all
/// of it is a number that T holds; one too small for T is 0, one too large an infinity.
template <class T>
bool parse(std::string_view word, T& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const auto [stop, failure] = std::from_chars(word.data(), end, value);
  if (stop != end || word.empty()) return false;
  if (std::is_floating_point_v<T> && failure == std::errc::result_out_of_range) {
    value = static_cast<T>(std::strtod(std::string(word).c_str(), nullptr));
    return true;
  }
  return failure == std::errc();
}

/// The number that a word is; throws gale::Error, with `what` it should be, for one that isn't.
template <class T>
T number(std::string_view word, const std::string& what) {
  T value;
  if (!parse(word, value)) damaged(what, " is '", word.substr(0, 40), "'");
  return value;
}

/// The words of a line.
std::vector<std::string> words_of(const std::string& line);

/// The numbers that the words of a line are; throws gale::Error, with `what` they should be, for one that isn't.
template <class T>
std::vector<T> numbers_of(const std::string& line, const std::string& what) {
  std::vector<T> result;
  for (const std::string& word : words_of(line)) result.push_back(number<T>(word, what));
  return result;
}

/// The text without white space at its ends.
std::string trimmed(const std::string& text);

std::string lower_case(std::string text);

}  // namespace gale::io::detail
