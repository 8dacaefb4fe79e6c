#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include <gale/algorithms/persistence.hpp>
#include <gale/algorithms/persistence/cancellations.hpp>
#include <gale/algorithms/simplify.hpp>
#include <gale/runtime/make_structure.hpp>

#include "algorithms/brute_force_complex.hpp"
#include "algorithms/complexes.hpp"
#include "algorithms/turned_gradient.hpp"
#include "support/message_of.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Id euler(const std::array<Id, 4>& counts) { return counts[0] - counts[1] + counts[2] - counts[3]; }

/// Tetrahedra i, i+1, i+2, i+3, one after the other: a vertex has an edge with those at most three further.
InputMesh strip_of(Id vertices) {
  InputMesh mesh;
  for (Id v = 0; v < vertices; ++v) mesh.points.push_back({0.3 * v, double(v % 2), double(v % 3)});
  for (Id v = 0; v + 3 < vertices; ++v) mesh.tetrahedra.push_back({v + 1, v, v + 3, v + 2});
  return mesh;
}

std::vector<Simplex> all_equal(std::size_t count, const Simplex& simplex) {
  return std::vector<Simplex>(count, simplex);
}

}  // namespace

TEST(Simplify, of_two_minima_keeps_the_lower) {
  // 1 falls to 0. 4 falls to 5, its lowest neighbour, and (1, 4) is in no triangle with either: the saddle. 2 and 3 are
  // above all of their neighbours but one another.
  const ComplexOf found(strip_of(6), {0, 2, 4, 5, 3, 1});
  EXPECT_EQ(found.all().critical, (std::array<std::vector<Simplex>, 4>{{{{0}, {5}}, {{1, 4}}, {}, {}}}));
  ASSERT_EQ(found.all().descending.size(), 2u);
  EXPECT_EQ(found.all().descending[0].cells, (std::vector<Simplex>{{1}, {0}}));
  EXPECT_EQ(found.all().descending[1].cells, (std::vector<Simplex>{{4}, {5}}));
  EXPECT_EQ(found.all().descending_manifold, (std::vector<Simplex>{{0}, {0}, {0}, {0}, {5}, {5}}));
  EXPECT_TRUE(equal(found.simplified(2), found.all())) << "what isn't below the threshold stays";
  const NamedComplex left = found.simplified(2.1);  // 5 and the saddle: 3 - 1
  EXPECT_EQ(left.critical, (std::array<std::vector<Simplex>, 4>{{{{0}}, {}, {}, {}}}));
  EXPECT_TRUE(left.descending.empty());
  EXPECT_EQ(left.descending_manifold, all_equal(6, {0}));
}

TEST(Simplify, joins_paths_over_the_minimum_that_goes) {
  // Minima 0 (value 0), 5 (value 2) and 10 (value 1); saddles (1, 4) of value 4 and (6, 9) of value 6.
  const ComplexOf found(strip_of(11), {0, 3, 7, 8, 4, 2, 5, 9, 10, 6, 1});
  EXPECT_EQ(found.all().critical, (std::array<std::vector<Simplex>, 4>{{{{0}, {5}, {10}}, {{1, 4}, {6, 9}}, {}, {}}}));
  EXPECT_TRUE(equal(found.simplified(2), found.all()));
  const NamedComplex left = found.simplified(5);  // 5 with (1, 4), 4 - 2; but not 10 with (6, 9), 6 - 1
  EXPECT_EQ(left.critical, (std::array<std::vector<Simplex>, 4>{{{{0}, {10}}, {{6, 9}}, {}, {}}}));
  ASSERT_EQ(left.descending.size(), 2u);
  EXPECT_EQ(left.descending[0].source, (Simplex{6, 9}));
  EXPECT_EQ(left.descending[0].cells, (std::vector<Simplex>{{6}, {5}, {4}, {1}, {0}}));
  EXPECT_EQ(left.descending[1].cells, (std::vector<Simplex>{{9}, {10}}));
  EXPECT_EQ(left.descending_manifold[5], (Simplex{0}));
  EXPECT_EQ(left.descending_manifold[9], (Simplex{10}));
  const NamedComplex one = found.simplified(5.1);
  EXPECT_EQ(one.critical, (std::array<std::vector<Simplex>, 4>{{{{0}}, {}, {}, {}}}));
  EXPECT_EQ(one.descending_manifold, all_equal(11, {0}));
}

