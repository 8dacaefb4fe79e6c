#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <gale/algorithms/gradient/large_lower_star.hpp>
#include <gale/algorithms/gradient/lower_neighbours.hpp>
#include <gale/algorithms/gradient/lower_star.hpp>
#include <gale/algorithms/gradient/pair_star.hpp>

namespace gale::test {

namespace {

using detail::BitQueues;
using detail::LargeLowerStar;
using detail::LowerNeighbours;
using detail::LowerStar;
using detail::ManyLowerNeighbours;

/// A vertex (0) with neighbours 1 to n, and the triangles of its link.
struct Link {
  std::vector<std::uint64_t> keys;
  std::vector<Id> neighbours;
  std::vector<std::array<Id, 3>> triangles;                 // places, ascending
  mutable std::vector<std::array<std::uint8_t, 3>> narrow;  // places in bytes

  /// With no upper neighbours; the i-th has rank i.
  Link(Id count, std::vector<std::array<Id, 3>> all) : keys(count + 1), neighbours(count), triangles(std::move(all)) {
    keys[0] = 1000;
    for (Id i = 0; i < count; ++i) keys[neighbours[i] = i + 1] = i;
  }

  Row vv() const { return {neighbours.data(), static_cast<Id>(neighbours.size())}; }
  LinkRow link() const {
    const Id count = static_cast<Id>(triangles.size());
    if (neighbours.size() > 256) return {triangles.data(), count, 4};
    narrow.clear();
    for (const auto& [a, b, c] : triangles) narrow.push_back({std::uint8_t(a), std::uint8_t(b), std::uint8_t(c)});
    return {narrow.data(), count, 1};
  }
};

/// The lower edges, triangles, and tetrahedra; the most tetrahedra that a lower triangle has.
struct Size {
  std::size_t edges, triangles, tetrahedra, most;
  std::size_t cells() const { return edges + triangles + tetrahedra; }
};

Size size_of(const Link& link) {
  const auto is_lower = [&](Id place) { return link.keys[place + 1] < link.keys[0]; };
  std::map<std::pair<Id, Id>, std::size_t> triangles;
  std::size_t edges = 0, tetrahedra = 0, most = 0;
  for (Id i = 0; i < link.vv().size(); ++i) edges += is_lower(i);
  for (const auto& [a, b, c] : link.triangles) {
    tetrahedra += is_lower(a) && is_lower(b) && is_lower(c);
    for (const auto& side : {std::make_pair(a, b), std::make_pair(a, c), std::make_pair(b, c)}) {
      if (is_lower(side.first) && is_lower(side.second)) most = std::max(most, ++triangles[side]);
    }
  }
  return {edges, triangles.size(), tetrahedra, most};
}

/// A link of `count` neighbours, any number of them lower, and as many triangles as `tries` give of which no three
/// share a side.
Link random_link(std::mt19937& random, Id count, int tries) {
  Link link(count, {});
  std::shuffle(link.keys.begin() + 1, link.keys.end(), random);
  link.keys[0] = random() % (count + 2);
  for (std::size_t i = 1; i < link.keys.size(); ++i) link.keys[i] += link.keys[i] >= link.keys[0];
  std::set<std::array<Id, 3>> triangles;
  std::map<std::pair<Id, Id>, int> sides;
  for (int i = 0; i < tries; ++i) {
    // Near each other, so that they do share sides.
    const Id at = random() % count;
    std::array<Id, 3> t = {at, Id((at + 1 + random() % 4) % count), Id((at + 1 + random() % 4) % count)};
    std::sort(t.begin(), t.end());
    if (t[0] == t[1] || t[1] == t[2] || triangles.count(t) > 0) continue;
    const std::pair<Id, Id> of_it[] = {{t[0], t[1]}, {t[0], t[2]}, {t[1], t[2]}};
    if (std::any_of(of_it, of_it + 3, [&](const auto& side) { return sides[side] == 2; })) continue;
    for (const auto& side : of_it) ++sides[side];
    triangles.insert(t);
  }
  link.triangles.assign(triangles.begin(), triangles.end());
  std::shuffle(link.triangles.begin(), link.triangles.end(), random);
  return link;
}

/// What `pair_cells` says, one call after the other: the ranks of facet and cell, and where the tetrahedra are.
struct Step {
  std::vector<int> facet, cell;  // no facet: critical
  Id place = no_id, across = no_id;

