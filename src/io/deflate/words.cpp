#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>

#include <gale/io/bytes/compression.hpp>
#include <gale/io/deflate/prefix_code.hpp>

// Deflate for arrays of numbers, several times as fast as a search for any bytes. Looks for a word of four bytes where
// it was last, by a hash, and else at the four words before for one with the same upper three bytes, as ids that ascend
// have: a byte and three that are found again take nine bits.
namespace gale::io::detail {
namespace {

constexpr unsigned end_symbol = 256, length_symbols = 286, distance_symbols = 30;
constexpr std::size_t word_bytes = 4, farthest = 1 << 15, longest = 256;  // as many words as a match may have
constexpr unsigned near = 256;                                            // distances whose codes are kept
constexpr unsigned most_bits_of_distance = 15 + 13;

/// Bytes as they are, then so many that came that far before.
struct Sequence {
  std::uint32_t literals;
  std::uint16_t length, distance;
};

/// The symbol of a number and the bits behind it, as deflate has them: `exact` symbols of a number each, then groups of
/// as many, in which numbers have one more bit than in the last.
struct Symbol {
  unsigned symbol, bits, rest;

  template <unsigned Exact>
  static Symbol of(unsigned number) {
    if (number < 2 * Exact) return {number, 0, 0};
    const unsigned more = 31 - static_cast<unsigned>(__builtin_clz(number / Exact));
    return {Exact * more + (number >> more), more, number & ((1u << more) - 1)};
  }
};

Symbol symbol_of_distance(unsigned distance) { return Symbol::of<2>(distance - 1); }

Symbol symbol_of_length(unsigned length) {
  Symbol found = Symbol::of<4>(length - 3);
  found.symbol += end_symbol + 1;
  return found;
}

std::uint32_t word_at(const char* bytes) {
  std::uint32_t word;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

/// How many bytes of whole words are alike, of at most so many.
std::size_t alike(const char* one, const char* other, std::size_t most) {
  std::size_t size = 0;
  while (size + word_bytes <= most && word_at(one + size) == word_at(other + size)) size += word_bytes;
  return size;
}

/// Finds what a block is made of.
class SequenceFinder {
 public:
  SequenceFinder(const char* bytes, std::size_t size)
      : bytes_(bytes), size_(size), sequences_(new Sequence[size / word_bytes]), end_(sequences_.get()) {
    const std::size_t first = std::min(size, 4 * word_bytes);
    add_literals(0, first);
    std::size_t at = first;
    while (at + word_bytes <= size) at += add_at(at);
    add_literals(at, size - at);
    ++lengths.count[end_symbol];
    for (const auto& of_byte : of_byte_)
      std::transform(of_byte.begin(), of_byte.end(), lengths.count.begin(), lengths.count.begin(), std::plus<>());
    for (unsigned length = 3; length <= longest; ++length) count(lengths, symbol_of_length(length), of_length_[length]);
  }

  const Sequence* begin() const { return sequences_.get(); }
  const Sequence* end() const { return end_; }

  std::uint32_t literals = 0;          ///< that come last
  std::size_t bits_behind = 0;         ///< that symbols have behind them
  PrefixCode<length_symbols> lengths;  ///< and bytes
  PrefixCode<distance_symbols> distances;

 private:
  /// Adds what begins there, and says how many bytes that are.
  std::size_t add_at(std::size_t at) {
    const std::uint32_t word = word_at(bytes_ + at);
    Last& last = last_[word * 0x9e3779b1u >> (32 - 12)];
    const std::size_t before = last.at, most = std::min(longest, size_ - at) - word_bytes;
    const bool is_same = last.word == word;
    last = {word, static_cast<std::uint32_t>(at)};
    if (is_same && at - before <= farthest) {
      const std::size_t length = word_bytes + alike(bytes_ + at + word_bytes, bytes_ + before + word_bytes, most);
      add_match(length, at - before);
      return length;
    }
    for (std::size_t distance = word_bytes; distance <= 4 * word_bytes; distance += word_bytes) {
      if ((word_at(bytes_ + at - distance) ^ word) & upper_) continue;
      const char* const next = bytes_ + at + word_bytes;
      const std::size_t length = word_bytes - 1 + alike(next, next - distance, most);
      add_literals(at, 1);
      add_match(length, distance);
      return 1 + length;
    }
    add_literals(at, word_bytes);
    return word_bytes;
  }

  void add_literals(std::size_t at, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) ++of_byte_[k % word_bytes][static_cast<unsigned char>(bytes_[at + k])];
    literals += static_cast<std::uint32_t>(count);
  }

  void add_match(std::size_t length, std::size_t distance) {
    ++of_length_[length];
    count(distances, symbol_of_distance(static_cast<unsigned>(distance)), 1);
    *end_++ = {literals, static_cast<std::uint16_t>(length), static_cast<std::uint16_t>(distance)};
    literals = 0;
  }

  template <unsigned Symbols>
  void count(PrefixCode<Symbols>& code, const Symbol& symbol, std::uint32_t times) {
    code.count[symbol.symbol] += times;
    bits_behind += std::size_t(times) * symbol.bits;
  }

  /// The word of a hash that came last, and where.
  struct Last {
    std::uint32_t word = 0, at = ~std::uint32_t(0) / 2;  // farther than any
  };

  const char* const bytes_;
  const std::size_t size_;
  const std::uint32_t upper_ = ~word_at("\xff\0\0\0");  ///< all of a word but its first byte
  std::array<Last, 1 << 12> last_;
  const std::unique_ptr<Sequence[]> sequences_;  // room for one a word, which each has at least
  Sequence* end_;
  /// Counts of literals by byte, in four tables in turn: adding to one twice in a row waits for the first sum.
  std::array<std::array<std::uint32_t, 256>, word_bytes> of_byte_ = {};
  std::array<std::uint32_t, longest + 1> of_length_ = {};  ///< how many matches have it
};

/// Writes the lengths of both codes, each by itself in four bits.
void put_codes(BitWriter& to, const SequenceFinder& found) {
  constexpr unsigned last_block = 1, own_codes = 2, of_sixteen = 19;
  to.put(
      last_block | own_codes << 1 | (length_symbols - 257) << 3 | (distance_symbols - 1) << 8 | (of_sixteen - 4) << 13,
      17);
  for (unsigned k = 0; k < of_sixteen; ++k) {
    to.flush();
    to.put(k < 3 ? 0 : 4, 3);  // the first three say that lengths are repeated
  }
  const auto put_bits = [&](const auto& bits) {
    for (const unsigned n : bits) {
      to.flush();
      to.put((n & 1) << 3 | (n & 2) << 1 | (n & 4) >> 1 | n >> 3, 4);
    }
  };
  put_bits(found.lengths.bits);
  put_bits(found.distances.bits);
  to.flush();
}

/// Writes the bytes' sequences, and where they end.
char* put_sequences(BitWriter& to, const SequenceFinder& found, const char* bytes) {
  struct Bits {
    std::uint32_t code, bits;
  };
  Bits literals[256], lengths[longest + 1], distances[near + 1];
  for (unsigned byte = 0; byte < 256; ++byte) literals[byte] = {found.lengths.code[byte], found.lengths.bits[byte]};
  for (unsigned length = 3; length <= longest; ++length) {
    const Symbol symbol = symbol_of_length(length);
    const unsigned bits = found.lengths.bits[symbol.symbol];
    lengths[length] = {found.lengths.code[symbol.symbol] | symbol.rest << bits, bits + symbol.bits};
  }
  const auto bits_of_distance = [&](unsigned distance) {
    const Symbol symbol = symbol_of_distance(distance);
    const unsigned bits = found.distances.bits[symbol.symbol];
    return Bits{found.distances.code[symbol.symbol] | symbol.rest << bits, bits + symbol.bits};
  };
  for (unsigned distance = 1; distance <= near; ++distance) distances[distance] = bits_of_distance(distance);
  const auto put = [&](const Bits& some) { to.put(some.code, some.bits); };
  const auto put_literals = [&](std::uint32_t count) {
    for (; count > 1; count -= 2, bytes += 2) {
      put(literals[static_cast<unsigned char>(bytes[0])]);
      put(literals[static_cast<unsigned char>(bytes[1])]);
      to.flush();
    }
    if (count > 0) put(literals[static_cast<unsigned char>(*bytes++)]);
  };
  for (const Sequence& sequence : found) {
    put_literals(sequence.literals);
    put(lengths[sequence.length]);
    to.make_room(most_bits_of_distance);
    put(sequence.distance <= near ? distances[sequence.distance] : bits_of_distance(sequence.distance));
    to.flush();
    bytes += sequence.length;
  }
  put_literals(found.literals);
  to.put(found.lengths, end_symbol);
  return to.end();
}

}  // namespace

void compress_words(const char* bytes, std::size_t size, std::uint32_t checksum, std::vector<char>& compressed) {
  SequenceFinder found(bytes, size);
  found.lengths.find();
  found.distances.find();
  const std::size_t bits = found.lengths.all_bits() + found.distances.all_bits() + found.bits_behind;
  constexpr std::size_t beside = 256;  // the codes, what frames the stream, and room to flush
  compressed.resize(bits / 8 + beside);
  char* to = compressed.data();
  *to++ = 0x78;  // deflate with a window of 32 KiB
  *to++ = 0x01;
  BitWriter stream(to);
  put_codes(stream, found);
  to = put_sequences(stream, found, bytes);
  for (int shift = 24; shift >= 0; shift -= 8) *to++ = static_cast<char>(checksum >> shift);
  compressed.resize(static_cast<std::size_t>(to - compressed.data()));
}

}  // namespace gale::io::detail
