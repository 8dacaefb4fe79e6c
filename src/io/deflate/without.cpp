#include <gale/base/error.hpp>
#include <gale/io/bytes/compression.hpp>

// Stands for libdeflate.cpp and zlib.cpp, where GALE is built without these libraries.
namespace gale::io::detail {

bool can_compress() { return false; }

void compress_by_zlib(std::size_t, const char*, std::size_t, std::vector<char>&) {
  throw Error("this gale was built without libdeflate and VTK");
}

bool inflate_at_once(const InputFile&, std::uint64_t, std::uint64_t, const std::function<char*()>&) { return false; }

}  // namespace gale::io::detail
