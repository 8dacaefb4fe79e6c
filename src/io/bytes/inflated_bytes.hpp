#pragma once

#include <memory>

#include <gale/io/bytes/byte_source.hpp>

namespace gale::io::detail {

/// What is in compressed bytes, of gzip or zlib, whichever it is; gzip's members may follow each other. Throws
/// gale::Error for bytes that are neither, or damaged.
class InflatedBytes : public ByteSource {
 public:
  explicit InflatedBytes(std::unique_ptr<ByteSource> compressed);
  ~InflatedBytes() override;
  std::size_t read(char* to, std::size_t bytes) override;
  std::uint64_t at_most() const override;

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

/// Whether a file begins as gzip's do.
bool is_gzip(const InputFile& file);

/// What is in a file, inflated if it is of gzip. The file must outlive it.
std::unique_ptr<ByteSource> open_inflated(const InputFile& file);

}  // namespace gale::io::detail
