#pragma once

#include <any>
#include <utility>
#include <variant>

#include <gale/base/parallel.hpp>
#include <gale/mesh/segmentation.hpp>

namespace gale {

/// Where points are, on the host, in the precision that a caller has them in. Copies share them, and keep alive what
/// they were made from.
class HostPoints {
 public:
  HostPoints() = default;
  /// Points in the memory of a View.
  HostPoints(const Points<float, HostMemory>& points) : points_(points) {}

  /// Points in the memory of a View.
  HostPoints(const Points<double, HostMemory>& points) : points_(points) {}

  /// Points in the memory of `owner`, a View of any kind.
  template <class Coordinate, class Owner>
  HostPoints(const Points<Coordinate, HostMemory>& points, const Owner& owner) : points_(points), owner_(owner) {}

  /// Returns f(points), which have float or double coordinates.
  template <class F>
  auto visit(const F& f) const {
    return std::visit(f, points_);
  }

  /// How many points there are.
  Offset count() const {
    return visit([](const auto& points) { return static_cast<Offset>(points.extent(0)); });
  }

  /// Points begin to begin + count - 1, which share this memory.
  HostPoints part(Offset begin, Offset count) const {
    return visit([&](const auto& points) {
      using Some = std::decay_t<decltype(points)>;
      return HostPoints(Some(Kokkos::subview(points, std::make_pair(begin, begin + count), Kokkos::ALL())), owner_);
    });
  }

  /// The points as doubles: this memory if they are so already, else a copy.
  Points<double, HostMemory> in_double() const {
    if (const auto* points = std::get_if<Points<double, HostMemory>>(&points_)) return *points;
    const auto copy = allocate<Kokkos::View<double* [3], Kokkos::LayoutRight, HostMemory>>("GALE::points", count());
    visit([&](const auto& points) {
      parallel_for("GALE::points", HostExecutionSpace(), count(), [&](Offset i) {
        for (int axis = 0; axis < 3; ++axis) copy(i, axis) = points(i, axis);
      });
    });
    return copy;
  }

 private:
  std::variant<Points<float, HostMemory>, Points<double, HostMemory>> points_;
  std::any owner_;
};

}  // namespace gale
