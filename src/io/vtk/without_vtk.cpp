#include <gale/base/error.hpp>
#include <gale/io/formats/readers.hpp>

namespace gale::io::detail {
namespace {

[[noreturn]] void refuse() { throw Error("this gale was built without VTK"); }

}  // namespace

bool has_vtk() { return false; }

Content read_content(const InputFile&, Format, const ReadOptions&) { refuse(); }

void write_points_with_vtk(const std::string&, const PointSet&) { refuse(); }

void write_surface_with_vtk(const std::string&, const Surface&) { refuse(); }

void write_lines_with_vtk(const std::string&, const Surface&) { refuse(); }

void write_mesh_with_vtk(const std::string&, Format, const Dataset&, const std::vector<PointArray>&) { refuse(); }

}  // namespace gale::io::detail
