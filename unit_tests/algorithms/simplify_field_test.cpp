#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include <gale/algorithms/simplify_field.hpp>
#include <gale/base/error.hpp>
#include <gale/io/synthetic.hpp>

#include "algorithms/brute_force_trees.hpp"
#include "algorithms/fields.hpp"
#include "algorithms/structure_kinds.hpp"
#include "algorithms/surface_cases.hpp"
#include "support/every_mesh.hpp"
#include "support/message_of.hpp"

namespace gale::test {

namespace {

/// Meshes in which parts touch others in single vertices or edges: they may have extrema in any order.
bool has_parts_that_hang(const std::string& mesh) {
  static const std::set<std::string> some = {"two_sharing_an_edge",  "two_sharing_a_vertex", "random_tetrahedra",
                                             "random_hubs",          "holed_grid_9",         "cone_over_three_caps_100",
                                             "three fans that meet", "any triangles"};
  return some.count(mesh) > 0;
}

std::vector<double> doubles(const std::vector<Id>& ids) { return {ids.begin(), ids.end()}; }

std::vector<double> values_of(const SimplifiedField& field, const std::vector<double>& before) {
  std::vector<double> values;
  for (const Id vertex : field.value_of) values.push_back(before[vertex]);
  return values;
}

/// An order of all vertices along which values never fall, in which those that keep theirs come as before.
void expect_orderly(const SimplifiedField& field, const std::vector<double>& before) {
  const auto count = static_cast<Id>(before.size());
  std::vector<Id> by_rank(count, no_id);
  for (Id v = 0; v < count; ++v) by_rank.at(field.rank[v]) = v;
  EXPECT_EQ(std::count(by_rank.begin(), by_rank.end(), no_id), 0);
  const auto values = values_of(field, before);
  Id last = no_id;
  for (Id i = 0; i < count; ++i) {
    const Id v = by_rank[i];
    if (i > 0) EXPECT_LE(values[by_rank[i - 1]], values[v]);
    if (field.value_of[v] != v) continue;
    if (last != no_id) EXPECT_LT(std::pair(before[last], last), std::pair(before[v], v));
    last = v;
  }
}

ComputeOptions compute_options_of(const StructureKind& kind, int threads) {
  ComputeOptions options;
  options.threads = threads;
  options.consumers = ConsumerPlace::host;
  options.make_structure = kind.make;
  return options;
}

/// Has what outlasts a threshold, and no more. Whether parts hang on others says whether all can be removed.
void expect_persistent_extrema(const Mesh& mesh, const std::vector<Field>& fields, const BruteForce::Table& neighbours,
                               bool hangs) {
  const auto kinds = structure_kinds();
  std::size_t turn = 0;
  for (const Field& field : fields) {
    const VertexOrder order(mesh, field.values.data(), field.values.size());
    for (const double threshold : {1e-9, 3.0, 0.3 * mesh.vertices()}) {
      SCOPED_TRACE(field.name + ", threshold " + std::to_string(threshold));
      const auto value = [&](Id vertex) { return field.values[vertex]; };
      const SimplifiedField found = simplify_field(order, value, threshold);
      expect_orderly(found, field.values);
      const auto ranks = doubles(found.rank), values = values_of(found, field.values);
      const auto minima = brute_force_extrema(false, neighbours, ranks),
                 maxima = brute_force_extrema(true, neighbours, ranks);
      EXPECT_EQ(found.minima, static_cast<Id>(minima.size()));
      EXPECT_EQ(found.maxima, static_cast<Id>(maxima.size()));
      const auto low = brute_force_persistent(false, neighbours, ranks, values, threshold),
                 high = brute_force_persistent(true, neighbours, ranks, values, threshold);
      EXPECT_EQ(found.kept_below, static_cast<Id>(minima.size() - low.size() + maxima.size() - high.size()));
      if (!hangs) EXPECT_EQ(found.kept_below, 0);
      const StructureKind& kind = kinds[turn++ % kinds.size()];
      const SimplifiedField same = simplify_field(order, value, threshold, compute_options_of(kind, 3));
      EXPECT_EQ(same.rank, found.rank) << kind.name;
      EXPECT_EQ(same.value_of, found.value_of) << kind.name;
      if (found.kept_below > 0) continue;
      const SimplifiedField again = simplify_field(
          VertexOrder(mesh, found.rank.data(), found.rank.size()), [&](Id vertex) { return values[vertex]; },
          threshold);
      EXPECT_EQ(again.rank, found.rank);
    }
  }
}

/// Has the given extrema and no others.
void expect_given_extrema(const Mesh& mesh, const std::vector<Field>& fields, const BruteForce::Table& neighbours) {
  for (const Field& field : fields) {
    SCOPED_TRACE(field.name);
    const VertexOrder order(mesh, field.values.data(), field.values.size());
    StayingExtrema staying;  // the last of each component, and some others
    for (const bool maxima : {false, true}) {
      auto& stay = maxima ? staying.maxima : staying.minima;
      stay = brute_force_persistent(maxima, neighbours, field.values, field.values, INFINITY);
      for (const Id vertex : brute_force_extrema(maxima, neighbours, field.values)) {
        if (vertex % 3 == 0 && std::count(stay.begin(), stay.end(), vertex) == 0) stay.push_back(vertex);
      }
      std::sort(stay.begin(), stay.end());
    }
    const SimplifiedField found = simplify_field(order, staying);
    expect_orderly(found, field.values);
    EXPECT_EQ(brute_force_extrema(false, neighbours, doubles(found.rank)), staying.minima);
    EXPECT_EQ(brute_force_extrema(true, neighbours, doubles(found.rank)), staying.maxima);
    EXPECT_EQ(found.kept_below, 0);
  }
}

}  // namespace

class SimplifiedFieldOf : public EveryMesh {};

TEST_P(SimplifiedFieldOf, every_mesh_has_persistent_extrema_alone) {
  expect_persistent_extrema(encode(input(), segmentation()), fields_on(input()), brute_force_of(mesh_name()).vv,
                            has_parts_that_hang(mesh_name()));
}

TEST_P(SimplifiedFieldOf, every_mesh_has_the_given_extrema_alone) {
  if (has_parts_that_hang(mesh_name())) GTEST_SKIP() << "some of their extrema can't be removed";
  expect_given_extrema(encode(input(), segmentation()), fields_on(input()), brute_force_of(mesh_name()).vv);
}

INSTANTIATE_TEST_SUITE_P(Tests, SimplifiedFieldOf, every_mesh_and_segmentations_in_turn(), mesh_and_segmentation);

class SimplifiedFieldOnSurface : public SurfaceTest {};

TEST_P(SimplifiedFieldOnSurface, has_persistent_extrema_alone) {
  for (const int capacity : {5, 100})
    expect_persistent_extrema(encode(surface(), capacity), fields_on(points_of_surface(surface())),
                              neighbours_on_surface(surface()), has_parts_that_hang(GetParam()));
}

TEST_P(SimplifiedFieldOnSurface, has_the_given_extrema_alone) {
  if (has_parts_that_hang(GetParam())) GTEST_SKIP() << "some of their extrema can't be removed";
  expect_given_extrema(encode(surface(), 20), fields_on(points_of_surface(surface())),
                       neighbours_on_surface(surface()));
}

INSTANTIATE_TEST_SUITE_P(Tests, SimplifiedFieldOnSurface, surface_names(), surface_name);

TEST(SimplifiedField, of_two_valleys_fills_the_lesser_one_up_to_the_pass) {
  InputMesh input;  // a strip of tetrahedra along 0 1 2 3 4 5 6: valleys at the ends, and a pass at 3
  for (Id i = 0; i < 7; ++i) input.points.push_back({double(i), double(i % 2), double(i % 3)});
  for (Id i = 0; i + 3 < 7; ++i) input.tetrahedra.push_back({i, i + 1, i + 2, i + 3});
  const std::vector<double> values = {0, 4, 5, 6, 3, 2, 1};
  const Mesh mesh = encode(input, 100);
  const VertexOrder order(mesh, values.data(), values.size());
  const auto value = [&](Id vertex) { return values[vertex]; };
  const SimplifiedField found = simplify_field(order, value, 3.5);
  EXPECT_EQ(found.minima, 1);
  EXPECT_EQ(found.maxima, 1);
  EXPECT_EQ(found.value_of, (std::vector<Id>{0, 1, 2, 3, 1, 1, 1}));
  EXPECT_EQ(found.rank, (std::vector<Id>{0, 1, 5, 6, 2, 4, 3})) << "from the pass to the floor, and up again";
  EXPECT_EQ(simplify_field(order, value, 3).minima, 2) << "what is as persistent as that stays";
}

TEST(SimplifiedField, of_grid_48_has_as_many_extrema_as_others_leave) {
  const io::Dataset dataset = io::make_grid(48);
  const auto& points = std::get<io::Dataset::Points<float>>(dataset.points);
  const auto& field = std::get<std::vector<float>>(dataset.arrays.front().values);
  const Mesh mesh(Tetrahedra<Id, HostMemory>(dataset.tetrahedra),
                  octree_segmentation<float, HostMemory>(Points<float, HostMemory>(points), 100));
  const auto [low, high] = std::minmax_element(field.begin(), field.end());
  const SimplifiedField found = simplify_field(
      VertexOrder(mesh, field.data(), field.size()), [&](Id vertex) { return field[vertex]; }, 0.05 * (*high - *low));
  EXPECT_EQ(found.minima, 7);
  EXPECT_EQ(found.maxima, 6);
  EXPECT_EQ(found.kept_below, 0);
}

TEST(SimplifiedField, refuses_what_is_no_extremum_and_what_leaves_none) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), 100);
  const std::vector<float> field = {7, 5, 6, 9};
  const VertexOrder order(mesh, field.data(), field.size());
  const auto message = [&](const StayingExtrema& staying) {
    return message_of([&] { simplify_field(order, staying); });
  };
  EXPECT_EQ(message({{1}, {3}}), "no error");
  EXPECT_EQ(message({{2}, {3}}), "vertex 2, which is to stay, is no minimum of the field");
  EXPECT_EQ(message({{1}, {1}}), "vertex 1, which is to stay, is no maximum of the field");
  EXPECT_EQ(message({{4}, {3}}), "vertex 4, which is to stay, is none of the mesh's 4");
  EXPECT_EQ(message({{}, {3}}), "no minimum is to stay in the component of vertex 3");
  EXPECT_EQ(message_of([&] {
              simplify_field(
                  order, [](Id) { return 0.0; }, std::nan(""));
            }),
            "the persistence nan is not 0 or more");
}

}  // namespace gale::test
