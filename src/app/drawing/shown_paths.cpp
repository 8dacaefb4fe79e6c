#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include <gale/app/drawing/arrays.hpp>
#include <gale/app/drawing/picture.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

namespace {

/// A path: where its points stand in the surface's lines, and what its line says.
struct Path {
  std::size_t first, last;  ///< the last is the path's, too
  int type;
  Id destination;
  double difference;  ///< how much the field changes along it
};

class Chooser {
 public:
  Chooser(const io::Surface& surface, const std::function<bool(const Point&)>& inside)
      : points_(to_points(surface.points)),
        along_(surface.lines.points),
        mask_(values_of<std::int8_t>(surface.point_arrays, "ttkMaskScalarField")),
        dimensions_(values_of<std::int8_t>(surface.point_arrays, "CellDimension")),
        ids_(values_of<Id>(surface.point_arrays, "CellId")) {
    for (const Point& point : points_) is_inside_.push_back(inside(point));
    find_paths(surface);
    find_junctions();
  }

  ShownPaths choose(Id most) {
    ShownPaths shown;
    for (const Path* path : by_difference()) {
      ShownPaths::Kind& kind = shown.kinds[path->type];
      const std::vector<std::size_t> way = whole(*path);
      if (!comes_inside(way)) continue;
      ++kind.inside;
      if (kind.shown == most) continue;
      ++kind.shown;
      for (const std::size_t end : {way.front(), way.back()}) shown.ends.insert({dimensions_[end], ids_[end]});
      add_new(way, path->type, kind.stretches);
    }
    return shown;
  }

 private:
  void find_paths(const io::Surface& surface) {
    const auto& types = values_of<std::int8_t>(surface.cell_arrays, "SeparatrixType");
    const auto& destinations = values_of<Id>(surface.cell_arrays, "DestinationId");
    const io::PointArray& differences = array_of(surface.cell_arrays, "SeparatrixFunctionDifference");
    const auto& begin = surface.lines.begin;
    for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
      paths_.push_back({static_cast<std::size_t>(begin[i]), static_cast<std::size_t>(begin[i + 1]) - 1, types[i],
                        destinations[i], outputs::value_at(differences, static_cast<Id>(i))});
    }
  }

  /// A point on paths to one destination, by its place on one of them.
  std::uint64_t key(const Path& path, std::size_t place) const {
    return std::uint64_t(path.destination) << 32 | static_cast<std::uint32_t>(along_[place]);
  }

  bool is_joined(const Path& path) const { return mask_[along_[path.last]] != 0; }

  /// Finds where joined paths go on: the earliest path that has the point.
  void find_junctions() {
    std::unordered_set<std::uint64_t> wanted[3];
    for (const Path& path : paths_) {
      if (is_joined(path)) wanted[path.type].insert(key(path, path.last));
    }
    for (const Path& path : paths_) {
      for (std::size_t place = path.first; place <= path.last; ++place) {
        const std::uint64_t here = key(path, place);
        if (wanted[path.type].count(here) != 0) junctions_[path.type].insert({here, {&path, place}});
      }
    }
  }

  std::vector<const Path*> by_difference() const {
    std::vector<const Path*> order;
    for (const Path& path : paths_) order.push_back(&path);
    std::stable_sort(order.begin(), order.end(),
                     [](const Path* a, const Path* b) { return a->difference > b->difference; });
    return order;
  }

  /// The points of a path down to its destination.
  std::vector<std::size_t> whole(const Path& path) const {
    std::vector<std::size_t> way;
    const Path* at = &path;
    for (std::size_t from = path.first;;) {
      way.insert(way.end(), along_.begin() + from, along_.begin() + at->last + 1);
      if (!is_joined(*at)) return way;
      const auto [next, place] = junctions_[at->type].at(key(*at, at->last));
      if (next == at) return way;
      at = next, from = place + 1;
    }
  }

  bool comes_inside(const std::vector<std::size_t>& way) const {
    for (std::size_t k = 0; k + 1 < way.size(); ++k) {
      if (is_inside_[way[k]] && is_inside_[way[k + 1]]) return true;
    }
    return false;
  }

  /// Adds the stretches of a path that are inside, and that no other path has added before.
  void add_new(const std::vector<std::size_t>& way, int type, std::vector<std::vector<Point>>& stretches) {
    const std::vector<Point> smooth = smoothed(way);
    bool was_new = false;
    for (std::size_t k = 0; k + 1 < way.size(); ++k) {
      const auto [low, high] = std::minmax(way[k], way[k + 1]);
      const std::uint64_t line = std::uint64_t(low) << 32 | high;
      const bool is_new = is_inside_[way[k]] && is_inside_[way[k + 1]] && seen_[type].insert(line).second;
      if (is_new && !was_new) stretches.push_back({smooth[k]});
      if (is_new) stretches.back().push_back(smooth[k + 1]);
      was_new = is_new;
    }
  }

  /// The path with each point but the ends moved towards the middle of its neighbours, forty times.
  std::vector<Point> smoothed(const std::vector<std::size_t>& way) const {
    std::vector<Point> path;
    for (const std::size_t point : way) path.push_back(points_[point]);
    std::vector<Point> next = path;
    for (int i = 0; i < 40; ++i, path.swap(next)) {
      for (std::size_t k = 1; k + 1 < path.size(); ++k) {
        for (int axis = 0; axis < 3; ++axis)
          next[k][axis] = path[k][axis] / 2 + (path[k - 1][axis] + path[k + 1][axis]) / 4;
      }
    }
    return path;
  }

  const std::vector<Point> points_;
  const std::vector<std::int32_t>& along_;
  const std::vector<std::int8_t>&mask_, &dimensions_;
  const std::vector<Id>& ids_;
  std::vector<char> is_inside_;
  std::vector<Path> paths_;
  std::unordered_map<std::uint64_t, std::pair<const Path*, std::size_t>> junctions_[3];
  std::unordered_set<std::uint64_t> seen_[3];
};

}  // namespace

bool ShownPaths::are_all() const {
  return std::all_of(kinds.begin(), kinds.end(), [](const Kind& kind) { return kind.shown == kind.inside; });
}

ShownPaths shown_paths(const io::Surface& separatrices1, Id most, const std::function<bool(const Point&)>& inside) {
  return Chooser(separatrices1, inside).choose(most);
}

}  // namespace gale::app
