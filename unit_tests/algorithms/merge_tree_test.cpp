#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <gale/algorithms/merge_tree.hpp>
#include <gale/base/error.hpp>
#include <gale/base/ordered.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/mesh/make_mesh.hpp>

#include "algorithms/brute_force_trees.hpp"
#include "algorithms/fields.hpp"
#include "algorithms/structure_kinds.hpp"
#include "algorithms/surface_cases.hpp"
#include "support/every_mesh.hpp"
#include "support/message_of.hpp"

namespace gale::test {

namespace {

const std::vector<Tree> all_trees = {Tree::join, Tree::split, Tree::contour};

const char* name_of(Tree tree) { return tree == Tree::join ? "join" : tree == Tree::split ? "split" : "contour"; }

void expect_same(const MergeTree& tree, const MergeTree& expected) {
  EXPECT_EQ(tree.vertices, expected.vertices);
  EXPECT_EQ(tree.types, expected.types);
  EXPECT_EQ(tree.arcs, expected.arcs);
  EXPECT_EQ(tree.arc_of, expected.arc_of);
}

MergeTreeOptions options_of(const StructureKind& kind, int threads) {
  MergeTreeOptions options;
  options.threads = threads;
  options.consumers = ConsumerPlace::host;
  options.make_structure = kind.make;
  return options;
}

/// All trees of a mesh, by every structure, by kernels and alone, are those of brute force.
void expect_trees(const Mesh& mesh, const std::vector<Field>& fields, const BruteForce::Table& neighbours,
                  const std::vector<Tree>& trees = all_trees) {
  for (const Field& field : fields) {
    const VertexOrder order(mesh, field.values.data(), field.values.size());
    std::vector<MergeTree> expected;
    for (const Tree tree : all_trees) expected.push_back(brute_force_tree(tree, neighbours, field.values));
    const auto expect_all = [&](const std::array<MergeTree, 3>& found, const std::string& by) {
      for (const Tree tree : trees) {
        SCOPED_TRACE(by + ", " + field.name + ", " + name_of(tree));
        expect_same(found[static_cast<int>(tree)], expected[static_cast<int>(tree)]);
      }
    };
    for (const auto& kind : structure_kinds()) {
      for (const int threads : {1, 3})
        expect_all(find_merge_trees(order, options_of(kind, threads)), kind.name + " on " + std::to_string(threads));
    }
    expect_all(find_merge_trees(WorkerSpace(), order), "kernels");
    expect_all({find_merge_tree(order, Tree::join), find_merge_tree(order, Tree::split),
                find_merge_tree(order, Tree::contour)},
               "each alone");
  }
}

/// Join and split trees, simplified, have the extrema that brute force finds persistent, and no regular nodes.
void expect_simplified_trees(const Mesh& mesh, const std::vector<Field>& fields, const BruteForce::Table& neighbours) {
  for (const Field& field : fields) {
    const VertexOrder order(mesh, field.values.data(), field.values.size());
    for (const double threshold : {1e-9, 3.0, 40.0}) {
      MergeTreeOptions options;
      options.threshold = threshold;
      options.value = [&](Id vertex) { return field.values[vertex]; };
      for (const Tree tree : {Tree::join, Tree::split}) {
        SCOPED_TRACE(field.name + ", " + name_of(tree) + ", threshold " + std::to_string(threshold));
        const bool is_split = tree == Tree::split;
        const auto whole = find_merge_tree(order, tree), simplified = find_merge_tree(order, tree, options);
        std::vector<Id> leaves, arcs_at(simplified.vertices.size(), 0), ahead = arcs_at;
        Id on_arcs = 0;
        for (const MergeArc& arc : simplified.arcs) {
          EXPECT_LT(arc.lower, arc.upper);
          ++(is_split ? arcs_at[arc.lower] : arcs_at[arc.upper]);
          ++(is_split ? ahead[arc.upper] : ahead[arc.lower]);
          on_arcs += arc.size;
        }
        EXPECT_EQ(on_arcs + static_cast<Id>(simplified.vertices.size()), mesh.vertices());
        for (std::size_t node = 0; node < arcs_at.size(); ++node) {
          if (arcs_at[node] == 0) leaves.push_back(simplified.vertices[node]);
          EXPECT_TRUE(arcs_at[node] != 1 || ahead[node] == 0) << "no node is regular";
          EXPECT_LE(ahead[node], 1);
          EXPECT_NE(std::count(whole.vertices.begin(), whole.vertices.end(), simplified.vertices[node]), 0);
        }
        std::sort(leaves.begin(), leaves.end());
        EXPECT_EQ(leaves, brute_force_persistent(is_split, neighbours, field.values, field.values, threshold));
      }
    }
  }
}

}  // namespace

class MergeTreesOf : public EveryMesh {};

TEST_P(MergeTreesOf, every_mesh_are_those_of_brute_force_however_computed) {
  expect_trees(encode(input(), segmentation()), fields_on(input()), brute_force_of(mesh_name()).vv);
}

TEST_P(MergeTreesOf, every_mesh_have_the_extrema_that_are_persistent) {
  expect_simplified_trees(encode(input(), segmentation()), fields_on(input()), brute_force_of(mesh_name()).vv);
}

INSTANTIATE_TEST_SUITE_P(Tests, MergeTreesOf, every_mesh_and_segmentations_in_turn(), mesh_and_segmentation);

class MergeTreesOnSurfaces : public SurfaceTest {};

TEST_P(MergeTreesOnSurfaces, are_those_of_brute_force_however_computed) {
  for (const int capacity : {5, 100})
    expect_trees(encode(surface(), capacity), fields_on(points_of_surface(surface())),
                 neighbours_on_surface(surface()));
}

TEST_P(MergeTreesOnSurfaces, have_the_extrema_that_are_persistent) {
  expect_simplified_trees(encode(surface(), 50), fields_on(points_of_surface(surface())),
                          neighbours_on_surface(surface()));
}

INSTANTIATE_TEST_SUITE_P(Tests, MergeTreesOnSurfaces, surface_names(), surface_name);

/// Contour trees aren't compared: with holes, where a vertex belongs may depend on which leaf is pruned first.
TEST(MergeTree, of_any_triangles_are_those_of_brute_force) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const InputSurface surface = random_surface(seed);
    const Field field{"random", random_field(points_of_surface(surface), seed)};
    expect_trees(encode(surface, 8), {field}, neighbours_on_surface(surface), {Tree::join, Tree::split});
  }
}

