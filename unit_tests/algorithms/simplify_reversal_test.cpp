#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "algorithms/brute_force_simplify.hpp"
#include "algorithms/complexes.hpp"
#include "support/voxel_shapes.hpp"

// Cancelling an extremum and a saddle is the same as turning the gradient around on the path between the two (Forman
// 1998): what is left are the paths of another gradient.

namespace gale::test {

namespace {

/// Where paths go next, from vertex to vertex or from tetrahedron to tetrahedron.
class Flow {
 public:
  using Path = std::vector<Simplex>;

  /// The next one may be nothing: the outside.
  void set(const Simplex& from, const Simplex& next) { next_[from] = next; }

  /// Its last cell is nothing if it leaves.
  Path from(const Simplex& start) const {
    Path path = {start};
    for (auto at = next_.find(start); at != next_.end(); at = next_.find(path.back())) path.push_back(at->second);
    return path;
  }

  /// From the side of a saddle that flows to an extremum to its other side.
  void turn_around(const std::vector<Simplex>& sides, const Simplex& extremum) {
    for (std::size_t i = 0; i < 2; ++i) {
      const Path path = from(sides[i]);
      if (path.back() != extremum) continue;
      next_.erase(extremum);
      for (std::size_t k = 1; k < path.size(); ++k) next_[path[k]] = path[k - 1];
      next_[sides[i]] = sides[1 - i];
      return;
    }
    ADD_FAILURE() << "no path from the saddle to the extremum";
  }

 private:
  std::map<Simplex, Simplex> next_;
};

/// The flows of a gradient on a mesh of which no triangle has three tetrahedra.
struct Flows {
  std::vector<Simplex> tetrahedra;
  std::map<Simplex, std::vector<Simplex>> sides;  ///< of a triangle; one may be nothing
  Flow down, up;

  Flows(const InputMesh& input, const BruteForceGradient& gradient) {
    for (const auto& corners : input.tetrahedra) {
      tetrahedra.emplace_back(corners.begin(), corners.end());
      std::sort(tetrahedra.back().begin(), tetrahedra.back().end());
      for (const Id v : tetrahedra.back()) sides[without(tetrahedra.back(), v)].push_back(tetrahedra.back());
    }
    for (auto& triangle_and_sides : sides) triangle_and_sides.second.resize(2);
    for (const auto& [simplex, partner] : gradient.partner) {
      if (simplex.size() == 1) down.set(simplex, {partner[0] == simplex[0] ? partner[1] : partner[0]});
      if (simplex.size() == 4) up.set(simplex, other_side(partner, simplex));
    }
  }

  void cancel(const Simplex& low, const Simplex& high) {
    if (low.size() == 1) down.turn_around({{high[0]}, {high[1]}}, low);
    if (high.size() == 4) up.turn_around(sides.at(low), high);
  }

 private:
  static Simplex without(Simplex simplex, Id vertex) {
    simplex.erase(std::find(simplex.begin(), simplex.end(), vertex));
    return simplex;
  }

  Simplex other_side(const Simplex& triangle, const Simplex& tetrahedron) const {
    const auto& both = sides.at(triangle);
    return both[0] == tetrahedron ? both[1] : both[0];
  }
};

void expect_paths(const NamedComplex& left, const Flows& flows) {
  std::vector<NamedComplex::Path> descending, ascending;
  for (const Simplex& edge : left.critical[1]) {
    for (const Id v : edge) {
      const auto path = flows.down.from({v});
      descending.push_back({edge, path.back(), path, true});
    }
  }
  for (const Simplex& triangle : left.critical[2]) {
    for (const Simplex& side : flows.sides.at(triangle)) {
      const auto path = side.empty() ? Flow::Path{side} : flows.up.from(side);
      if (!path.back().empty()) ascending.push_back({triangle, path.back(), path, true});
    }
  }
  NamedComplex expected = left;
  expected.descending = descending;
  expected.ascending = ascending;
  EXPECT_TRUE(equal(with_sorted_paths(left), with_sorted_paths(expected)));
}

void expect_manifolds(const NamedComplex& left, const Flows& flows) {
  for (std::size_t v = 0; v < left.descending_manifold.size(); ++v) {
    const Id vertex = static_cast<Id>(v);
    ASSERT_EQ(left.descending_manifold[v], flows.down.from({vertex}).back());
    const auto first = std::find_if(flows.tetrahedra.begin(), flows.tetrahedra.end(), [&](const Simplex& tetrahedron) {
      return std::find(tetrahedron.begin(), tetrahedron.end(), vertex) != tetrahedron.end();
    });
    ASSERT_EQ(left.ascending_manifold[v], first == flows.tetrahedra.end() ? Simplex() : flows.up.from(*first).back());
  }
}

InputMesh mesh_of(const std::string& name) {
  return name == "ball"          ? ball(6)
         : name == "solid_torus" ? solid_torus(6)
         : name == "thick_shell" ? thick_shell(3)
                                 : holed_grid(7);
}

}  // namespace

class SimplifyReverses : public testing::TestWithParam<std::string> {};

TEST_P(SimplifyReverses, the_gradient_between_extrema_and_saddles) {
  const InputMesh input = mesh_of(GetParam());
  for (const unsigned seed : {1, 2}) {
    const ComplexOf found(input, random_field(input, seed));
    const double size = input.vertices();
    for (const double threshold : {0.1 * size, 0.4 * size, 2 * size}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", threshold " + std::to_string(threshold));
      Flows flows(input, BruteForceGradient(input, found.field()));
      int extrema = 0;
      for (const auto& [low, high] : brute_force_cancellations(found.all(), found.field(), threshold)) {
        extrema += low.size() == 1 || high.size() == 4;
        flows.cancel(low, high);
      }
      EXPECT_GT(extrema, 0);
      const NamedComplex left = found.simplified(threshold);
      expect_paths(left, flows);
      expect_manifolds(left, flows);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, SimplifyReverses, testing::Values("ball", "solid_torus", "thick_shell", "holed_grid"),
                         [](const auto& info) { return info.param; });

}  // namespace gale::test
