#include <cstring>
#include <utility>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/formats/hdf5_chunk.hpp>
#include <gale/io/formats/xml_file.hpp>
#include <gale/io/program/protocol.hpp>

namespace gale::io::detail {

namespace {

constexpr std::uint64_t sum_bytes = 4;  // of fletcher32, behind the values

[[noreturn]] void wrong(const std::string& array, const char* why) { damaged("a chunk of its '" + array + "' " + why); }

/// The first bytes of all values come first, then their second ones ...
void unshuffle(std::vector<char>& bytes, std::size_t value_bytes) {
  const std::size_t values = bytes.size() / value_bytes;
  if (value_bytes < 2 || values < 2) return;
  std::vector<char> in_order(bytes);  // what is left behind the last whole value stays where it is
  for (std::size_t k = 0; k < value_bytes; ++k) {
    for (std::size_t v = 0; v < values; ++v) in_order[v * value_bytes + k] = bytes[k * values + v];
  }
  bytes = std::move(in_order);
}

/// Fletcher's sum of big-endian words of 16 bits.
std::uint32_t fletcher_sum(const char* bytes, std::size_t count) {
  const auto* at = reinterpret_cast<const unsigned char*>(bytes);
  std::uint64_t low = 0, high = 0;
  const auto add = [&](std::uint32_t word) {
    low = (low + word) % 65535;
    high = (high + low) % 65535;
  };
  for (std::size_t k = 0; k + 1 < count; k += 2) add(std::uint32_t(at[k]) << 8 | at[k + 1]);
  if (count % 2 == 1) add(std::uint32_t(at[count - 1]) << 8);
  return static_cast<std::uint32_t>(high << 16 | low);
}

/// HDF5 folds sums into 1 to 65535; zeros alone give 0.
bool same_sum(std::uint32_t a, std::uint32_t b) {
  return (a & 0xffff) % 65535 == (b & 0xffff) % 65535 && (a >> 16) % 65535 == (b >> 16) % 65535;
}

void take_sum(std::vector<char>& bytes, const std::string& array) {
  if (bytes.size() < sum_bytes) wrong(array, "has no room for its sum");
  const std::size_t rest = bytes.size() - sum_bytes;
  std::uint32_t said = 0;
  for (std::size_t k = sum_bytes; k-- > 0;) said = said << 8 | static_cast<unsigned char>(bytes[rest + k]);
  bytes.resize(rest);
  if (!same_sum(said, fletcher_sum(bytes.data(), rest))) wrong(array, "has another sum");
}

}  // namespace

void require_known_filters(const std::vector<std::uint32_t>& filters, const std::string& array) {
  int deflates = 0;
  for (const std::uint32_t filter : filters) {
    deflates += filter == reader::deflate;
    const bool is_known = filter == reader::deflate || filter == reader::shuffle || filter == reader::fletcher32;
    if (is_known && deflates < 2) continue;
    throw Error("its '" + printable(array) + "' is packed by HDF5's filter " + std::to_string(filter) +
                ": deflate, once, shuffle and fletcher32 are read");
  }
}

std::vector<char> decoded_chunk(std::vector<char> stored, const std::vector<std::uint32_t>& filters,
                                std::uint64_t left_out, std::uint64_t bytes, std::size_t value_bytes,
                                const std::string& array) {
  const auto applied = [&](std::size_t k) { return (left_out >> k & 1) == 0; };
  for (std::size_t k = filters.size(); k-- > 0;) {
    if (!applied(k)) continue;
    if (filters[k] == reader::fletcher32) take_sum(stored, array);
    if (filters[k] == reader::shuffle) unshuffle(stored, value_bytes);
    if (filters[k] != reader::deflate) continue;
    std::uint64_t before = bytes;
    for (std::size_t j = 0; j < k; ++j) before += applied(j) && filters[j] == reader::fletcher32 ? sum_bytes : 0;
    if (before / best_deflate_ratio > stored.size()) wrong(array, "stands for less than it should");
    std::vector<char> inflated(static_cast<std::size_t>(before));
    static const Uncompress inflate = find_uncompress("vtkZLibDataCompressor");
    if (!inflate(stored.data(), stored.size(), inflated.data(), inflated.size()))
      wrong(array, "isn't what deflate makes");
    stored = std::move(inflated);
  }
  if (stored.size() != bytes) wrong(array, "has another size");
  return stored;
}

}  // namespace gale::io::detail