/// Nodes that join and split trees leave without an arc hang on others there.
TEST(MergeTree, of_level_sets_is_one_for_each_component_where_a_mesh_has_holes_too) {
  constexpr Id around = 8, across = 2;
  InputSurface ring;
  for (Id i = 0; i < across; ++i) {
    for (Id j = 0; j < around; ++j) {
      const double angle = 6.283185307179586 * j / around, radius = 1.0 + i;
      ring.points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
  }
  for (Id j = 0; j < around; ++j) {
    const Id next = (j + 1) % around;
    ring.triangles.push_back({j, around + j, around + next});
    ring.triangles.push_back({j, around + next, next});
  }
  const auto expect_trees_of_components = [](const InputSurface& surface, const std::vector<double>& field) {
    const auto neighbours = neighbours_on_surface(surface);
    const Mesh mesh = encode(surface, 8);
    const MergeTree tree = find_merge_tree(VertexOrder(mesh, field.data(), field.size()), Tree::contour);
    const auto components = [](std::vector<Id> parents, const auto& visit_pairs) {
      std::size_t count = parents.size();
      visit_pairs([&](Id a, Id b) {
        const Id one = root_of(parents, a), other = root_of(parents, b);
        count -= one != other;
        parents[one] = other;
      });
      return count;
    };
    std::vector<Id> each(std::max(tree.vertices.size(), neighbours.size()));
    std::iota(each.begin(), each.end(), Id(0));
    const auto of_mesh = components({each.begin(), each.begin() + static_cast<std::ptrdiff_t>(neighbours.size())},
                                    [&](const auto& visit) {
                                      for (std::size_t v = 0; v < neighbours.size(); ++v)
                                        for (const Id other : neighbours[v]) visit(static_cast<Id>(v), other);
                                    });
    const auto of_tree = components({each.begin(), each.begin() + static_cast<std::ptrdiff_t>(tree.vertices.size())},
                                    [&](const auto& visit) {
                                      for (const MergeArc& arc : tree.arcs) visit(arc.lower, arc.upper);
                                    });
    EXPECT_EQ(of_tree, of_mesh);
    EXPECT_EQ(tree.arcs.size() + of_mesh, tree.vertices.size()) << "no loops";
    Id on_arcs = 0;
    for (const MergeArc& arc : tree.arcs) on_arcs += arc.size;
    EXPECT_EQ(on_arcs + static_cast<Id>(tree.vertices.size()), mesh.vertices());
    for (std::size_t v = 0; v < neighbours.size(); ++v) EXPECT_EQ(tree.arc_of[v] == no_id, neighbours[v].empty()) << v;
  };
  expect_trees_of_components(ring, {2, 11, 3, 10, 0, 4, 7, 5, 14, 12, 6, 9, 13, 8, 1, 15});
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    expect_trees_of_components(ring, random_field(points_of_surface(ring), seed));
    const InputSurface any = random_surface(seed);
    expect_trees_of_components(any, random_field(points_of_surface(any), seed));
  }
}

