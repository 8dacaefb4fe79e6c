#include <algorithm>

#include <gale/io/bytes/encoded_bytes.hpp>

namespace gale::io::detail {

namespace {

/// Appends the four characters for up to three bytes, of which there are three.
void append_four(const unsigned char* three, std::size_t size, std::vector<char>& text) {
  const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const unsigned bits = three[0] << 16 | three[1] << 8 | three[2];
  const char four[] = {digits[bits >> 18], digits[bits >> 12 & 63], size > 1 ? digits[bits >> 6 & 63] : '=',
                       size > 2 ? digits[bits & 63] : '='};
  text.insert(text.end(), four, four + 4);
}

}  // namespace

void EncodedBytes::write(const void* bytes, std::size_t size) {
  if (encoding_ == Encoding::appended) {
    file_.write(bytes, size);
    return;
  }
  const auto *from = static_cast<const unsigned char*>(bytes), *const end = from + size;
  text_.clear();
  while (rest_size_ > 0 && rest_size_ < 3 && from < end) rest_[rest_size_++] = *from++;
  if (rest_size_ == 3) {
    append_four(rest_, 3, text_);
    rest_size_ = 0;
  }
  for (; end - from >= 3; from += 3) append_four(from, 3, text_);
  while (from < end) rest_[rest_size_++] = *from++;
  file_.write(text_.data(), text_.size());
}

void EncodedBytes::end() {
  if (rest_size_ == 0) return;
  std::fill(rest_ + rest_size_, rest_ + 3, static_cast<unsigned char>(0));
  text_.clear();
  append_four(rest_, rest_size_, text_);
  rest_size_ = 0;
  file_.write(text_.data(), text_.size());
}

std::vector<char> encoded(const void* bytes, std::size_t size, Encoding encoding) {
  const auto* const from = static_cast<const unsigned char*>(bytes);
  if (encoding == Encoding::appended) return {from, from + size};
  std::vector<char> text;
  for (std::size_t at = 0; at < size; at += 3) {
    unsigned char three[3] = {};
    const std::size_t count = std::min<std::size_t>(3, size - at);
    std::copy_n(from + at, count, three);
    append_four(three, count, text);
  }
  return text;
}

}  // namespace gale::io::detail
