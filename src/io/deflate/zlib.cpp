#include <new>

#include <gale/io/bytes/compression.hpp>
#include <gale/io/libraries/headers.hpp>

// Stands for libdeflate.cpp, where that library isn't there and zlib is.
namespace gale::io::detail {

bool can_compress() { return true; }

void compress_by_zlib(std::size_t value_bytes, const char* bytes, std::size_t size, std::vector<char>& compressed) {
  if (value_bytes >= 4) {
    const auto sum = ::adler32(1, reinterpret_cast<const Bytef*>(bytes), static_cast<uInt>(size));
    return compress_words(bytes, size, static_cast<std::uint32_t>(sum), compressed);
  }
  constexpr int fastest = 1;  // the usual 6 takes several times as long for a few percent less
  uLongf needed = compressBound(static_cast<uLong>(size));
  compressed.resize(needed);
  if (compress2(reinterpret_cast<Bytef*>(compressed.data()), &needed, reinterpret_cast<const Bytef*>(bytes),
                static_cast<uLong>(size), fastest) != Z_OK)
    throw std::bad_alloc();
  compressed.resize(needed);
}

bool uncompress_zlib(const char* compressed, std::size_t compressed_bytes, char* to, std::size_t bytes) {
  auto written = static_cast<uLongf>(bytes);
  const int status = ::uncompress(reinterpret_cast<Bytef*>(to), &written, reinterpret_cast<const Bytef*>(compressed),
                                  static_cast<uLong>(compressed_bytes));
  return status == Z_OK && written == bytes;
}

bool inflate_at_once(const InputFile&, std::uint64_t, std::uint64_t, const std::function<char*()>&) { return false; }

}  // namespace gale::io::detail
