#pragma once

#include <cstdint>
#include <vector>

#include <gale/export.hpp>

// Rows of words in few bytes, for messages: ids that ascend, places that follow one another, answers that repeat.

namespace gale::detail {

/// What lies in a message one after the other.
using PackedPieces = std::vector<std::vector<char>>;

/// Packs `rows` rows of `width` 32-bit words each, which may be parts of larger numbers. Each column by itself is
/// written as differences from row to row, modulo 2^32, the first from 0: a difference and how many more rows have the
/// same, as numbers of 7 bits a byte. Ids one after the other, or all the same, take a few bytes; random words 1.25
/// times what they took. Many rows are packed by all threads: each column by itself, in up to 32 parts or more, each of
/// which takes these few bytes.
GALE_EXPORT PackedPieces pack_rows(const void* words, std::int64_t rows, int width);

/// Whether that many rows keep several threads busy.
constexpr bool are_many_to_pack(std::int64_t rows) { return rows > 1 << 13; }

/// How many bytes the pieces have together, and these one after the other, written by all threads.
GALE_EXPORT std::int64_t bytes_of(const PackedPieces& pieces);
GALE_EXPORT void write_pieces(const PackedPieces& pieces, char* to);

/// How many rows were packed into these bytes, which may be none.
GALE_EXPORT std::int64_t packed_rows(const char* bytes, std::int64_t count);

/// Unpacks all rows of what pack_rows has made of rows as wide, by all threads where they are many.
GALE_EXPORT void unpack_rows(const char* bytes, std::int64_t count, int width, void* words);

/// Rows that are packed together with others, or unpacked.
struct WordRows {
  void* words;
  std::int64_t rows;
  int width;
};

/// Packs several lists into one message, one or more; nothing if all are empty.
GALE_EXPORT PackedPieces pack_lists(const std::vector<WordRows>& lists);

/// Where pack_rows has packed one list.
struct PackedList {
  const char* bytes;
  std::int64_t count;

  std::int64_t rows() const { return packed_rows(bytes, count); }
};

/// Finds so many lists in what pack_lists has made of them.
GALE_EXPORT std::vector<PackedList> lists_in(const char* bytes, std::int64_t count, int lists);

}  // namespace gale::detail
