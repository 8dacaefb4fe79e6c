#include <new>

#include <vtk_zlib.h>

#include <gale/io/bytes/zlib.hpp>

namespace gale::io::detail {

bool has_zlib() { return true; }

void compress_by_zlib(const char* bytes, std::size_t size, std::vector<char>& compressed) {
  constexpr int fastest = 1;  // the usual 6 takes several times as long for a few percent less
  uLongf needed = compressBound(static_cast<uLong>(size));
  compressed.resize(needed);
  if (compress2(reinterpret_cast<Bytef*>(compressed.data()), &needed, reinterpret_cast<const Bytef*>(bytes),
                static_cast<uLong>(size), fastest) != Z_OK)
    throw std::bad_alloc();
  compressed.resize(needed);
}

}  // namespace gale::io::detail
