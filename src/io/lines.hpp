#pragma once

#include <gale/export.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/write.hpp>

namespace gale::io {

/// Writes the lines of `lines`, without its polygons, to the temporary file of a `.vtu`: for what others give as an
/// unstructured grid of lines, such as persistence diagrams. Throws `Error` as `write_surface` does.
GALE_EXPORT void write_lines(const AtomicFile& file, const Surface& lines);

}  // namespace gale::io
