#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include <gale/algorithms/critical_points.hpp>
#include <gale/algorithms/discrete_gradient.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/fields.hpp"
#include "algorithms/gradient_reader.hpp"
#include "algorithms/structure_kinds.hpp"
#include "support/segmentations.hpp"
#include "support/voxel_shapes.hpp"

// What a discrete gradient is, whatever algorithm found it: a pairing without closed paths, of which the critical
// simplices know the mesh's topology. On meshes larger than those that it is compared on.

namespace gale::test {

namespace {

struct Shape {
  std::string name;
  std::function<InputMesh()> make;
  Id euler;  ///< as books have it; no_euler where none has
};

constexpr Id no_euler = -1000;

/// Makes so many copies of a mesh, moved apart.
InputMesh copies(const InputMesh& mesh, int count) {
  InputMesh all;
  for (int copy = 0; copy < count; ++copy) {
    for (const auto& point : mesh.points) all.points.push_back({point[0] + 100.0 * copy, point[1], point[2]});
    for (auto corners : mesh.tetrahedra) {
      for (Id& corner : corners) corner += copy * mesh.vertices();
      all.tetrahedra.push_back(corners);
    }
  }
  return all;
}

/// Two cubes with one edge or one vertex in common.
InputMesh touching(Id dz) {
  return voxels(2, 2, 2,
                [dz](Id x, Id y, Id z) { return (x == 0 && y == 0 && z == 0) || (x == 1 && y == 1 && z == dz); });
}

std::vector<Shape> shapes() {
  std::vector<Shape> all = {{"ball", [] { return ball(6); }, 1},
                            {"solid_torus", [] { return solid_torus(6); }, 0},
                            {"thick_shell", [] { return thick_shell(6); }, 2},
                            {"three_tori", [] { return copies(solid_torus(3), 3); }, 0},
                            {"four_shells", [] { return copies(thick_shell(3), 4); }, 8},
                            {"cubes_that_share_an_edge", [] { return touching(0); }, 1},
                            {"cubes_that_share_a_vertex", [] { return touching(1); }, 1},
                            {"seven_on_one_triangle", [] { return mesh_named("seven_on_one_triangle"); }, 1},
                            {"isolated_vertices", [] { return mesh_named("isolated_vertices"); }, no_euler},
                            {"several_components", [] { return mesh_named("several_components"); }, no_euler},
                            {"random_tetrahedra", [] { return mesh_named("random_tetrahedra"); }, no_euler},
                            {"three_caps", [] { return cone_over_caps(100, 3); }, 1},
                            {"holed_grid", [] { return holed_grid(10); }, no_euler}};
#ifdef GALE_ENABLE_VTK
  all.push_back({"delaunay", [] { return delaunay_mesh(1000); }, 1});
#endif
  return all;
}

/// A mesh and gradients on it.
class Subject {
 public:
  explicit Subject(const InputMesh& input)
      : input_(input),
        brute_force_(input),
        mesh_(encode(input, 50)),
        structure_(make_structure(mesh_, discrete_gradient_relations)),
        reader_(brute_force_, mesh_) {}

  const InputMesh& input() const { return input_; }
  const BruteForce& brute_force() const { return brute_force_; }
  const Mesh& mesh() const { return mesh_; }

  DiscreteGradient gradient(const std::vector<double>& field) {
    return find_discrete_gradient(*structure_, order(field), with_threads(2));
  }
  CriticalPoints critical_points(const std::vector<double>& field) {
    return find_critical_points(*structure_, order(field), with_threads(2));
  }
  PairTable pairs(const std::vector<double>& field) { return reader_.pairs(gradient(field)); }

 private:
  VertexOrder order(const std::vector<double>& field) const { return VertexOrder(mesh_, field.data(), field.size()); }

