#include <algorithm>
#include <array>
#include <cstring>

#include <gale/io/bytes/base64.hpp>
#include <gale/io/bytes/text.hpp>

namespace gale::io::detail {
namespace {

constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr signed char space = -1, wrong = -2, padding = -3;

std::array<signed char, 256> make_digits() {
  std::array<signed char, 256> digits;
  digits.fill(wrong);
  for (const char c : {' ', '\t', '\r', '\n'}) digits[static_cast<unsigned char>(c)] = space;
  for (int k = 0; k < 64; ++k) digits[static_cast<unsigned char>(alphabet[k])] = static_cast<signed char>(k);
  digits['='] = padding;
  return digits;
}

}  // namespace

bool Base64Bytes::decode() {
  static const std::array<signed char, 256> digits = make_digits();
  if (ended_) return false;
  std::uint32_t bits = 0;
  int digits_read = 0, paddings = 0;
  while (digits_read + paddings < 4) {
    if (buffer_at_ == buffer_.size()) {
      buffer_.resize(1 << 16);
      buffer_.resize(text_.read(buffer_.data(), buffer_.size()));
      buffer_at_ = 0;
      if (buffer_.empty()) break;
    }
    const char c = buffer_[buffer_at_++];
    const signed char digit = digits[static_cast<unsigned char>(c)];
    if (digit == space) continue;
    if (digit == wrong || (digit >= 0 && paddings > 0)) damaged("its base64 has a '", c, "'");
    digit == padding ? ++paddings : ++digits_read;
    bits = bits << 6 | (digit == padding ? 0u : static_cast<std::uint32_t>(digit));
  }
  ended_ = digits_read < 4;
  if (digits_read < 2) return false;
  bits <<= 6 * (4 - digits_read - paddings);  // where the text ends without padding
  for (int k = 0; k < 3; ++k) decoded_[k] = static_cast<char>(bits >> (16 - 8 * k) & 0xff);
  at_ = 0;
  count_ = static_cast<std::size_t>(digits_read - 1);
  return true;
}

std::size_t Base64Bytes::read(char* to, std::size_t bytes) {
  std::size_t got = 0;
  while (got < bytes) {
    if (at_ == count_ && !decode()) break;
    const std::size_t part = std::min(bytes - got, count_ - at_);
    std::memcpy(to + got, decoded_ + at_, part);
    at_ += part;
    got += part;
  }
  return got;
}

void Base64Bytes::begin_next() {
  at_ = count_ = 0;
  ended_ = false;
}

std::vector<char> encode_bytes(const void* bytes, std::size_t size, Encoding encoding) {
  const auto* const from = static_cast<const unsigned char*>(bytes);
  if (encoding == Encoding::appended) return {from, from + size};
  std::vector<char> text;
  text.reserve((size + 2) / 3 * 4);
  for (std::size_t at = 0; at < size; at += 3) {
    const std::size_t count = std::min<std::size_t>(3, size - at);
    unsigned bits = from[at] << 16;
    if (count > 1) bits |= from[at + 1] << 8;
    if (count > 2) bits |= from[at + 2];
    const char four[] = {alphabet[bits >> 18], alphabet[bits >> 12 & 63], count > 1 ? alphabet[bits >> 6 & 63] : '=',
                         count > 2 ? alphabet[bits & 63] : '='};
    text.insert(text.end(), four, four + 4);
  }
  return text;
}

void EncodedBytes::write(const void* bytes, std::size_t size) {
  if (encoding_ == Encoding::appended) return file_.write(bytes, size);
  const auto* const from = static_cast<const char*>(bytes);
  waiting_.insert(waiting_.end(), from, from + size);
  write_first(waiting_.size() / 3 * 3);  // that many make whole groups of four characters
}

void EncodedBytes::write_first(std::size_t bytes) {
  const std::vector<char> text = encode_bytes(waiting_.data(), bytes, encoding_);
  file_.write(text.data(), text.size());
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(bytes));
}

}  // namespace gale::io::detail
