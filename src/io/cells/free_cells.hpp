#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gale::io::detail {

/// Cells of dimension 3 whose number of points is free: convex sets of points, and polyhedra, which are split as such.
bool is_free_cell(int type);

/// Throws gale::Error for fewer than 4 points, or for more than are split in a time that somebody waits for.
void require_splittable(std::size_t cell, int type, std::size_t points);

/// The distinct points of a polyhedron that is given by its faces, as legacy files do: how many faces there are, then
/// for each how many points and which. Throws gale::Error if the stream isn't exactly that.
std::vector<std::int64_t> points_of_faces(std::size_t cell, const std::vector<std::int64_t>& stream);

}  // namespace gale::io::detail
