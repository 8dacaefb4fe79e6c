#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gale/io/bytes/input_file.hpp>

/// The libraries of compression. What is zlib's is in deflate/: by libdeflate, else by zlib itself, in libraries/ as
/// the others are: libraries/compression.cpp, or without these libraries libraries/without.cpp. (Some zlibs have macros
/// for the names of their functions.)
namespace gale::io::detail {

/// Whether there is one of these for zlib's streams.
bool can_compress();

/// `compressed` becomes the zlib stream of `size` bytes, which are values of so many bytes each: by compress_words
/// those of four and eight, else by the library.
void compress_by_zlib(std::size_t value_bytes, const char* bytes, std::size_t size, std::vector<char>& compressed);

/// `compressed` becomes the zlib stream of `size` bytes (below 2^31), numbers of four or eight bytes, whose checksum
/// (Adler-32) a library makes: in half of libdeflate's time, to much the same size.
void compress_words(const char* bytes, std::size_t size, std::uint32_t checksum, std::vector<char>& compressed);

/// The content of a file's bytes from `begin` on, compressed by gzip or zlib, whichever it is; gzip's members may
/// follow each other. Reading throws gale::Error for bytes that are neither, or damaged.
std::unique_ptr<ByteSource> inflated(const InputFile& file, std::uint64_t begin);

/// Uncompresses that content at once to where room() says, which another thread may be asked for while this one reads.
/// False if it isn't `bytes`, is damaged, or without libdeflate; before room() is asked if these are too many to stop,
/// or so many that a small file which claims them takes memory that it can't fill.
bool inflate_at_once(const InputFile& file, std::uint64_t begin, std::uint64_t bytes,
                     const std::function<char*()>& room);

/// Writes the `bytes` that `compressed` stands for to `to`. False if it doesn't stand for so many.
using Uncompress = bool (*)(const char* compressed, std::size_t compressed_bytes, char* to, std::size_t bytes);

/// Uncompresses a stream of zlib's.
bool uncompress_zlib(const char* compressed, std::size_t compressed_bytes, char* to, std::size_t bytes);

/// The one of `compressor`, one of VTK's classes; throws gale::Error for another one.
Uncompress find_uncompress(const std::string& compressor);

}  // namespace gale::io::detail
