#pragma once

#include <string>

#include <gale/io/write.hpp>

namespace gale::io {

/// Writes the lines of `lines`, without its polygons, to a `.vtu`: for what others give as an unstructured grid of
/// lines, such as persistence diagrams. Whole or not at all; throws `Error` as `write_surface` does.
void write_lines(const std::string& path, const Surface& lines);

}  // namespace gale::io
