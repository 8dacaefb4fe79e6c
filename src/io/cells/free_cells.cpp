#include <algorithm>
#include <string>

#include <gale/io/bytes/damaged.hpp>
#include <gale/io/cells/cell_types.hpp>
#include <gale/io/cells/free_cells.hpp>

namespace gale::io::detail {

bool is_free_cell(int type) { return type == polyhedron_type || type == convex_point_set_type; }

void require_splittable(std::size_t cell, int type, std::size_t points) {
  constexpr std::size_t most = 1000;
  const std::string the_cell = std::string("the ") + find_cell_type(type)->name + " in cell " + std::to_string(cell);
  if (points < 4) damaged(the_cell + " has " + std::to_string(points) + " points");
  if (points > most)
    throw Error(the_cell + " has " + std::to_string(points) + " points, more than the " + std::to_string(most) +
                " of a cell that is split");
}

std::vector<std::int64_t> points_of_faces(std::size_t cell, const std::vector<std::int64_t>& stream) {
  std::vector<std::int64_t> points;
  std::size_t at = 0;
  const auto next = [&](const char* what, std::size_t most) {
    if (at == stream.size()) damaged("the faces of cell " + std::to_string(cell) + " end too early");
    const std::int64_t count = stream[at++];
    if (count < 0 || static_cast<std::uint64_t>(count) > most)
      damaged("cell " + std::to_string(cell) + " has " + std::to_string(count) + " " + what);
    return static_cast<std::size_t>(count);
  };
  const std::size_t faces = next("faces", stream.size());
  for (std::size_t face = 0; face < faces; ++face) {
    const std::size_t size = next("points in a face", stream.size());
    if (size > stream.size() - at) damaged("the faces of cell " + std::to_string(cell) + " end too early");
    points.insert(points.end(), stream.begin() + static_cast<std::ptrdiff_t>(at),
                  stream.begin() + static_cast<std::ptrdiff_t>(at + size));
    at += size;
  }
  if (at != stream.size()) damaged("cell " + std::to_string(cell) + " has more than its faces");
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace gale::io::detail
