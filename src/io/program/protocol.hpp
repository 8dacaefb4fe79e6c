#pragma once

#include <cstdint>

/// Requests of GALE to gale-hdf5-reader, and its answers, in the machine's bytes.
///
/// A request is its length, 32 bits, its RequestKind, and texts that end by a zero each; GALE sends it when the answer
/// to the one before has come. A text of an answer is its length, 32 bits, and its characters.
/// - group PATH: a byte, 1 if there is such a group; the number of its datasets, 64 bits; of each its name, a
///   DatasetHeader, 64 bits for each dimension and, if it is chunked, for each of a chunk; 32 bits for each filter.
/// - attribute PATH NAME: an AttributeKind; for text a text, for numbers their number, 32 bits, and doubles.
/// - bytes PATH: those of a compact dataset, as many as its DatasetHeader says.
/// - chunks PATH FIRST END: how many bytes all chunks of the dataset have, 64 bits; of each chunk that has some of the
///   rows from FIRST up to END, two numbers, the last dimension running fastest: a Chunk and its bytes.
/// Where something is wrong, it writes a line to its standard error, and ends.
namespace gale::reader {

enum class RequestKind : std::uint8_t { group, attribute, bytes, chunks };

enum class Layout : std::uint8_t { contiguous, compact, chunked };

enum class AttributeKind : std::uint8_t { none, text, numbers };

inline constexpr std::uint8_t no_type = 255;

struct DatasetHeader {
  std::uint64_t address = 0;    ///< in the file, if it is contiguous; all ones if there are no bytes
  std::uint64_t stored = 0;     ///< bytes, unless it is chunked
  std::uint8_t type = no_type;  ///< a number of gale::io::detail::ValueType
  std::uint8_t is_text = 0, is_big_endian = 0;
  Layout layout = Layout::contiguous;
  std::uint16_t dimensions = 0, filters = 0;
};

struct Chunk {
  std::uint64_t bytes = 0;
  std::uint64_t left_out = 0;  ///< bit k: filter k was not applied
};

inline constexpr std::uint64_t no_address = ~std::uint64_t(0);
inline constexpr unsigned most_dimensions = 32, most_filters = 32;

/// Filters by HDF5's numbers.
inline constexpr std::uint32_t deflate = 1, shuffle = 2, fletcher32 = 3;

/// Goes on to the next chunk below `ends`, the last dimension first; false at the end.
template <class Places, class Lengths>
bool advance(Places& at, const Lengths& chunk, const Lengths& ends) {
  for (auto d = at.size(); d-- > 0; at[d] = 0) {
    if (ends[d] - at[d] <= chunk[d]) continue;
    at[d] += chunk[d];
    return true;
  }
  return false;
}

}  // namespace gale::reader
