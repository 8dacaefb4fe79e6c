#include <algorithm>
#include <limits>
#include <vector>

#include <vtk_zlib.h>

#include <gale/base/error.hpp>
#include <gale/base/stop.hpp>
#include <gale/io/bytes/damaged.hpp>
#include <gale/io/bytes/inflated_bytes.hpp>

namespace gale::io::detail {

struct InflatedBytes::Stream {
  std::unique_ptr<ByteSource> compressed;
  std::vector<Bytef> input = std::vector<Bytef>(1 << 18);
  z_stream z = {};
  bool ended = false;  ///< a member has, and no other one has begun

  bool refill() {
    if (z.avail_in > 0) return true;
    z.next_in = input.data();
    z.avail_in = static_cast<uInt>(compressed->read(reinterpret_cast<char*>(input.data()), input.size()));
    return z.avail_in > 0;
  }
};

InflatedBytes::InflatedBytes(std::unique_ptr<ByteSource> compressed) : stream_(std::make_unique<Stream>()) {
  stream_->compressed = std::move(compressed);
  constexpr int of_gzip_or_zlib = 32 + MAX_WBITS;
  if (inflateInit2(&stream_->z, of_gzip_or_zlib) != Z_OK) throw std::bad_alloc();
}

InflatedBytes::~InflatedBytes() { inflateEnd(&stream_->z); }

std::size_t InflatedBytes::read(char* to, std::size_t bytes) {
  Stream& s = *stream_;
  std::size_t got = 0;
  while (got < bytes) {
    gale::detail::stop_if_asked();
    if (!s.refill()) {
      if (!s.ended) damaged("its compressed data ends too early");
      break;
    }
    if (s.ended) {
      // Another member, or what somebody appended: that is left, as gzip does.
      if (s.z.next_in[0] != 0x1f) break;
      inflateReset(&s.z);
      s.ended = false;
    }
    const auto wanted = static_cast<uInt>(std::min<std::size_t>(bytes - got, 1u << 24));
    s.z.next_out = reinterpret_cast<Bytef*>(to + got);
    s.z.avail_out = wanted;
    const int status = inflate(&s.z, Z_NO_FLUSH);
    got += wanted - s.z.avail_out;
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status == Z_STREAM_END) {
      s.ended = true;
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      damaged(std::string("its compressed data is wrong: ") + (s.z.msg ? s.z.msg : "no gzip or zlib stream"));
    }
  }
  return got;
}

std::uint64_t InflatedBytes::at_most() const {
  constexpr std::uint64_t best_ratio = 1032;  // of deflate: 258 bytes for two bits
  constexpr std::uint64_t window = 1 << 16;   // and what is underway
  const std::uint64_t compressed = stream_->z.avail_in + stream_->compressed->at_most();
  if (compressed > std::numeric_limits<std::uint64_t>::max() / 2048) return std::numeric_limits<std::uint64_t>::max();
  return compressed * best_ratio + window;
}

bool is_gzip(const InputFile& file) {
  char start[2] = {};
  if (file.size() < 2) return false;
  file.read(0, start, 2);
  return start[0] == '\x1f' && start[1] == '\x8b';
}

std::unique_ptr<ByteSource> open_inflated(const InputFile& file) {
  auto bytes = std::make_unique<FileBytes>(file, 0);
  if (!is_gzip(file)) return bytes;
  return std::make_unique<InflatedBytes>(std::move(bytes));
}

}  // namespace gale::io::detail
