#include <set>

#include <gale/algorithms/persistence/walls_left.hpp>

namespace gale::detail {

namespace {

/// The walls that make up that of a saddle: its own, then the others, in the order of their places.
std::vector<Id> parts_of(const std::vector<std::vector<Id>>& joined, Id saddle) {
  std::set<Id> found = {saddle};
  std::vector<Id> rest = {saddle};
  while (!rest.empty()) {
    const Id at = rest.back();
    rest.pop_back();
    for (const Id other : joined[at]) {
      if (found.insert(other).second) rest.push_back(other);
    }
  }
  found.erase(saddle);
  std::vector<Id> parts = {saddle};
  parts.insert(parts.end(), found.begin(), found.end());
  return parts;
}

}  // namespace

AscendingWalls ascending_walls_left(const AscendingWalls& all, const std::vector<std::vector<Id>>& joined,
                                    const std::vector<char>& is_left) {
  AscendingWalls left;
  Id place = 0;
  for (Id saddle = 0; saddle < all.walls.count(); ++saddle) {
    if (!is_left[saddle]) continue;
    const std::vector<Id> parts = parts_of(joined, saddle);
    std::set<std::array<Id, 2>> seen;
    for (const Id part : parts) {
      for (Offset cell = all.walls.begin[part]; cell < all.walls.begin[part + 1]; ++cell) {
        if (parts.size() > 1 && !seen.insert(all.walls.cells[cell]).second) continue;
        left.walls.cells.push_back(all.walls.cells[cell]);
        left.star.insert(left.star.end(), all.star.begin() + all.star_begin[cell],
                         all.star.begin() + all.star_begin[cell + 1]);
        left.star_begin.push_back(static_cast<Offset>(left.star.size()));
      }
    }
    left.walls.sources.push_back(place++);
    left.walls.begin.push_back(static_cast<Offset>(left.walls.cells.size()));
  }
  return left;
}

}  // namespace gale::detail