namespace {

std::vector<Simplex> those(const std::vector<Simplex>& simplices, const std::vector<char>& is_left, bool left) {
  std::vector<Simplex> some;
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    if ((is_left[i] != 0) == left) some.push_back(simplices[i]);
  }
  return some;
}

/// The gradient that cancelling makes of that of a complex, by the definition of cancelling.
BruteForceGradient turned(const ComplexOf& found, const detail::Cancellations& cancelled) {
  const auto& critical = found.all().critical;
  TurnedGradient turned(found.input(), found.field(), BruteForceGradient(found.input(), found.field()));
  auto lower = cancelled.is_left[1], upper = cancelled.is_left[2];
  for (const auto& pair : cancelled.saddles.pairs) lower[pair.lower] = upper[pair.upper] = 1;
  turned.cancel_with_minima(those(critical[1], lower, false));
  turned.cancel_with_maxima(those(critical[2], upper, false));
  for (const auto& pair : cancelled.saddles.pairs) turned.cancel(critical[1][pair.lower], critical[2][pair.upper]);
  return turned.gradient();
}

/// Without connectors whose lower end is the higher one.
void leave_out_inverted(const std::vector<double>& field, NamedComplex& complex) {
  const auto highest = [&](const Simplex& simplex) {
    std::pair<double, Id> highest = {field[simplex[0]], simplex[0]};
    for (const Id v : simplex) highest = std::max(highest, {field[v], v});
    return highest;
  };
  auto& paths = complex.connectors;
  paths.erase(std::remove_if(paths.begin(), paths.end(),
                             [&](const auto& path) { return highest(path.source) > highest(path.destination); }),
              paths.end());
}

/// Each cell of the expected walls is in those that were found, whose cells are there once.
void expect_ascending_walls(const NamedComplex& left, const NamedComplex& expected) {
  ASSERT_EQ(left.ascending_walls.size(), expected.ascending_walls.size());
  for (std::size_t i = 0; i < left.ascending_walls.size(); ++i) {
    const auto &found = left.ascending_walls[i], &wall = expected.ascending_walls[i];
    EXPECT_EQ(found.source, wall.source);
    const std::set<Simplex> cells(found.cells.begin(), found.cells.end());
    EXPECT_EQ(cells.size(), found.cells.size());
    for (const Simplex& cell : wall.cells) EXPECT_EQ(cells.count(cell), 1u);
  }
}

void expect_that_of_turned_gradient(const ComplexOf& found, double threshold, bool extrema_only) {
  const auto value = [&](Id v) { return found.field().at(v); };
  const auto values = detail::critical_values(found.complex().gradient, value);
  const auto cancelled = detail::cancel_below(threshold, found.complex(), values, extrema_only, true, 2);
  NamedComplex expected = brute_force_complex(found.input(), turned(found, cancelled));
  leave_out_inverted(found.field(), expected);
  SimplifyOptions options;
  options.extrema_only = extrema_only;
  const MorseSmaleComplex simplified = simplify(found.complex(), value, threshold, options);
  NamedComplex left = as_defined(named(simplified));
  expect_ascending_walls(left, expected);
  left.ascending_walls = expected.ascending_walls;
  EXPECT_TRUE(equal(left, as_defined(expected)));
  EXPECT_EQ(euler(left.counts()), euler(found.all().counts()));
}

