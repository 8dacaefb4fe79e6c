#include <gale/base/error.hpp>
#include <gale/io/bytes/zlib.hpp>
#include <gale/io/formats/readers.hpp>

namespace gale::io::detail {
namespace {

[[noreturn]] void refuse() { throw Error("this gale was built without VTK"); }

}  // namespace

bool has_vtk() { return false; }

Content read_content(const InputFile&, Format, const ReadOptions&) { refuse(); }

PieceNames names_of_pieces(const InputFile&) { refuse(); }

SomePieces read_some_pieces(const InputFile&, const PieceNames&, const ReadOptions&) { refuse(); }

bool has_zlib() { return false; }

void compress_by_zlib(const char*, std::size_t, std::vector<char>&) { refuse(); }

}  // namespace gale::io::detail
