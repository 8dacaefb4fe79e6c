#include <limits>

#include <vtk_lz4.h>
#include <vtk_lzma.h>
#include <vtk_zlib.h>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/formats/xml_file.hpp>

namespace gale::io::detail {

namespace {

constexpr std::size_t most_bytes = std::numeric_limits<int>::max();

bool uncompress_zlib(const char* compressed, std::size_t compressed_bytes, char* to, std::size_t bytes) {
  auto written = static_cast<uLongf>(bytes);
  const int status = ::uncompress(reinterpret_cast<Bytef*>(to), &written, reinterpret_cast<const Bytef*>(compressed),
                                  static_cast<uLong>(compressed_bytes));
  return status == Z_OK && written == bytes;
}

bool uncompress_lz4(const char* compressed, std::size_t compressed_bytes, char* to, std::size_t bytes) {
  if (compressed_bytes > most_bytes || bytes > most_bytes) return false;
  return LZ4_decompress_safe(compressed, to, static_cast<int>(compressed_bytes), static_cast<int>(bytes)) ==
         static_cast<int>(bytes);
}

bool uncompress_lzma(const char* compressed, std::size_t compressed_bytes, char* to, std::size_t bytes) {
  std::uint64_t memory = std::uint64_t(128) << 20;  // a dictionary takes no more: the file says how large it is
  std::size_t read = 0, written = 0;
  return lzma_stream_buffer_decode(&memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(compressed), &read,
                                   compressed_bytes, reinterpret_cast<std::uint8_t*>(to), &written, bytes) == LZMA_OK &&
         written == bytes;
}

}  // namespace

Uncompress find_uncompress(const std::string& compressor) {
  if (compressor == "vtkZLibDataCompressor") return uncompress_zlib;
  if (compressor == "vtkLZ4DataCompressor") return uncompress_lz4;
  if (compressor == "vtkLZMADataCompressor") return uncompress_lzma;
  damaged("its compressor is '" + compressor + "'");
}

}  // namespace gale::io::detail
