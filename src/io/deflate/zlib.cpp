#include <vtk_zlib.h>

#include <gale/io/bytes/compression.hpp>

// Stands for libdeflate.cpp, where that library isn't there and VTK is.
namespace gale::io::detail {

bool can_compress() { return true; }

void compress_by_zlib(Pattern, const char* bytes, std::size_t size, std::vector<char>& compressed) {
  compress_by_vtk(bytes, size, compressed);
}

bool uncompress_zlib(const char* compressed, std::size_t compressed_bytes, char* to, std::size_t bytes) {
  auto written = static_cast<uLongf>(bytes);
  const int status = ::uncompress(reinterpret_cast<Bytef*>(to), &written, reinterpret_cast<const Bytef*>(compressed),
                                  static_cast<uLong>(compressed_bytes));
  return status == Z_OK && written == bytes;
}

bool inflate_at_once(ByteSource&, char*, std::size_t) { return false; }

}  // namespace gale::io::detail
