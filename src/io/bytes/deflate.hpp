#pragma once

#include <cstddef>
#include <vector>

namespace gale::io::detail {

/// Whether there is a zlib. It comes with VTK.
bool can_deflate();

/// `compressed` becomes the zlib stream of `size` bytes.
void deflate(const char* bytes, std::size_t size, std::vector<char>& compressed);

}  // namespace gale::io::detail
