#include <gale/io/bytes/compression.hpp>
#include <gale/io/libraries/headers.hpp>

// Stands for libdeflate.cpp, where that library isn't there and zlib is.
namespace gale::io::detail {

bool can_compress() { return true; }

void compress_by_zlib(Pattern, const char* bytes, std::size_t size, std::vector<char>& compressed) {
  compress_at_level_1(bytes, size, compressed);
}

bool uncompress_zlib(const char* compressed, std::size_t compressed_bytes, char* to, std::size_t bytes) {
  auto written = static_cast<uLongf>(bytes);
  const int status = ::uncompress(reinterpret_cast<Bytef*>(to), &written, reinterpret_cast<const Bytef*>(compressed),
                                  static_cast<uLong>(compressed_bytes));
  return status == Z_OK && written == bytes;
}

bool inflate_at_once(ByteSource&, char*, std::size_t) { return false; }

}  // namespace gale::io::detail
