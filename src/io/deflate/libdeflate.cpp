#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <new>

#include <gale/base/threads.hpp>
#include <gale/io/bytes/compression.hpp>

namespace gale::io::detail {
namespace {

struct FreeCodec {
  void operator()(libdeflate_compressor* one) const { libdeflate_free_compressor(one); }
  void operator()(libdeflate_decompressor* one) const { libdeflate_free_decompressor(one); }
};

/// What `make` makes, kept by each thread for its next block.
template <class T, class Make>
T* kept(const Make& make) {
  thread_local std::unique_ptr<T, FreeCodec> one;
  if (!one) one.reset(make());
  if (!one) throw std::bad_alloc();
  return one.get();
}

libdeflate_decompressor* decompressor() { return kept<libdeflate_decompressor>(libdeflate_alloc_decompressor); }

}  // namespace

bool can_compress() { return true; }

void compress_by_zlib(std::size_t value_bytes, const char* bytes, std::size_t size, std::vector<char>& compressed) {
  if (value_bytes >= 4) return compress_words(bytes, size, libdeflate_adler32(1, bytes, size), compressed);
  libdeflate_compressor* const compressor = kept<libdeflate_compressor>([] { return libdeflate_alloc_compressor(2); });
  compressed.resize(libdeflate_zlib_compress_bound(compressor, size));
  compressed.resize(libdeflate_zlib_compress(compressor, bytes, size, compressed.data(), compressed.size()));
}

bool uncompress_zlib(const char* compressed, std::size_t compressed_bytes, char* to, std::size_t bytes) {
  return libdeflate_zlib_decompress(decompressor(), compressed, compressed_bytes, to, bytes, nullptr) ==
         LIBDEFLATE_SUCCESS;
}

bool inflate_at_once(const InputFile& file, std::uint64_t begin, std::uint64_t bytes,
                     const std::function<char*()>& room) {
  constexpr std::uint64_t most = 1 << 28;  // takes up to half a second, in which nobody can stop it
  FileBytes compressed(file, begin);
  const auto size = static_cast<std::size_t>(compressed.at_most());
  if (bytes > most || bytes > 8 * size + (1 << 25) || size / 2 > bytes + (1 << 16)) return false;
  const std::unique_ptr<char[]> from(new char[size]);
  char* to = nullptr;
  in_turns(std::min(2, host_threads()), 2, [&](int, std::int64_t part) {
    if (part == 0) {
      to = room();
    } else {
      read_all(compressed, from.get(), size, "its compressed data");
    }
  });
  constexpr char gzip = 0x1f;
  for (std::size_t at = 0; at < size && (at == 0 || from[at] == gzip);) {
    const auto decompress = from[at] == gzip ? libdeflate_gzip_decompress_ex : libdeflate_zlib_decompress_ex;
    std::size_t read = 0, written = 0;
    if (decompress(decompressor(), &from[at], size - at, to, bytes, &read, &written) != LIBDEFLATE_SUCCESS)
      return false;
    at += read;
    to += written;
    bytes -= written;
  }
  return bytes == 0;
}

}  // namespace gale::io::detail
