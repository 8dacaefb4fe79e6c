#include <algorithm>
#include <utility>
#include <vector>

#include <gale/algorithms/morse_smale/device_connectors.hpp>
#include <gale/algorithms/morse_smale/growing_walls.hpp>
#include <gale/base/error.hpp>

namespace gale::detail {

namespace {

class Connectors {
 public:
  Connectors(const DiscreteGradient& gradient, const CriticalSimplices& critical, const CriticalPlaces& places,
             Offset most_together)
      : critical_(critical), places_(places), most_together_(most_together), walls_(WorkerSpace(), gradient) {}

  Id count() const { return static_cast<Id>(critical_.triangles.size()); }

  /// Appends those of some critical triangles: in halves, if their walls together are too many.
  void add(Id begin, Id end) {
    const Id size = end - begin;
    if (size <= walls_.most_walls()) {
      try {
        walls_.grow(critical_.triangles.data() + begin, size, size > 1 ? most_together_ : WallTable::most_triangles);
        add_paths(begin);
        return;
      } catch (const OutOfMemory&) {
        if (size == 1) throw;
      }
    }
    add(begin, begin + size / 2);
    add(begin + size / 2, end);
  }

  Separatrices<TriangleVertices> paths;

 private:
  void add_paths(Id first) {
    std::vector<std::pair<Id, WallRim>> rims;
    for (const WallRim& rim : walls_.rims()) rims.push_back({places_.of_edge(rim.high, rim.low), rim});
    std::sort(rims.begin(), rims.end(), [](const auto& a, const auto& b) {
      return std::make_pair(a.second.wall, a.first) < std::make_pair(b.second.wall, b.first);
    });
    std::vector<WallRim> sorted;
    for (const auto& [place, rim] : rims) sorted.push_back(rim);
    walls_.append_paths(sorted, paths);
    for (const auto& [place, rim] : rims) {
      paths.sources.push_back(place);
      paths.destinations.push_back(first + rim.wall);
    }
  }

  const CriticalSimplices& critical_;
  const CriticalPlaces& places_;
  const Offset most_together_;
  GrowingWalls walls_;
};

}  // namespace

Separatrices<TriangleVertices> device_connectors(const DiscreteGradient& gradient, const CriticalSimplices& critical,
                                                 const CriticalPlaces& places, Offset most_together) {
  Connectors connectors(gradient, critical, places, most_together);
  if (connectors.count() > 0) connectors.add(0, connectors.count());
  return std::move(connectors.paths);
}

}  // namespace gale::detail
