#include <gale/base/error.hpp>
#include <gale/io/bytes/compression.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/xml_file.hpp>

// Stands for the others of this folder where GALE is built without these libraries. io::read() refuses files before
// any of these is called.
namespace gale::io::detail {
namespace {

[[noreturn]] void refuse_without() { throw Error("this gale was built without VTK"); }

}  // namespace

bool reads_files() { return false; }

std::unique_ptr<ByteSource> inflated(const InputFile&, std::uint64_t) { refuse_without(); }

Uncompress find_uncompress(const std::string&) { refuse_without(); }

void read_tree(XmlFile&, const std::string&) { refuse_without(); }

}  // namespace gale::io::detail
