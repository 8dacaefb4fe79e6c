#pragma once

#include <string>
#include <vector>

#include <gale/io/atomic_file.hpp>
#include <gale/io/write.hpp>

/// Each writes to a file that is there, or to the temporary one of another, whatever its name. What is written is
/// consistent: io::write_mesh and the others see to that. They throw gale::Error without the path.
namespace gale::io::detail {

void write_vtp(const AtomicFile& file, const PointSet& points);
void write_vtp(const AtomicFile& file, const Surface& surface);

void write_vtu(const AtomicFile& file, const Dataset& mesh, const std::vector<PointArray>& more,
               const std::vector<PointArray>& cell_arrays = {});

/// Names files; `like` has the types of what each of them has.
void write_pvtp(const std::string& path, const std::vector<std::string>& pieces, const PointSet& like);
void write_pvtp(const std::string& path, const std::vector<std::string>& pieces, const Surface& like);
void write_pvtu(const std::string& path, const std::vector<std::string>& pieces, const MeshPiece& like);

/// The lines, without polygons.
void write_vtu(const AtomicFile& file, const Surface& lines);

/// Binary, of the version 5.1.
void write_legacy_vtk(const std::string& path, const Dataset& mesh, const std::vector<PointArray>& more);

}  // namespace gale::io::detail
