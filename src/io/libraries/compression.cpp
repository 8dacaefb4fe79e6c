#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>

#include <gale/base/stop.hpp>
#include <gale/io/bytes/compression.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/libraries/headers.hpp>

namespace gale::io::detail {
namespace {

class InflatedBytes : public ByteSource {
 public:
  explicit InflatedBytes(std::unique_ptr<ByteSource> compressed) : compressed_(std::move(compressed)) {
    constexpr int of_gzip_or_zlib = 32 + MAX_WBITS;
    if (inflateInit2(&z_, of_gzip_or_zlib) != Z_OK) throw std::bad_alloc();
  }
  ~InflatedBytes() override { inflateEnd(&z_); }

  std::size_t read(char* to, std::size_t bytes) override {
    std::size_t got = 0;
    while (got < bytes) {
      gale::detail::stop_if_asked();
      if (!refill()) {
        if (!ended_) damaged("its compressed data ends too early");
        break;
      }
      if (ended_) {
        // Another member, or what somebody appended: that is left, as gzip does.
        if (z_.next_in[0] != 0x1f) break;
        inflateReset(&z_);
        ended_ = false;
      }
      const auto wanted = static_cast<uInt>(std::min<std::size_t>(bytes - got, 1u << 24));
      z_.next_out = reinterpret_cast<Bytef*>(to + got);
      z_.avail_out = wanted;
      const int status = inflate(&z_, Z_NO_FLUSH);
      got += wanted - z_.avail_out;
      if (status == Z_MEM_ERROR) throw std::bad_alloc();
      if (status == Z_STREAM_END) {
        ended_ = true;
      } else if (status != Z_OK && status != Z_BUF_ERROR) {
        damaged("its compressed data is wrong: ", z_.msg != nullptr ? z_.msg : "no gzip or zlib stream");
      }
    }
    return got;
  }

  std::uint64_t at_most() const override {
    constexpr std::uint64_t best_ratio = 1032;  // of deflate: 258 bytes for two bits
    constexpr std::uint64_t window = 1 << 16;   // and what is underway
    constexpr std::uint64_t any = std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t compressed = z_.avail_in + compressed_->at_most();
    return compressed > any / 2048 ? any : compressed * best_ratio + window;
  }

 private:
  bool refill() {
    if (z_.avail_in > 0) return true;
    z_.next_in = input_.data();
    z_.avail_in = static_cast<uInt>(compressed_->read(reinterpret_cast<char*>(input_.data()), input_.size()));
    return z_.avail_in > 0;
  }

  std::unique_ptr<ByteSource> compressed_;
  std::vector<Bytef> input_ = std::vector<Bytef>(1 << 18);
  z_stream z_ = {};
  bool ended_ = false;  ///< a member has, and no other one has begun
};

bool uncompress_lz4(const char* compressed, std::size_t compressed_bytes, char* to, std::size_t bytes) {
  constexpr std::size_t most_bytes = std::numeric_limits<int>::max();
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

bool reads_files() { return true; }

std::unique_ptr<ByteSource> inflated(const InputFile& file, std::uint64_t begin) {
  return std::make_unique<InflatedBytes>(std::make_unique<FileBytes>(file, begin));
}

Uncompress find_uncompress(const std::string& compressor) {
  if (compressor == "vtkZLibDataCompressor") return uncompress_zlib;
  if (compressor == "vtkLZ4DataCompressor") return uncompress_lz4;
  if (compressor == "vtkLZMADataCompressor") return uncompress_lzma;
  damaged("its compressor is '", compressor, "'");
}

}  // namespace gale::io::detail
