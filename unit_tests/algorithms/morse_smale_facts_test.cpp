#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "algorithms/complexes.hpp"
#include "support/voxel_shapes.hpp"

// What every Morse-Smale complex has, simplified or not, whatever the gradient.

namespace gale::test {

namespace {

Simplex in_both(const Simplex& a, const Simplex& b) {
  Simplex both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

bool is_face(const Simplex& face, const Simplex& of) {
  return std::includes(of.begin(), of.end(), face.begin(), face.end());
}

/// A mesh of which no triangle has three tetrahedra, with a random field.
struct Case {
  ComplexOf found;
  BruteForceGradient gradient;

  explicit Case(const InputMesh& input)
      : found(input, random_field(input, 17)), gradient(found.input(), found.field()) {}

  const NamedComplex& all() const { return found.all(); }
  double highest(const Simplex& simplex) const {
    double value = found.field()[simplex[0]];
    for (const Id v : simplex) value = std::max(value, found.field()[v]);
    return value;
  }
};

InputMesh mesh_of(const std::string& name) {
  return name == "ball"          ? ball(6)
         : name == "solid_torus" ? solid_torus(6)
         : name == "thick_shell" ? thick_shell(6)
                                 : holed_grid(8);
}

void expect_numbered_by_pair(const NamedComplex& complex) {
  std::map<Id, std::pair<Simplex, Simplex>> pair_of;
  std::set<std::pair<Simplex, Simplex>> pairs;
  for (std::size_t v = 0; v < complex.morse_smale_manifold.size(); ++v) {
    const Id number = complex.morse_smale_manifold[v];
    ASSERT_EQ(number == no_id, complex.ascending_manifold[v].empty());
    if (number == no_id) continue;
    const auto pair = std::make_pair(complex.ascending_manifold[v], complex.descending_manifold[v]);
    ASSERT_EQ(pair_of.emplace(number, pair).first->second, pair) << "two pairs have the number " << number;
    pairs.insert(pair);
  }
  EXPECT_EQ(pairs.size(), pair_of.size()) << "a pair has two numbers";
  if (!pair_of.empty()) EXPECT_EQ(pair_of.rbegin()->first, static_cast<Id>(pair_of.size()) - 1) << "they have gaps";
}

void expect_among(const std::vector<Simplex>& manifold, const std::vector<Simplex>& extrema) {
  const std::set<Simplex> left(extrema.begin(), extrema.end());
  for (const Simplex& extremum : manifold) ASSERT_TRUE(extremum.empty() || left.count(extremum) == 1);
}

/// Do consecutive cells have that many vertices in common, with an edge of the mesh between vertices?
void expect_neighbours(const std::vector<NamedComplex::Path>& paths, std::size_t common,
                       const std::set<Simplex>& edges) {
  for (const auto& path : paths) {
    for (std::size_t i = 1; i < path.cells.size(); ++i) {
      const Simplex &a = path.cells[i - 1], &b = path.cells[i];
      if (common == 0) {
        ASSERT_EQ(edges.count({std::min(a[0], b[0]), std::max(a[0], b[0])}), 1u);
      } else {
        ASSERT_EQ(in_both(a, b).size(), common);
      }
    }
  }
}

/// What simplified complexes have too.
void expect_facts(const Case& of, const NamedComplex& complex) {
  std::set<Simplex> edges;
  for (const auto& corners : of.found.input().tetrahedra) {
    for (const Id a : corners) {
      for (const Id b : corners) edges.insert({std::min(a, b), std::max(a, b)});
    }
  }
  std::map<Simplex, int> falling, rising;
  for (const auto& path : complex.descending) {
    ++falling[path.source];
    ASSERT_EQ(path.cells.back(), path.destination);
    ASSERT_TRUE(is_face(path.cells.front(), path.source));
  }
  for (const Simplex& edge : complex.critical[1]) EXPECT_EQ(falling[edge], 2);
  for (const auto& path : complex.ascending) {
    EXPECT_LE(++rising[path.source], 2);
    ASSERT_EQ(path.cells.back(), path.destination);
    ASSERT_TRUE(is_face(path.source, path.cells.front()));
  }
  for (const auto& path : complex.connectors) {
    ASSERT_EQ(path.cells.back(), path.destination);
    ASSERT_TRUE(is_face(path.source, path.cells.front()));
  }
  expect_neighbours(complex.descending, 0, edges);
  expect_neighbours(complex.connectors, 2, edges);
  expect_neighbours(complex.ascending, 3, edges);
  EXPECT_EQ(complex.descending_manifold.size(), of.found.input().points.size());
  EXPECT_EQ(std::count(complex.descending_manifold.begin(), complex.descending_manifold.end(), Simplex()), 0);
  expect_among(complex.descending_manifold, complex.critical[0]);
  expect_among(complex.ascending_manifold, complex.critical[3]);
  expect_numbered_by_pair(complex);
}

class MorseSmaleFacts : public testing::TestWithParam<std::string> {
 protected:
  const Case& of() const { return case_; }
  const NamedComplex& all() const { return of().all(); }

 private:
  const Case case_{mesh_of(GetParam())};
};

TEST_P(MorseSmaleFacts, hold) { expect_facts(of(), all()); }

TEST_P(MorseSmaleFacts, descending_separatrices_fall) {
  for (const auto& path : all().descending) {
    for (std::size_t i = 1; i < path.cells.size(); ++i) {
      ASSERT_LT(of().highest(path.cells[i]), of().highest(path.cells[i - 1]));
    }
  }
}

TEST_P(MorseSmaleFacts, vertices_are_in_the_manifold_of_what_they_fall_to) {
  for (Id v = 0; v < of().found.input().vertices(); ++v) {
    const auto edge = of().gradient.partner.find({v});
    if (edge == of().gradient.partner.end()) {
      EXPECT_EQ(all().descending_manifold[v], (Simplex{v}));
    } else {
      const Id next = edge->second[0] == v ? edge->second[1] : edge->second[0];
      EXPECT_LT(of().found.field()[next], of().found.field()[v]);
      EXPECT_EQ(all().descending_manifold[v], all().descending_manifold[next]);
    }
  }
}

TEST_P(MorseSmaleFacts, connectors_are_rising_paths_of_the_gradient) {
  for (const auto& path : all().connectors) {
    for (std::size_t i = 1; i < path.cells.size(); ++i) {
      ASSERT_EQ(of().gradient.partner.at(path.cells[i - 1]), in_both(path.cells[i - 1], path.cells[i]));
      ASSERT_LE(of().highest(path.cells[i - 1]), of().highest(path.cells[i]));
    }
  }
}

TEST_P(MorseSmaleFacts, walls_begin_at_their_saddle_and_go_on_over_gradient_pairs) {
  const auto& partner = of().gradient.partner;
  for (const auto& wall : all().descending_walls) {
    ASSERT_EQ(wall.cells.front(), wall.source);
    std::set<Simplex> edges;
    for (const Simplex& triangle : wall.cells) {
      if (triangle != wall.source) ASSERT_EQ(edges.count(partner.at(triangle)), 1u);
      for (const Id v : triangle) {
        Simplex edge = triangle;
        edge.erase(std::find(edge.begin(), edge.end(), v));
        edges.insert(edge);
      }
    }
  }
  for (const auto& wall : all().ascending_walls) {
    ASSERT_EQ(wall.cells.front(), wall.source);
    for (const Simplex& edge : wall.cells) {
      ASSERT_TRUE(edge == wall.source || std::any_of(wall.cells.begin(), wall.cells.end(), [&](const Simplex& other) {
                    return other != edge && is_face(other, partner.at(edge));
                  }));
    }
  }
}

TEST_P(MorseSmaleFacts, polygons_go_around_their_edge) {
  std::map<Simplex, std::size_t> place;
  for (const auto& corners : of().found.input().tetrahedra) {
    Simplex tetrahedron(corners.begin(), corners.end());
    std::sort(tetrahedron.begin(), tetrahedron.end());
    place.emplace(tetrahedron, place.size());
  }
  for (const auto& wall : all().ascending_walls) {
    for (std::size_t i = 0; i < wall.cells.size(); ++i) {
      const auto& polygon = wall.polygons[i];
      ASSERT_FALSE(polygon.empty());
      std::map<Simplex, int> sides;  // how many of the tetrahedra have each triangle of the edge
      std::size_t gaps = 0;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        ASSERT_TRUE(is_face(wall.cells[i], polygon[k]));
        for (const Id v : polygon[k]) {
          Simplex triangle = polygon[k];
          triangle.erase(std::find(triangle.begin(), triangle.end(), v));
          if (is_face(wall.cells[i], triangle)) ++sides[triangle];
        }
        if (k > 0 && in_both(polygon[k - 1], polygon[k]).size() != 3) ++gaps;
      }
      const auto ends = std::count_if(sides.begin(), sides.end(), [](const auto& side) { return side.second == 1; });
      EXPECT_EQ(gaps, ends == 0 ? 0u : ends / 2 - 1) << "as many as pieces but one";
      if (ends == 0 && polygon.size() > 2) {
        EXPECT_EQ(in_both(polygon.front(), polygon.back()).size(), 3u);
        EXPECT_EQ(polygon.front(), *std::min_element(polygon.begin(), polygon.end(), [&](const auto& a, const auto& b) {
                    return place.at(a) < place.at(b);
                  }));
        EXPECT_LT(place.at(polygon[1]), place.at(polygon.back()));
      }
      if (ends == 2 && polygon.size() > 1) EXPECT_LT(place.at(polygon.front()), place.at(polygon.back()));
    }
  }
}

TEST_P(MorseSmaleFacts, hold_after_simplification) {
  const double size = of().found.input().vertices();
  for (const double threshold : {0.1 * size, 0.5 * size, size}) {
    SCOPED_TRACE(threshold);
    expect_facts(of(), of().found.simplified(threshold));
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, MorseSmaleFacts, testing::Values("ball", "solid_torus", "thick_shell", "holed_grid"),
                         [](const auto& info) { return info.param; });

}  // namespace

}  // namespace gale::test