TEST(MergeTree, of_two_valleys_joins_them_at_the_pass) {
  // A strip of tetrahedra along 0 1 2 3 4 5 6: valleys at the ends, and a pass at 3.
  InputMesh input;
  for (Id i = 0; i < 7; ++i) input.points.push_back({double(i), double(i % 2), double(i % 3)});
  for (Id i = 0; i + 3 < 7; ++i) input.tetrahedra.push_back({i, i + 1, i + 2, i + 3});
  const std::vector<double> field = {0, 4, 5, 6, 3, 2, 1};
  const Mesh mesh = encode(input, 100);
  const VertexOrder order(mesh, field.data(), field.size());
  const MergeTree tree = find_merge_tree(order, Tree::join);
  EXPECT_EQ(tree.vertices, (std::vector<Id>{0, 6, 1, 3}));
  EXPECT_EQ(tree.types, (std::vector<CriticalType>{CriticalType::minimum, CriticalType::minimum, CriticalType::saddle1,
                                                   CriticalType::maximum}));
  EXPECT_EQ(tree.arcs, (std::vector<MergeArc>{{0, 2, 0}, {1, 2, 2}, {2, 3, 1}}));
  EXPECT_EQ(tree.arc_of, (std::vector<Id>{0, 2, 2, 2, 1, 1, 1}));

  MergeTreeOptions options;
  options.value = [&](Id vertex) { return field[vertex]; };
  options.threshold = 3;
  EXPECT_EQ(find_merge_tree(order, Tree::join, options).arcs.size(), 3u) << "what is as persistent as that stays";
  options.threshold = 3.5;
  const MergeTree simplified = find_merge_tree(order, Tree::join, options);
  EXPECT_EQ(simplified.vertices, (std::vector<Id>{0, 3}));
  EXPECT_EQ(simplified.arcs, (std::vector<MergeArc>{{0, 1, 5}}));
  EXPECT_EQ(simplified.arc_of, (std::vector<Id>(7, 0)));
}

TEST(MergeTree, of_grid_48_has_as_many_nodes_as_others_find) {
  const io::Dataset dataset = io::make_grid(48);
  const auto& points = std::get<io::Dataset::Points<float>>(dataset.points);
  const auto& field = std::get<std::vector<float>>(dataset.arrays.front().values);
  const Mesh mesh(Tetrahedra<Id, HostMemory>(dataset.tetrahedra),
                  octree_segmentation<float, HostMemory>(Points<float, HostMemory>(points), 100));
  const auto trees = find_merge_trees(VertexOrder(mesh, field.data(), field.size()));
  const std::size_t nodes[] = {122, 118, 238};
  for (int tree = 0; tree < 3; ++tree) {
    EXPECT_EQ(trees[tree].vertices.size(), nodes[tree]);
    EXPECT_EQ(trees[tree].arcs.size(), nodes[tree] - 1);
  }
}

TEST(MergeTree, asks_for_a_threshold_that_is_a_number_and_for_values) {
  const Mesh mesh = encode(mesh_named("one_tetrahedron"), 100);
  const std::vector<float> field = {7, 5, 6, 9};
  const VertexOrder order(mesh, field.data(), field.size());
  MergeTreeOptions options;
  options.threshold = 1;
  EXPECT_EQ(message_of([&] { find_merge_tree(order, Tree::join, options); }),
            "a tree simplified by persistence needs the field's values");
  options.threshold = std::nan("");
  EXPECT_EQ(message_of([&] { find_merge_tree(order, Tree::join, options); }), "the persistence nan is not 0 or more");
}

}  // namespace gale::test
