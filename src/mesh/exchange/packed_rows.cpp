#include <algorithm>
#include <cstddef>
#include <cstring>

#include <gale/mesh/exchange/packed_rows.hpp>

namespace gale::detail {

namespace {

constexpr std::int64_t word_bytes = sizeof(std::uint32_t);

std::uint32_t word_at(const char* bytes) {
  std::uint32_t word;
  std::memcpy(&word, bytes, word_bytes);
  return word;
}

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

std::vector<char> pack_rows(const void* words, std::int64_t rows, int width) {
  // A difference takes 5 bytes at most, and with the count of its repetitions no more than its rows would.
  constexpr std::int64_t rows_at_once = 4096, most_of_word = 5, most_of_number = 9;
  if (rows == 0) return {};
  std::vector<char> bytes(most_of_number);
  char* to = write_number(static_cast<std::uint64_t>(rows), bytes.data());
  for (int column = 0; column < width; ++column) {
    const char* at = static_cast<const char*>(words) + column * word_bytes;
    std::uint32_t last = 0, difference = 0;
    std::int64_t more = -1;  // no difference yet
    for (std::int64_t row = 0; row < rows;) {
      const auto used = static_cast<std::size_t>(to - bytes.data());
      const std::int64_t end = std::min(row + rows_at_once, rows);
      bytes.resize(used + static_cast<std::size_t>(most_of_word * (end - row) + 2 * (most_of_word + most_of_number)));
      to = bytes.data() + used;
      for (; row < end; ++row, at += width * word_bytes) {
        const std::uint32_t word = word_at(at), next = word - last;
        last = word;
        if (more >= 0 && next == difference) {
          ++more;
          continue;
        }
        if (more >= 0) to = write_difference(difference, more, to);
        difference = next;
        more = 0;
      }
    }
    to = write_difference(difference, more, to);
  }
  bytes.resize(static_cast<std::size_t>(to - bytes.data()));
  return bytes;
}

std::int64_t packed_rows(const char* bytes, std::int64_t count) {
  return count == 0 ? 0 : static_cast<std::int64_t>(read_number(bytes));
}

void unpack_rows(const char* bytes, std::int64_t count, int width, void* words) {
  if (count == 0) return;
  const auto rows = static_cast<std::int64_t>(read_number(bytes));
  for (int column = 0; column < width; ++column) {
    char* to = static_cast<char*>(words) + column * word_bytes;
    std::uint32_t last = 0;
    for (std::int64_t row = 0; row < rows;) {
      const std::uint64_t number = read_number(bytes);
      const std::uint32_t difference = unfolded(static_cast<std::uint32_t>(number >> 1));
      const std::int64_t same = 1 + ((number & 1) != 0 ? static_cast<std::int64_t>(read_number(bytes)) : 0);
      for (std::int64_t i = 0; i < same; ++i, to += width * word_bytes) {
        last += difference;
        std::memcpy(to, &last, word_bytes);
      }
      row += same;
    }
  }
}

}  // namespace gale::detail