  friend bool operator==(const Step& a, const Step& b) {
    return a.facet == b.facet && a.cell == b.cell && a.place == b.place && a.across == b.across;
  }
};

template <class Cells>
std::vector<int> corners_of(const Cells& cells, int cell) {
  std::vector<int> corners;
  for (int i = 0; i < cells.dimension(cell); ++i) corners.push_back(cells.corners(cell)[i]);
  return corners;
}

template <class Cells, class Queues>
std::vector<Step> steps(const Cells& cells, Queues&& queues) {
  std::vector<Step> all;
  const auto step = [&](const std::vector<int>& facet, int cell) {
    all.push_back({facet, corners_of(cells, cell)});
    if (cells.dimension(cell) == 3) all.back().place = cells.place(cell);
  };
  detail::pair_cells(
      queues,
      [&](int facet, int cell) {
        step(corners_of(cells, facet), cell);
        if (cells.dimension(cell) < 3) return;
        const Id across = cells.across(facet, cells.place(cell));
        all.back().across = across == Cells::no_place ? no_id : across;
      },
      [&](int cell) { step({}, cell); });
  return all;
}

std::vector<Step> steps_of_large(const Link& link) {
  ManyLowerNeighbours lower;
  lower.find(link.keys.data(), 0, link.vv());
  LargeLowerStar star;
  star.build(lower.ranks(), lower.count(), link.link(), [](Id place) { return place; });
  return steps(star, star);
}

/// False if the kind of LowerStar refuses the star.
template <class Star>
bool find_steps(const Link& link, std::vector<Step>& found) {
  LowerNeighbours lower;
  if (!lower.find(link.keys.data(), 0, link.vv())) return false;
  const auto star = std::make_unique<Star>();
  if (!star->build(lower, link.link())) return false;
  EXPECT_EQ(star->edges(), lower.count());
  EXPECT_EQ(star->cells(), static_cast<int>(size_of(link).cells()));
  found = steps(*star, BitQueues<Star>(*star));
  return true;
}

template <class Star>
bool is_refused(const Link& link) {
  std::vector<Step> found;
  return !find_steps<Star>(link, found);
}

/// A strip of triangles, of which two at most share a side.
std::vector<std::array<Id, 3>> strip(Id count) {
  std::vector<std::array<Id, 3>> triangles;
  for (Id i = 0; i + 2 < count; ++i) triangles.push_back({i, i + 1, i + 2});
  return triangles;
}

template <class Star>
class LowerStarOf : public testing::Test {};
using Stars = testing::Types<LowerStar<1>, LowerStar<2>, LowerStar<1, true>, LowerStar<2, true>>;
TYPED_TEST_SUITE(LowerStarOf, Stars);

TYPED_TEST(LowerStarOf, each_size_pairs_random_links_as_the_large_one_does) {
  constexpr std::size_t capacity = TypeParam::Cells::capacity;
  std::mt19937 random(17);
  int held = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    const Link link = random_link(random, 3 + random() % 60, random() % 150);
    const Size size = size_of(link);
    if (size.edges == 0) continue;
    std::vector<Step> found;
    const bool fits = size.edges <= TypeParam::max_edges && size.cells() <= capacity && link.triangles.size() <= 128;
    ASSERT_EQ(find_steps<TypeParam>(link, found), fits) << "link " << i;
    if (fits) ASSERT_EQ(found, steps_of_large(link)) << "link " << i;
    held += fits ? 1 : 0;
    refused += fits ? 0 : 1;
  }
  EXPECT_GT(held, 1000);
  EXPECT_GT(refused, 100);
}

TYPED_TEST(LowerStarOf, each_size_refuses_more_edges_than_it_holds) {
  for (int edges = 1; edges <= 80; ++edges) {
    EXPECT_EQ(is_refused<TypeParam>(Link(edges, {})), edges > TypeParam::max_edges) << edges << " edges";
  }
}

TYPED_TEST(LowerStarOf, each_size_refuses_more_cells_than_it_holds) {
  constexpr int words = TypeParam::Cells::capacity / 64;
  for (int edges = 3; edges <= TypeParam::max_edges; ++edges) {
    const Link link(edges, strip(edges));
    EXPECT_EQ(is_refused<TypeParam>(link), size_of(link).cells() > TypeParam::Cells::capacity) << edges << " edges";
  }
  constexpr int most = TypeParam::max_edges;
  if (words > 1) EXPECT_GT(size_of(Link(most, strip(most))).cells(), std::size_t(TypeParam::Cells::capacity));
}

TYPED_TEST(LowerStarOf, each_size_refuses_a_triangle_with_three_tetrahedra) {
  EXPECT_FALSE(is_refused<TypeParam>(Link(5, {{0, 1, 2}, {0, 1, 3}})));
  EXPECT_TRUE(is_refused<TypeParam>(Link(5, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}})));
}

