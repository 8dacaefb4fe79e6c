#pragma once

#include <string>

/// Writes files of an image or a mesh to a folder, each wrong in the way that its name says: what they have isn't in
/// them, or there is far more of it than they hold.
void write_strange_files(const std::string& folder);

/// Writes VTKHDF meshes, and Exodus files as NetCDF-4 has them, to a folder, `count` of each: their datasets are left
/// out, misnamed, of other types, shapes and layouts, empty, huge, without values, and hold what they shouldn't, at
/// random.
void write_random_files(const std::string& folder, int count);
