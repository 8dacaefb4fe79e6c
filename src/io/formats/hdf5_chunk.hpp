#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gale::io::detail {

/// No stream of zlib's stands for more than that many times its bytes.
inline constexpr std::uint64_t best_deflate_ratio = 1032;

/// Throws gale::Error unless these are filters that are undone here: deflate, once, shuffle and fletcher32.
void require_known_filters(const std::vector<std::uint32_t>& filters, const std::string& array);

/// Undoes the filters of a chunk, all but those whose bit in `left_out` is set: `stored` becomes `bytes` bytes, of
/// values of `value_bytes` each. Throws gale::Error if it can't.
std::vector<char> decoded_chunk(std::vector<char> stored, const std::vector<std::uint32_t>& filters,
                                std::uint64_t left_out, std::uint64_t bytes, std::size_t value_bytes,
                                const std::string& array);

}  // namespace gale::io::detail
