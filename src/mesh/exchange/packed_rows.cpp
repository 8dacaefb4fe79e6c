#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>

#include <gale/base/threads.hpp>
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

/// Adds a number to bytes that are few.
void add_number(std::int64_t number, std::vector<char>& bytes) {
  char written[10];
  bytes.insert(bytes.end(), written, write_number(static_cast<std::uint64_t>(number), written));
}

/// Numbers small differences of either sign from 0: 0, -1, 1, -2, ...
std::uint32_t folded(std::uint32_t difference) { return difference << 1 ^ (0 - (difference >> 31)); }
std::uint32_t unfolded(std::uint32_t number) { return number >> 1 ^ (0 - (number & 1)); }

/// Writes a difference, with a mark in its lowest bit and a count behind it where more rows have the same.
char* write_difference(std::uint32_t difference, std::int64_t more, char* to) {
  to = write_number(std::uint64_t(folded(difference)) << 1 | (more > 0 ? 1 : 0), to);
  return more > 0 ? write_number(static_cast<std::uint64_t>(more), to) : to;
}

/// Packs a column of rows from its first word on.
std::vector<char> pack_column(const char* at, std::int64_t rows, int width) {
  // A difference takes 5 bytes at most, and with the count of its repetitions no more than its rows would.
  constexpr std::int64_t rows_at_once = 4096, most_of_word = 5, most_of_number = 9;
  std::vector<char> bytes;
  char* to = bytes.data();
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
  bytes.resize(static_cast<std::size_t>(to - bytes.data()));
  return bytes;
}

/// Unpacks a column of rows to its first word and on. Returns where it ends.
const char* unpack_column(const char* from, std::int64_t rows, int width, char* to) {
  std::uint32_t last = 0;
  for (std::int64_t row = 0; row < rows;) {
    const std::uint64_t number = read_number(from);
    const std::uint32_t difference = unfolded(static_cast<std::uint32_t>(number >> 1));
    const std::int64_t same = 1 + ((number & 1) != 0 ? static_cast<std::int64_t>(read_number(from)) : 0);
    for (std::int64_t i = 0; i < same; ++i, to += width * word_bytes) {
      last += difference;
      std::memcpy(to, &last, word_bytes);
    }
    row += same;
  }
  return from;
}

/// The parts of columns that are packed by themselves, column after column.
struct ColumnParts {
  std::int64_t rows;
  int width;

  /// Limits a part: to few enough for all threads to have some, to many beside what each costs.
  std::int64_t most_rows() const { return std::clamp<std::int64_t>(rows / 32, 1 << 12, 1 << 17); }

  std::int64_t of_column() const { return (rows - 1) / most_rows() + 1; }
  std::int64_t count() const { return width * of_column(); }
  std::int64_t first_row(std::int64_t part) const { return part % of_column() * most_rows(); }
  std::int64_t rows_of(std::int64_t part) const { return std::min(rows - first_row(part), most_rows()); }

  /// Where its first word is among all, in bytes.
  std::int64_t begin(std::int64_t part) const { return (first_row(part) * width + part / of_column()) * word_bytes; }
};

/// Calls body(i) for i in 0..n-1, on all threads if that is worth it.
template <class Body>
void for_each_piece(bool are_many, std::int64_t n, const Body& body) {
  in_turns(are_many ? host_threads() : 1, n, [&](int, std::int64_t i) { body(i); });
}

}  // namespace

PackedPieces pack_rows(const void* words, std::int64_t rows, int width) {
  if (rows == 0) return {};
  const ColumnParts parts{rows, width};
  const char* const first = static_cast<const char*>(words);
  PackedPieces pieces(1 + parts.count());
  for_each_piece(are_many_to_pack(rows), parts.count(), [&](std::int64_t part) {
    pieces[1 + part] = pack_column(first + parts.begin(part), parts.rows_of(part), width);
  });
  add_number(rows, pieces[0]);
  if (!are_many_to_pack(rows)) return pieces;
  for (std::int64_t part = 0; part < parts.count(); ++part)
    add_number(static_cast<std::int64_t>(pieces[1 + part].size()), pieces[0]);
  return pieces;
}

std::int64_t bytes_of(const PackedPieces& pieces) {
  std::int64_t bytes = 0;
  for (const std::vector<char>& piece : pieces) bytes += static_cast<std::int64_t>(piece.size());
  return bytes;
}

void write_pieces(const PackedPieces& pieces, char* to) {
  constexpr std::int64_t many_bytes = 1 << 16;
  std::vector<char*> begin;
  for (const std::vector<char>& piece : pieces) {
    begin.push_back(to);
    to += piece.size();
  }
  for_each_piece(bytes_of(pieces) > many_bytes, static_cast<std::int64_t>(pieces.size()),
                 [&](std::int64_t i) { std::copy(pieces[i].begin(), pieces[i].end(), begin[i]); });
}

std::int64_t packed_rows(const char* bytes, std::int64_t count) {
  return count == 0 ? 0 : static_cast<std::int64_t>(read_number(bytes));
}

void unpack_rows(const char* bytes, std::int64_t count, int width, void* words) {
  if (count == 0) return;
  const ColumnParts parts{static_cast<std::int64_t>(read_number(bytes)), width};
  char* const first = static_cast<char*>(words);
  const auto unpack = [&](std::int64_t part, const char* from) {
    return unpack_column(from, parts.rows_of(part), width, first + parts.begin(part));
  };
  if (!are_many_to_pack(parts.rows)) {
    for (std::int64_t part = 0; part < parts.count(); ++part) bytes = unpack(part, bytes);
    return;
  }
  std::vector<std::int64_t> begin(1, 0);
  for (std::int64_t part = 0; part < parts.count(); ++part)
    begin.push_back(begin.back() + static_cast<std::int64_t>(read_number(bytes)));
  for_each_piece(true, parts.count(), [&](std::int64_t part) { unpack(part, bytes + begin[part]); });
}

/// The lists follow the lengths of all but the last.
PackedPieces pack_lists(const std::vector<WordRows>& lists) {
  if (std::all_of(lists.begin(), lists.end(), [](const WordRows& list) { return list.rows == 0; })) return {};
  PackedPieces all(1);
  for (const WordRows& list : lists) {
    PackedPieces pieces = pack_rows(list.words, list.rows, list.width);
    if (&list != &lists.back()) add_number(bytes_of(pieces), all[0]);
    std::move(pieces.begin(), pieces.end(), std::back_inserter(all));
  }
  return all;
}

std::vector<PackedList> lists_in(const char* bytes, std::int64_t count, int lists) {
  std::vector<PackedList> all(lists, {bytes, 0});
  if (count == 0) return all;
  const char* at = bytes;
  for (int i = 0; i + 1 < lists; ++i) all[i].count = static_cast<std::int64_t>(read_number(at));
  for (int i = 0; i + 1 < lists; ++i) {
    all[i].bytes = at;
    at += all[i].count;
  }
  all.back() = {at, bytes + count - at};
  return all;
}

}  // namespace gale::detail