TYPED_TEST(LowerStarOf, each_size_refuses_a_triangle_with_any_number_of_tetrahedra_above_two) {
  for (Id upper = 3; upper <= 126; ++upper) {
    std::vector<std::array<Id, 3>> triangles;
    for (Id i = 0; i < upper; ++i) triangles.push_back({0, 1, 2 + i});
    Link link(2 + upper, triangles);
    for (Id i = 0; i < upper; ++i) link.keys[3 + i] = 2000;
    EXPECT_TRUE(is_refused<TypeParam>(link)) << upper;
  }
}

TYPED_TEST(LowerStarOf, each_size_counts_upper_tetrahedra_of_a_lower_triangle_too) {
  Link link(5, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  link.keys[4] = link.keys[5] = 2000;  // places 3 and 4
  EXPECT_TRUE(is_refused<TypeParam>(link));
}

TEST(LargeLowerStar, of_three_lower_neighbours_in_one_tetrahedron_has_the_pairs_that_a_reader_finds) {
  // Key order: 0, 1, 10, 2, 20, 21, 210. The vertex has edge 0; 10 has 1, 20 has 2, and 210 has 21.
  const std::vector<Step> expected = {{{1}, {1, 0}}, {{2}, {2, 0}}, {{2, 1}, {2, 1, 0}, 0, no_id}};
  const Link link(3, {{0, 1, 2}});
  std::vector<Step> found;
  EXPECT_EQ(steps_of_large(link), expected);
  ASSERT_TRUE(find_steps<LowerStar<1>>(link, found));
  EXPECT_EQ(found, expected);
}

TEST(LargeLowerStar, finds_the_tetrahedron_of_the_lowest_number_across_a_triangle) {
  const Link link(6, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 5}});
  const std::vector<Id> ranks = {0, 1, 2, 3, 4, 5}, numbers = {40, 30, 10, 20};
  LargeLowerStar star;
  star.build(ranks, 6, link.link(), [&](Id place) { return numbers[place]; });
  const int triangle = 2;  // cells: 0, 1, 10, 2 ...
  ASSERT_EQ(corners_of(star, triangle), (std::vector<int>{1, 0}));
  EXPECT_EQ(star.across(triangle, 0), 2);
  EXPECT_EQ(star.across(triangle, 1), 2);
  EXPECT_EQ(star.across(triangle, 2), 3);
  EXPECT_EQ(star.across(triangle, 3), 2);
}

