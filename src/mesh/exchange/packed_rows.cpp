#include <cstddef>

#include <gale/mesh/exchange/packed_rows.hpp>

namespace gale::detail {

namespace {

/// The most bytes that the number of rows takes, and that a word does: a difference that repeats, with its count, no
/// more than its rows.
constexpr std::int64_t most_of_rows = 9, most_of_word = 5;

/// Writes a number, the lowest 7 bits first; all bytes but the last have their highest bit set.
char* write_number(std::uint64_t number, char* to) {
  for (; number >= 128; number >>= 7) *to++ = static_cast<char>(number | 128);
  *to++ = static_cast<char>(number);
  return to;
}

std::uint64_t read_number(const char*& from) {
  std::uint64_t number = 0;
  for (int shift = 0;; shift += 7) {
    const auto byte = static_cast<unsigned char>(*from++);
    number |= static_cast<std::uint64_t>(byte & 127) << shift;
    if (byte < 128) return number;
  }
}

/// Numbers small differences of either sign from 0: 0, -1, 1, -2, ...
std::uint32_t folded(std::uint32_t difference) { return difference << 1 ^ (0 - (difference >> 31)); }
std::uint32_t unfolded(std::uint32_t number) { return number >> 1 ^ (0 - (number & 1)); }

/// Writes a difference, with a mark in its lowest bit and a count behind it where more rows have the same.
char* write_difference(std::uint32_t difference, std::int64_t more, char* to) {
  to = write_number(std::uint64_t(folded(difference)) << 1 | (more > 0 ? 1 : 0), to);
  return more > 0 ? write_number(static_cast<std::uint64_t>(more), to) : to;
}

}  // namespace

void pack_rows(const std::uint32_t* words, std::int64_t rows, int width, std::vector<char>& bytes) {
  if (rows == 0) return;
  const std::size_t before = bytes.size();
  bytes.resize(before + static_cast<std::size_t>(most_of_rows + most_of_word * rows * width));
  char* to = write_number(static_cast<std::uint64_t>(rows), bytes.data() + before);
  for (int column = 0; column < width; ++column) {
    const std::uint32_t* at = words + column;
    std::uint32_t last = *at, difference = last;
    std::int64_t more = 0;
    for (std::int64_t row = 1; row < rows; ++row) {
      at += width;
      const std::uint32_t next = *at - last;
      last = *at;
      if (next == difference) {
        ++more;
        continue;
      }
      to = write_difference(difference, more, to);
      difference = next;
      more = 0;
    }
    to = write_difference(difference, more, to);
  }
  bytes.resize(static_cast<std::size_t>(to - bytes.data()));
}

std::int64_t packed_rows(const char* bytes, std::int64_t count) {
  return count == 0 ? 0 : static_cast<std::int64_t>(read_number(bytes));
}

void unpack_rows(const char* bytes, std::int64_t count, int width, std::uint32_t* words) {
  if (count == 0) return;
  const auto rows = static_cast<std::int64_t>(read_number(bytes));
  for (int column = 0; column < width; ++column) {
    std::uint32_t* to = words + column;
    std::uint32_t last = 0;
    for (std::int64_t row = 0; row < rows;) {
      const std::uint64_t number = read_number(bytes);
      const std::uint32_t difference = unfolded(static_cast<std::uint32_t>(number >> 1));
      const std::int64_t same = 1 + ((number & 1) != 0 ? static_cast<std::int64_t>(read_number(bytes)) : 0);
      for (std::int64_t i = 0; i < same; ++i, to += width) *to = last += difference;
      row += same;
    }
  }
}

}  // namespace gale::detail
