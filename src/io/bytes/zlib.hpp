#pragma once

#include <cstddef>
#include <vector>

namespace gale::io::detail {

/// Whether there is a zlib. It comes with VTK.
bool has_zlib();

/// `compressed` becomes the zlib stream of `size` bytes. (Some zlibs have macros for the names of their functions.)
void compress_by_zlib(const char* bytes, std::size_t size, std::vector<char>& compressed);

}  // namespace gale::io::detail
