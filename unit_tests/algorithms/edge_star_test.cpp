#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include <gale/algorithms/morse_smale/edge_star.hpp>
#include <gale/runtime/make_structure.hpp>

#include "support/input_mesh.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

/// The tetrahedra of an edge in the order that EdgeStar promises, by trying all of them at each step.
class Around {
 public:
  struct Wedge {
    Id input, tetrahedron;
    std::array<Id, 2> sides;
    bool taken = false;
  };

  explicit Around(std::vector<Wedge> wedges) : wedges_(std::move(wedges)) {
    std::sort(wedges_.begin(), wedges_.end(), [](const Wedge& a, const Wedge& b) { return a.input < b.input; });
    while (order_.size() < wedges_.size()) {
      Wedge* const begin = first();
      take(*begin);
      const Wedge *const one = next(begin->sides[0]), *const other = next(begin->sides[1]);
      Id side = begin->sides[other == nullptr || (one != nullptr && one <= other) ? 0 : 1];
      while (Wedge* const wedge = next(side)) {
        take(*wedge);
        side = wedge->sides[wedge->sides[0] == side ? 1 : 0];
      }
    }
  }

  const std::vector<Id>& order() const { return order_; }

 private:
  static bool has(const Wedge& wedge, Id side) { return wedge.sides[0] == side || wedge.sides[1] == side; }

  bool is_end(const Wedge& wedge) const {
    return std::any_of(wedge.sides.begin(), wedge.sides.end(), [&](Id side) {
      return std::count_if(wedges_.begin(), wedges_.end(), [&](const Wedge& other) { return has(other, side); }) == 1;
    });
  }

  template <class Condition>
  Wedge* first_left(const Condition& condition) {
    const auto at = std::find_if(wedges_.begin(), wedges_.end(),
                                 [&](const Wedge& wedge) { return !wedge.taken && condition(wedge); });
    return at == wedges_.end() ? nullptr : &*at;
  }

  Wedge* first() {
    Wedge* const end = first_left([&](const Wedge& wedge) { return is_end(wedge); });
    return end != nullptr ? end : first_left([](const Wedge&) { return true; });
  }

  Wedge* next(Id side) {
    return first_left([&](const Wedge& wedge) { return has(wedge, side); });
  }

  void take(Wedge& wedge) {
    wedge.taken = true;
    order_.push_back(wedge.tetrahedron);
  }

  std::vector<Wedge> wedges_;
  std::vector<Id> order_;
};

/// By both ends, the higher id first.
std::map<std::array<Id, 2>, std::vector<Around::Wedge>> wedges_by_edge(const Mesh& mesh) {
  std::map<std::array<Id, 2>, std::vector<Around::Wedge>> wedges;
  for (Id t = 0; t < mesh.cells(); ++t) {
    const Id* const v = &mesh.encoded().cells(t, 0);
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) {
        Around::Wedge wedge{mesh.cell_input()(t), t, {}};
        std::copy_if(v, v + 4, wedge.sides.begin(), [&](Id other) { return other != v[i] && other != v[j]; });
        wedges[{v[i], v[j]}].push_back(wedge);
      }
    }
  }
  return wedges;
}

}  // namespace

class EdgeStarIn : public testing::TestWithParam<std::string> {};

TEST_P(EdgeStarIn, every_mesh_goes_around_each_edge_in_the_order_that_it_promises) {
  const Mesh mesh = encode(mesh_named(GetParam()), 100);
  const auto runtime = make_structure(mesh, Relation::VT);
  const auto consumer = runtime->consumer();
  detail::EdgeStar star(mesh);
  for (const auto& [edge, wedges] : wedges_by_edge(mesh)) {
    std::vector<Id> thirds;
    for (const auto& wedge : wedges) thirds.insert(thirds.end(), wedge.sides.begin(), wedge.sides.end());
    std::sort(thirds.begin(), thirds.end());
    thirds.erase(std::unique(thirds.begin(), thirds.end()), thirds.end());
    for (const auto& [from, to] : {std::make_pair(edge[0], edge[1]), std::make_pair(edge[1], edge[0])}) {
      star.find(from, to, consumer->row(Relation::VT, from));
      ASSERT_EQ(star.thirds(), thirds);
      ASSERT_EQ(star.around(), Around(wedges).order()) << "around " << from << ' ' << to;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, EdgeStarIn,
                         testing::Values("one_tetrahedron", "three_on_one_triangle", "seven_on_one_triangle",
                                         "several_components", "cone_over_disc_200", "cone_over_sphere_200",
                                         "cone_over_sphere_2000", "cone_over_three_caps_100", "holed_grid_9"),
                         [](const auto& info) { return info.param; });

}  // namespace gale::test