/// As many critical simplices as the pairs of at least that persistence want, but for the saddles that are kept.
void expect_counts(const ComplexOf& found, double threshold) {
  const auto value = [&](Id v) { return found.field().at(v); };
  const auto values = detail::critical_values(found.complex().gradient, value);
  const auto pairs = find_persistence_pairs(found.complex().gradient);
  auto counts = found.all().counts();
  for (int type = 0; type < 3; ++type) {
    const auto below = static_cast<Id>(detail::pairs_below(threshold, type, pairs.pairs[type], values).size());
    counts[type] -= below;
    counts[type + 1] -= below;
  }
  const MorseSmaleComplex left = simplify(found.complex(), value, threshold);
  counts[1] += left.kept_below.count();
  counts[2] += left.kept_below.count();
  EXPECT_EQ(left.critical.counts(), counts);
}

/// With each of fields_on it, and noise.
void expect_those_of_turned_gradients(const InputMesh& input) {
  auto fields = fields_on(input);
  fields.push_back({"noise", random_field(input, 1)});
  for (const Field& field : fields) {
    const ComplexOf found(input, field.values);
    EXPECT_TRUE(equal(found.simplified(0), found.all())) << field.name;
    const double most = field.name == "permutation" || field.name == "noise" ? input.vertices() : 20;
    for (const double threshold : {1e-9, 0.05 * most, 0.15 * most, 0.4 * most, infinity}) {
      SCOPED_TRACE(field.name + ", threshold " + std::to_string(threshold));
      expect_that_of_turned_gradient(found, threshold, false);
      expect_that_of_turned_gradient(found, threshold, true);
      expect_counts(found, threshold);
    }
  }
}

}  // namespace

class SimplifyOf : public testing::TestWithParam<std::string> {};