  const InputMesh input_;
  const BruteForce brute_force_;
  const Mesh mesh_;
  std::unique_ptr<Structure> structure_;
  const GradientReader reader_;
};

/// BruteForce's numbers of the simplices of a dimension.
using Numbers = std::map<Simplex, Id>;

Numbers numbers_of(const BruteForce& brute_force, int dimension) {
  Numbers numbers;
  for (const auto& simplex : brute_force.simplices(dimension))
    numbers.emplace(simplex, static_cast<Id>(numbers.size()));
  return numbers;
}

/// The simplex that another is paired with.
Simplex partner_of(Simplex simplex, const Pair& pair) {
  const auto at = std::lower_bound(simplex.begin(), simplex.end(), pair.vertex);
  if (at != simplex.end() && *at == pair.vertex) {
    simplex.erase(at);
  } else {
    simplex.insert(at, pair.vertex);
  }
  return simplex;
}

/// Says each simplex's pair that this simplex is its pair? Then each is in one pair at most.
void expect_mutual(const PairTable& pairs, const BruteForce& brute_force) {
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (const int other : {dimension - 1, dimension + 1}) {
      const Numbers numbers = other < 0 || other > 3 ? Numbers() : numbers_of(brute_force, other);
      const auto& simplices = brute_force.simplices(dimension);
      for (std::size_t i = 0; i < simplices.size(); ++i) {
        if (pairs[dimension][i].dimension != other || other < 0) continue;
        const auto partner = numbers.find(partner_of(simplices[i], pairs[dimension][i]));
        ASSERT_NE(partner, numbers.end()) << "simplex " << i << " of dimension " << dimension;
        const Pair expected = {dimension, pairs[dimension][i].vertex};
        ASSERT_EQ(pairs[other][partner->second], expected) << "simplex " << i << " of dimension " << dimension;
      }
    }
    for (const Pair& pair : pairs[dimension])
      ASSERT_TRUE(pair.dimension == -1 || std::abs(pair.dimension - dimension) == 1);
  }
}

/// Does no path come back that goes from a simplex to its pair of one dimension more, to another facet of that, and so
/// on? Takes away what nothing leads to, until there is nothing.
void expect_no_closed_path(const PairTable& pairs, const BruteForce& brute_force, int dimension) {
  const Numbers numbers = numbers_of(brute_force, dimension);
  const auto& simplices = brute_force.simplices(dimension);
  std::vector<std::vector<Id>> next(simplices.size());
  std::vector<int> incoming(simplices.size(), 0);
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    if (pairs[dimension][i].dimension != dimension + 1) continue;
    const Simplex cell = partner_of(simplices[i], pairs[dimension][i]);
    for (const Id vertex : cell) {
      const Id facet = numbers.at(partner_of(cell, {dimension, vertex}));
      if (facet == static_cast<Id>(i) || pairs[dimension][facet].dimension != dimension + 1) continue;
      next[i].push_back(facet);
      ++incoming[facet];
    }
  }
  std::vector<Id> free;
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    if (incoming[i] == 0) free.push_back(static_cast<Id>(i));
  }
  std::size_t gone = 0;
  for (; !free.empty(); ++gone) {
    const Id here = free.back();
    free.pop_back();
    for (const Id there : next[here]) {
      if (--incoming[there] == 0) free.push_back(there);
    }
  }
  EXPECT_EQ(gone, simplices.size()) << "a closed path of simplices of dimensions " << dimension << " and "
                                    << dimension + 1;
}

Id euler_of(const BruteForce& brute_force) {
  Id euler = 0;
  for (int dimension = 0; dimension < 4; ++dimension) {
    euler += (dimension % 2 == 0 ? 1 : -1) * static_cast<Id>(brute_force.simplices(dimension).size());
  }
  return euler;
}

std::vector<std::vector<double>> some_fields(const InputMesh& input) {
  std::vector<std::vector<double>> fields;
  for (Field& field : fields_on(input)) fields.push_back(std::move(field.values));
  fields.push_back(random_field(input, 6));
  return fields;
}

class GradientOn : public testing::TestWithParam<Shape> {
 protected:
  Subject subject{GetParam().make()};
};

TEST_P(GradientOn, every_shape_is_a_pairing_without_closed_paths) {
  for (const auto& field : some_fields(subject.input())) {
    const PairTable pairs = subject.pairs(field);
    expect_mutual(pairs, subject.brute_force());
    for (const int dimension : {0, 1, 2}) expect_no_closed_path(pairs, subject.brute_force(), dimension);
  }
}

TEST_P(GradientOn, every_shape_has_critical_simplices_that_give_the_euler_characteristic) {
  const Id euler = euler_of(subject.brute_force());
  if (GetParam().euler != no_euler) EXPECT_EQ(euler, GetParam().euler);
  for (const auto& field : some_fields(subject.input())) {
    const CriticalSimplices critical = subject.gradient(field).critical();
    const auto counts = critical.counts();
    EXPECT_EQ(counts[0] - counts[1] + counts[2] - counts[3], euler);
    EXPECT_EQ(critical.euler(), euler);
  }
}

