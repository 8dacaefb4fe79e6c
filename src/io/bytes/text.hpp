#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/export.hpp>
#include <gale/io/bytes/input_file.hpp>

/// Texts: of messages, and of files as words, lines and numbers.
namespace gale::io::detail {

/// The parts one behind the other; numbers as std::to_string() writes them.
template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::string text;
  const auto add = [&text](const auto& part) {
    using Part = std::decay_t<decltype(part)>;
    if constexpr (std::is_arithmetic_v<Part> && !std::is_same_v<Part, char>) {
      text += std::to_string(part);
    } else {
      text += part;
    }
  };
  (add(parts), ...);
  return text;
}

/// Throws gale::Error with a message of these parts.
template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  throw Error(text_of(parts...));
}

/// `text` from a file as one short line that can be printed.
GALE_EXPORT std::string printable(const std::string& text);

/// Throws gale::Error about a file whose content isn't what its format says. The parts are the reason, which names the
/// value at fault; bytes of the file that it quotes become printable, and it is cut where it is long.
template <class... Parts>
[[noreturn]] void damaged(const Parts&... parts) {
  refuse("it is damaged, incomplete or of another format (", printable(text_of(parts...)), ")");
}

/// Where the text of a file begins: behind UTF-8's byte-order mark, where it has one.
inline std::uint64_t begin_of_text(const InputFile& file) {
  const std::string mark = "\xef\xbb\xbf";
  return file.begins_with(mark) ? mark.size() : 0;
}

/// Words, lines and raw bytes of a source, which must outlive it.
class TextReader : public ByteSource {
 public:
  explicit TextReader(ByteSource& source) : source_(source), buffer_(1 << 17) {}

  /// The next word, without the white space before it; empty at the end. Valid until the next call. Throws gale::Error
  /// for a word of more than 64 KiB.
  std::string_view word();

  /// Reads the rest of the line, without its end; an empty line is "". False at the end of the source. Throws
  /// gale::Error for a line of more than a MiB.
  bool line(std::string& text);

  /// Reads the bytes that come next, whatever they are.
  std::size_t read(char* to, std::size_t bytes) override;

  std::uint64_t at_most() const override { return (end_ - at_) + source_.at_most(); }

 private:
  /// Makes room and reads more behind what is left of the buffer. False at the end of the source.
  bool refill();

  ByteSource& source_;
  std::vector<char> buffer_;
  std::size_t at_ = 0, end_ = 0;
};

/// The double nearest to a number beyond what another type holds: 0 or an infinity where no double holds it.
double zero_or_infinity(std::string_view word);

/// The number that `word` writes, which may have a sign, or be nan or inf if T is of floating point. False unless all
/// of it is a number that T holds; one too small for T is 0, one too large an infinity.
template <class T>
bool parse(std::string_view word, T& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const auto [stop, failure] = std::from_chars(word.data(), end, value);
  if (stop != end || word.empty()) return false;
  if (std::is_floating_point_v<T> && failure == std::errc::result_out_of_range) {
    value = static_cast<T>(zero_or_infinity(word));
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

/// The words of a line one after the other.
class Words {
 public:
  /// Begins before the first word of a line, which must outlive this.
  explicit Words(std::string_view line) : rest_(line) {}

  /// The next word; empty at the end of the line.
  std::string_view next();

 private:
  std::string_view rest_;
};

/// The words of a line.
std::vector<std::string> words_of(const std::string& line);

/// The numbers that the words of a line are; throws gale::Error, with `what` they should be, for one that isn't.
template <class T>
std::vector<T> numbers_of(const std::string& line, const std::string& what) {
  std::vector<T> result;
  for (const std::string& word : words_of(line)) result.push_back(number<T>(word, what));
  return result;
}

/// The words with `between` them.
GALE_EXPORT std::string joined(const std::vector<std::string>& words, const std::string& between);

/// The text without white space at its ends.
std::string trimmed(const std::string& text);

/// The text with small letters for those of ASCII.
GALE_EXPORT std::string lower_case(std::string text);

/// Whether a name of more than that ends with an extension, which is in lower case, dot and all; in either case.
GALE_EXPORT bool has_extension(const std::string& name, const std::string& extension);

}  // namespace gale::io::detail
