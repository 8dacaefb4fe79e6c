#include <gale/base/error.hpp>
#include <gale/io/bytes/compression.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/xml_file.hpp>

// Stands for vtk/vtk_*.cpp, where GALE is built without VTK. io::read() refuses files before any of these is called.
namespace gale::io::detail {
namespace {

[[noreturn]] void refuse_without_vtk() { throw Error("this gale was built without VTK"); }

}  // namespace

bool has_vtk() { return false; }

void compress_by_vtk(const char*, std::size_t, std::vector<char>&) { refuse_without_vtk(); }

std::unique_ptr<ByteSource> inflated(const InputFile&, std::uint64_t, std::uint64_t) { refuse_without_vtk(); }

Uncompress find_uncompress(const std::string&) { refuse_without_vtk(); }

void read_tree(XmlFile&, const std::string&) { refuse_without_vtk(); }

}  // namespace gale::io::detail