/// A vertex without lower neighbours that isn't a minimum of the piecewise linear field is one where parts touch, or
/// has no neighbours at all.
TEST_P(GradientOn, every_shape_has_the_minima_of_the_piecewise_linear_field) {
  for (const auto& field : some_fields(subject.input())) {
    const auto points = subject.critical_points(field);
    const auto below = [&](Id a, Id b) { return std::make_pair(field[a], a) < std::make_pair(field[b], b); };
    std::vector<Id> expected;
    for (std::size_t i = 0; i < points.vertices.size(); ++i) {
      const Id v = points.vertices[i];
      const auto& neighbours = subject.brute_force().vv[v];
      const bool is_lowest = std::all_of(neighbours.begin(), neighbours.end(), [&](Id u) { return below(v, u); });
      if (points.types[i] == CriticalType::minimum || (points.types[i] == CriticalType::degenerate && is_lowest))
        expected.push_back(v);
    }
    std::vector<Id> minima;
    const auto gradient = subject.gradient(field);
    for (const Id vertex : gradient.critical().vertices) minima.push_back(subject.mesh().vertex_input()(vertex));
    EXPECT_EQ(minima, expected);
  }
}

/// Gives mesh and order other numbers: vertices, tetrahedra and corners are shuffled.
TEST_P(GradientOn, every_shape_does_not_depend_on_numbers) {
  const InputMesh& input = subject.input();
  std::mt19937 random(8);
  std::vector<Id> renamed(input.points.size());
  std::iota(renamed.begin(), renamed.end(), 0);
  std::shuffle(renamed.begin(), renamed.end(), random);
  InputMesh shuffled = input;
  for (Id v = 0; v < input.vertices(); ++v) shuffled.points[renamed[v]] = input.points[v];
  for (auto& corners : shuffled.tetrahedra) {
    for (Id& corner : corners) corner = renamed[corner];
    std::shuffle(corners.begin(), corners.end(), random);
  }
  std::shuffle(shuffled.tetrahedra.begin(), shuffled.tetrahedra.end(), random);
  const auto ranks = random_field(input, 9);
  std::vector<double> shuffled_ranks(ranks.size());
  for (Id v = 0; v < input.vertices(); ++v) shuffled_ranks[renamed[v]] = ranks[v];

  Subject other(shuffled);
  const PairTable pairs = subject.pairs(ranks), other_pairs = other.pairs(shuffled_ranks);
  for (int dimension = 0; dimension < 4; ++dimension) {
    const Numbers numbers = numbers_of(other.brute_force(), dimension);
    const auto& simplices = subject.brute_force().simplices(dimension);
    for (std::size_t i = 0; i < simplices.size(); ++i) {
      Simplex simplex = simplices[i];
      for (Id& vertex : simplex) vertex = renamed[vertex];
      std::sort(simplex.begin(), simplex.end());
      Pair expected = pairs[dimension][i];
      if (expected.vertex != no_id) expected.vertex = renamed[expected.vertex];
      ASSERT_EQ(other_pairs[dimension][numbers.at(simplex)], expected)
          << "simplex " << i << " of dimension " << dimension;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, GradientOn, testing::ValuesIn(shapes()),
                         [](const auto& info) { return info.param.name; });

/// Convex, so each slope's lower links are balls, and each lower star collapses.
TEST(DiscreteGradient, of_a_slope_on_a_ball_has_one_critical_simplex) {
  Subject subject(ball(6));
  const std::array<double, 3> directions[] = {
      {1, 0.1, 0.01}, {0.01, 0.1, 1}, {-1, 0.3, 0.07}, {0.4, -0.5, -0.6}, {-0.01, -0.1, -1}};
  for (const auto& direction : directions) {
    std::vector<double> field;
    for (const auto& p : subject.input().points)
      field.push_back(p[0] * direction[0] + p[1] * direction[1] + p[2] * direction[2]);
    const auto gradient = subject.gradient(field);
    EXPECT_EQ(gradient.critical().counts(), (std::array<Id, 4>{1, 0, 0, 0}));
    const auto lowest = std::min_element(field.begin(), field.end()) - field.begin();
    EXPECT_EQ(subject.mesh().vertex_input()(gradient.critical().vertices.at(0)), static_cast<Id>(lowest));
  }
}

TEST(DiscreteGradient, of_a_constant_field_is_that_of_the_input_ids) {
  Subject subject(thick_shell(6));
  std::vector<double> ids(subject.input().points.size());
  std::iota(ids.begin(), ids.end(), 0);
  EXPECT_EQ(subject.pairs(std::vector<double>(ids.size(), 42)), subject.pairs(ids));
}

}  // namespace

}  // namespace gale::test
