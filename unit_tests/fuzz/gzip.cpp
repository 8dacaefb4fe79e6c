#include "fuzz/gzip.hpp"

#include <zlib.h>

namespace gale::fuzz {

namespace {

constexpr int with_gzip_header = 15 + 16;

z_stream stream_of(const std::string& content) {
  z_stream stream{};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  return stream;
}

/// The result of a step for all that is in a stream.
template <class Step>
std::string all_of(z_stream& stream, const Step& step) {
  std::string result;
  char piece[4096];
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(piece);
    stream.avail_out = sizeof piece;
    state = step(&stream, Z_FINISH);
    result.append(piece, sizeof piece - stream.avail_out);
    if (state == Z_BUF_ERROR && stream.avail_out == 0) state = Z_OK;
  }
  return result;
}

}  // namespace

std::string zipped(const std::string& content) {
  z_stream stream = stream_of(content);
  deflateInit2(&stream, 1, Z_DEFLATED, with_gzip_header, 8, Z_DEFAULT_STRATEGY);
  const std::string result = all_of(stream, deflate);
  deflateEnd(&stream);
  return result;
}

std::string unzipped(const std::string& content) {
  z_stream stream = stream_of(content);
  inflateInit2(&stream, with_gzip_header);
  const std::string result = all_of(stream, inflate);
  inflateEnd(&stream);
  return result;
}

}  // namespace gale::fuzz
