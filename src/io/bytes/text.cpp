#include <locale.h>
#include <stdlib.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <sstream>

#include <gale/base/stop.hpp>
#include <gale/io/bytes/text.hpp>

namespace gale::io::detail {
namespace {

constexpr std::size_t longest_word = 1 << 16, longest_line = 1 << 20;

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

std::string printable(const std::string& text) {
  constexpr std::size_t longest = 200;
  std::istringstream words(text.substr(0, 4 * longest));
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  if (line.size() > longest) line = line.substr(0, longest) + "...";
  return line;
}

double zero_or_infinity(std::string_view word) {
  static const locale_t of_c = newlocale(LC_ALL_MASK, "C", nullptr);
  return strtod_l(std::string(word).c_str(), nullptr, of_c);
}

bool TextReader::refill() {
  gale::detail::stop_if_asked();
  if (at_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + at_, end_ - at_);
    end_ -= at_;
    at_ = 0;
  }
  if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
  const std::size_t got = source_.read(buffer_.data() + end_, buffer_.size() - end_);
  end_ += got;
  return got > 0;
}

std::string_view TextReader::word() {
  while (true) {
    while (at_ < end_ && is_space(buffer_[at_])) ++at_;
    if (at_ < end_ || !refill()) break;
  }
  std::size_t length = 0;
  while (true) {
    while (at_ + length < end_ && !is_space(buffer_[at_ + length])) ++length;
    if (at_ + length < end_) break;
    if (length > longest_word) damaged("a word of more than ", longest_word, " bytes");
    if (!refill()) break;
  }
  const std::string_view found(buffer_.data() + at_, length);
  at_ += length;
  return found;
}

bool TextReader::line(std::string& text) {
  text.clear();
  std::size_t length = 0;
  while (true) {
    const char* const begin = buffer_.data() + at_;
    const auto* const stop = static_cast<const char*>(std::memchr(begin + length, '\n', end_ - at_ - length));
    if (stop != nullptr) {
      text.assign(begin, stop);
      at_ += text.size() + 1;
      break;
    }
    length = end_ - at_;
    if (length > longest_line) damaged("a line of more than ", longest_line, " bytes");
    if (refill()) continue;
    if (length == 0) return false;
    text.assign(buffer_.data() + at_, length);
    at_ = end_;
    break;
  }
  if (!text.empty() && text.back() == '\r') text.pop_back();
  return true;
}

std::size_t TextReader::read(char* to, std::size_t bytes) {
  if (bytes < 4096 && bytes > end_ - at_) refill();  // many small pieces go through the buffer
  const std::size_t held = std::min(bytes, end_ - at_);
  std::memcpy(to, buffer_.data() + at_, held);
  at_ += held;
  return held == bytes ? held : held + source_.read(to + held, bytes - held);
}

std::string_view Words::next() {
  std::size_t begin = 0;
  while (begin < rest_.size() && is_space(rest_[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest_.size() && !is_space(rest_[end])) ++end;
  const std::string_view word = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return word;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string trimmed(const std::string& text) {
  const char* const space = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(space);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(space) - first + 1);
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool has_extension(const std::string& name, const std::string& extension) {
  return name.size() > extension.size() && lower_case(name.substr(name.size() - extension.size())) == extension;
}

}  // namespace gale::io::detail
