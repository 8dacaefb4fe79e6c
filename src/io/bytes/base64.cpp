#include <algorithm>
#include <array>
#include <cstring>

#include <gale/io/bytes/base64.hpp>
#include <gale/io/bytes/damaged.hpp>

namespace gale::io::detail {

namespace {

constexpr signed char space = -1, wrong = -2, padding = -3;

std::array<signed char, 256> make_digits() {
  std::array<signed char, 256> digits;
  digits.fill(wrong);
  for (const char c : {' ', '\t', '\r', '\n'}) digits[static_cast<unsigned char>(c)] = space;
  const char* const alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
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
    if (digit == wrong || (digit >= 0 && paddings > 0)) damaged(std::string("its base64 has a '") + c + "'");
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

std::size_t MemoryBytes::read(char* to, std::size_t bytes) {
  const std::size_t count = std::min(bytes, bytes_.size() - at_);
  std::memcpy(to, bytes_.data() + at_, count);
  at_ += count;
  return count;
}

}  // namespace gale::io::detail