TEST(LargeLowerStar, of_triangles_has_the_pairs_and_the_triangles_of_edges_that_a_reader_finds) {
  // Neighbours 0, 1 and 2 are lower, 3 is not. Key order: 0, 1, 10, 2, 20. Three triangles share the edge to 0.
  const std::array<Id, 2> places[] = {{0, 3}, {0, 1}, {0, 2}};
  const std::vector<Id> ranks = {0, 1, 2, no_id}, numbers = {30, 10, 20};
  LargeLowerStar star;
  star.build(ranks, 3, {places, 3, 4, 2}, [&](Id place) { return numbers[place]; });
  std::vector<std::pair<int, int>> pairs;
  detail::pair_cells(
      star,
      [&](int facet, int cell) {
        pairs.push_back({facet, cell});
      },
      [](int cell) { FAIL() << cell; });
  EXPECT_EQ(pairs, (std::vector<std::pair<int, int>>{{1, 2}, {3, 4}}));
  EXPECT_EQ(corners_of(star, 4), (std::vector<int>{2, 0}));
  EXPECT_EQ(star.place(2), 1);
  EXPECT_EQ(star.place(4), 2);
  std::vector<Id> of_edge;
  star.for_each_place(0, [&](Id place) { of_edge.push_back(place); });
  EXPECT_EQ(of_edge, (std::vector<Id>{0, 1, 2}));
  EXPECT_EQ(star.across(0, 1), 2);
  EXPECT_EQ(star.across(0, 2), 1);
  EXPECT_EQ(star.across(1, 1), LargeLowerStar::no_place);
}

TEST(LargeLowerStar, serves_again_after_a_larger_star) {
  std::mt19937 random(4);
  ManyLowerNeighbours lower;
  LargeLowerStar star;
  for (const Id count : {500, 20, 3, 100, 1}) {
    const Link link = random_link(random, std::max(count, 3), 3 * count);
    if (size_of(link).edges == 0) continue;
    lower.find(link.keys.data(), 0, link.vv());
    star.build(lower.ranks(), lower.count(), link.link(), [](Id place) { return place; });
    EXPECT_EQ(steps(star, star), steps_of_large(link));
  }
}

TEST(LowerNeighbours, are_those_that_sorting_finds) {
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    const Link link = random_link(random, 3 + random() % 140, 0);
    LowerNeighbours few;
    ManyLowerNeighbours many;
    many.find(link.keys.data(), 0, link.vv());
    const bool fits = link.vv().size() <= LowerNeighbours::max_neighbours && many.count() <= LowerNeighbours::max_lower;
    ASSERT_EQ(few.find(link.keys.data(), 0, link.vv()), fits);
    std::vector<std::uint64_t> lower;
    for (const Id neighbour : link.neighbours) {
      if (link.keys[neighbour] < link.keys[0]) lower.push_back(link.keys[neighbour]);
    }
    std::sort(lower.begin(), lower.end());
    ASSERT_EQ(many.count(), static_cast<int>(lower.size()));
    for (int rank = 0; rank < many.count(); ++rank) {
      const Id place = many.place(many.with_rank(rank));
      ASSERT_EQ(link.keys[link.neighbours[place]], lower[rank]);
      ASSERT_EQ(many.ranks()[place], rank);
    }
    if (!fits) continue;
    ASSERT_EQ(few.count(), many.count());
    for (int rank = 0; rank < few.count(); ++rank) {
      ASSERT_EQ(few.place(rank), many.place(rank));
      ASSERT_EQ(few.with_rank(rank), many.with_rank(rank));
    }
    for (Id place = 0; place < link.vv().size(); ++place) {
      ASSERT_EQ(few.ranks()[place] == LowerNeighbours::none ? no_id : few.ranks()[place], many.ranks()[place]);
    }
  }
}

}  // namespace

}  // namespace gale::test
