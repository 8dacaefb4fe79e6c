#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <Kokkos_Core.hpp>

namespace gale::io {
namespace detail {

using AnyVector =
    std::variant<std::vector<std::int8_t>, std::vector<std::uint8_t>, std::vector<std::int16_t>,
                 std::vector<std::uint16_t>, std::vector<std::int32_t>, std::vector<std::uint32_t>,
                 std::vector<std::int64_t>, std::vector<std::uint64_t>, std::vector<float>, std::vector<double>>;

}  // namespace detail

/// One array of values per point, as a file carries it: `components` values for each point, point after point.
struct PointArray {
  /// One of these vectors; to be used as the std::variant that it is. When memory for a copy runs out, libstdc++ 12's
  /// variant of vectors destroys one that was never made: here the copy is made first, and moved.
  struct Values : detail::AnyVector {
    using detail::AnyVector::AnyVector;

    Values() = default;                                                        ///< no values, of the type that is first
    Values(const Values& other) : Values(copy_of(other)) {}                    ///< copies first, then moves
    Values(Values&&) = default;                                                ///< moves
    Values& operator=(const Values& other) { return *this = copy_of(other); }  ///< copies first, then moves
    Values& operator=(Values&&) = default;                                     ///< moves
    ~Values() = default;

   private:
    static Values copy_of(const detail::AnyVector& other) {
      return std::visit(
          [](const auto& values) -> Values {
            auto copy = values;
            return copy;
          },
          other);
    }
  };

  std::string name;    ///< as in the file
  int components = 1;  ///< values of each point, at least 1
  Values values;       ///< the values of point p begin at p * components
};

/// A tetrahedral mesh in input ids, as read from a file or generated: what goes into a `gale::Mesh`, and what outputs
/// are made from.
struct Dataset {
  /// Three coordinates a point.
  template <class Coordinate>
  using Points = Kokkos::View<Coordinate* [3], Kokkos::LayoutRight, Kokkos::HostSpace>;

  /// Points of either precision, as the file has them.
  using Positions = std::variant<Points<float>, Points<double>>;

  Positions points;  ///< where the vertices are

  /// The four vertices of each tetrahedron.
  Kokkos::View<std::int32_t* [4], Kokkos::LayoutRight, Kokkos::HostSpace> tetrahedra;

  std::vector<PointArray> arrays;    ///< the file's point arrays, the active scalars first
  std::vector<std::string> notices;  ///< one line each about what of the file was left out
};

}  // namespace gale::io
