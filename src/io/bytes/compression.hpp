#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <gale/io/bytes/input_file.hpp>

/// The libraries of compression, which come with VTK: vtk/vtk_compression.cpp, or without it vtk/without_vtk.cpp. (Some
/// zlibs have macros for the names of their functions.)
namespace gale::io::detail {

/// `compressed` becomes the zlib stream of `size` bytes.
void compress_by_zlib(const char* bytes, std::size_t size, std::vector<char>& compressed);

/// The content of compressed bytes, of gzip or zlib, whichever it is; gzip's members may follow each other. Reading
/// throws gale::Error for bytes that are neither, or damaged.
std::unique_ptr<ByteSource> inflated(std::unique_ptr<ByteSource> compressed);

/// Writes the `bytes` that `compressed` stands for to `to`. False if it doesn't stand for so many.
using Uncompress = bool (*)(const char* compressed, std::size_t compressed_bytes, char* to, std::size_t bytes);

/// The one of `compressor`, one of VTK's classes; throws gale::Error for another one.
Uncompress find_uncompress(const std::string& compressor);

}  // namespace gale::io::detail