TEST_P(SimplifyOf, every_field_is_the_complex_of_a_turned_gradient) {
  expect_those_of_turned_gradients(mesh_named(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Tests, SimplifyOf,
                         testing::Values("the_papers", "isolated_vertices", "slivers", "cone_over_disc_200",
                                         "cone_over_sphere_200", "ball", "solid_torus", "thick_shell"),
                         [](const auto& info) { return info.param; });

TEST(Simplify, of_noise_is_the_complex_of_a_turned_gradient) {
  expect_those_of_turned_gradients(holed_grid(6));
#ifdef GALE_ENABLE_VTK  // which makes that mesh
  expect_those_of_turned_gradients(delaunay_mesh(150));
#endif
}

class SimplifyForked : public testing::TestWithParam<std::string> {};

/// Where triangles have three tetrahedra and more, pairs with maxima are those that paths allow.
TEST_P(SimplifyForked, keeps_the_euler_number) {
  const InputMesh& input = mesh_named(GetParam());
  for (const Field& field : fields_on(input)) {
    const ComplexOf found(input, field.values);
    for (const double threshold : {1e-9, 1.0, 8.0, infinity}) {
      const NamedComplex left = found.simplified(threshold);
      EXPECT_EQ(euler(left.counts()), euler(found.all().counts()));
      for (int d = 0; d < 4; ++d) EXPECT_LE(left.critical[d].size(), found.all().critical[d].size());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, SimplifyForked,
                         testing::Values("three_on_one_triangle", "seven_on_one_triangle", "several_components",
                                         "random_tetrahedra", "cone_over_three_caps_100"),
                         [](const auto& info) { return info.param; });

TEST(Simplify, of_noise_leaves_few) {
  const InputMesh input = holed_grid(12);
  const ComplexOf found(input, random_field(input, 3));
  const NamedComplex left = found.simplified(infinity);
  EXPECT_EQ(euler(left.counts()), euler(found.all().counts()));
  EXPECT_LT(left.critical[0].size() * 20, found.all().critical[0].size());
  for (const auto* paths : {&left.descending, &left.ascending, &left.connectors}) {
    for (const auto& path : *paths) {
      EXPECT_EQ(std::set<Simplex>(path.cells.begin(), path.cells.end()).size(), path.cells.size());
    }
  }
}

TEST(Simplify, of_noise_tells_no_line_twice) {
  const InputMesh input = holed_grid(12);
  const ComplexOf found(input, random_field(input, 3));
  for (const double threshold : {0.02 * input.vertices(), 0.2 * input.vertices(), infinity}) {
    const NamedComplex left = found.simplified(threshold);
    std::set<std::pair<Simplex, Simplex>> ends;
    for (const auto& path : left.connectors) {
      EXPECT_TRUE(ends.insert({path.source, path.destination}).second) << "parallel connectors";
      for (std::size_t i = 1; i < path.cells.size(); ++i) {
        Simplex shared;
        std::set_intersection(path.cells[i - 1].begin(), path.cells[i - 1].end(), path.cells[i].begin(),
                              path.cells[i].end(), std::back_inserter(shared));
        EXPECT_EQ(shared.size(), 2u) << "from triangle to triangle over an edge";
      }
      EXPECT_TRUE(
          std::includes(path.cells.front().begin(), path.cells.front().end(), path.source.begin(), path.source.end()));
      EXPECT_EQ(path.cells.back(), path.destination);
    }
  }
}

TEST(Simplify, is_the_same_with_any_number_of_threads) {
  const InputMesh input = holed_grid(14);
  const ComplexOf found(input, random_field(input, 4));
  const auto value = [&](Id v) { return found.field().at(v); };
  const double threshold = 0.3 * input.vertices();
  SimplifyOptions options;
  options.threads = 1;
  const MorseSmaleComplex one = simplify(found.complex(), value, threshold, options);
  for (const int threads : {2, 8}) {
    options.threads = threads;
    EXPECT_TRUE(equal(simplify(found.complex(), value, threshold, options), one)) << threads << " threads";
  }
}

TEST(Simplify, refuses_a_simplified_complex) {
  const ComplexOf found(strip_of(6), {0, 2, 4, 5, 3, 1});
  const auto value = [&](Id v) { return found.field().at(v); };
  const MorseSmaleComplex left = simplify(found.complex(), value, 3);
  EXPECT_EQ(message_of([&] { simplify(left, value, 3); }),
            "simplify takes a complex that isn't simplified: this one has 1 of the gradient's 3 critical simplices");
}

TEST(Simplify, refuses_a_complex_without_the_parts_that_it_needs) {
  const InputMesh input = strip_of(6);
  const Mesh mesh = encode(input, 50);
  const auto runtime = make_structure(mesh, morse_smale_relations);
  const std::vector<double> field = {0, 2, 4, 5, 3, 1};
  const auto gradient = find_discrete_gradient(*runtime, VertexOrder(mesh, field.data(), field.size()));
  const auto message = [&](const MorseSmaleParts& parts) {
    return message_of([&] {
      simplify(
          find_morse_smale_complex(*runtime, gradient, parts), [&](Id v) { return field.at(v); }, 5);
    });
  };
  const std::string refusal = "simplify needs parts that the complex was computed without: ";
  MorseSmaleParts parts;
  parts.descending_manifolds = parts.ascending_manifolds = false;
  EXPECT_EQ(message(parts), "no error");
  parts.saddle_connectors = false;
  EXPECT_EQ(message(parts), refusal + "saddle connectors");
  parts.saddle_connectors = true;
  parts.descending_separatrices = parts.ascending_separatrices = false;
  EXPECT_EQ(message(parts), "no error");
}

TEST(Simplify, refuses_arguments_that_are_none) {
  const ComplexOf found(strip_of(6), {0, 2, 4, 5, 3, 1});
  const auto value = [&](Id v) { return found.field().at(v); };
  EXPECT_EQ(message_of([&] { simplify(found.complex(), value, std::nan("")); }),
            "the persistence nan is not 0 or more");
  EXPECT_EQ(message_of([&] { simplify(found.complex(), value, -1); }), "the persistence -1 is not 0 or more");
  EXPECT_EQ(message_of([&] { simplify(found.complex(), nullptr, 1); }),
            "a complex simplified by persistence needs the field's values");
  SimplifyOptions options;
  options.threads = most_threads + 1;
  EXPECT_EQ(message_of([&] { simplify(found.complex(), value, 1, options); }), "threads is 1025, not 1 to 1024");
}

}  // namespace gale::test
