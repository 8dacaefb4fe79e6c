#include <limits>
#include <map>
#include <set>

#include <gale/algorithms/simplify.hpp>

#include "algorithms/complexes.hpp"
#include "support/segmentations.hpp"

namespace gale::test {

namespace {

/// The path that goes on from a cell to a destination, and that cell's place on it.
template <class Cell>
using Ways = std::map<std::pair<Id, Cell>, std::pair<Id, Offset>>;

/// Whole paths, put together from joined ones.
template <class Cell>
Separatrices<Cell> put_together(const Separatrices<Cell>& joined) {
  Separatrices<Cell> whole;
  Ways<Cell> ways;
  whole.is_only = joined.is_only;
  for (Id i = 0; i < joined.count(); ++i) {
    const Id destination = joined.destinations[i];
    whole.sources.push_back(joined.sources[i]);
    whole.destinations.push_back(destination);
    for (const Cell* cell = joined.first(i); cell != joined.last(i); ++cell) {
      const bool is_joint = !joined.is_whole(i) && cell + 1 == joined.last(i);
      if (is_joint) {
        const auto way = ways.find({destination, *cell});
        if (way == ways.end()) {
          ADD_FAILURE() << "path " << i << " joins none";
          continue;
        }
        const auto [path, place] = way->second;
        const std::vector<Cell> rest(whole.first(path) + place, whole.last(path));
        whole.cells.insert(whole.cells.end(), rest.begin(), rest.end());
      } else {
        whole.cells.push_back(*cell);
      }
    }
    whole.begin.push_back(static_cast<Offset>(whole.cells.size()));
    for (const Cell* cell = whole.first(i); cell != whole.last(i); ++cell)
      ways.emplace(std::make_pair(destination, *cell), std::make_pair(i, Offset(cell - whole.first(i))));
  }
  return whole;
}

/// How many cells are there that an earlier path to the same destination has, joints and destinations aside.
template <class Cell>
int told_twice(const Separatrices<Cell>& paths) {
  std::set<std::pair<Id, Cell>> told;
  int twice = 0;
  for (Id i = 0; i < paths.count(); ++i) {
    for (const Cell* cell = paths.first(i); cell + 1 < paths.last(i); ++cell)
      twice += !told.insert({paths.destinations[i], *cell}).second;
  }
  return twice;
}

template <class Cell>
void expect_same(const Separatrices<Cell>& joined, const Separatrices<Cell>& whole) {
  const Separatrices<Cell> together = put_together(joined);
  EXPECT_EQ(together.sources, whole.sources);
  EXPECT_EQ(together.destinations, whole.destinations);
  EXPECT_EQ(together.is_only, whole.is_only);
  EXPECT_EQ(together.begin, whole.begin);
  EXPECT_EQ(together.cells, whole.cells);
  EXPECT_EQ(told_twice(joined), 0);
}

/// Compares paths of all three kinds in a complex simplified both ways; returns how many cells less there are.
std::size_t expect_joined(const ComplexOf& found, double threshold, bool extrema_only) {
  const auto value = [&](Id v) { return found.field().at(v); };
  SimplifyOptions options;
  options.extrema_only = extrema_only;
  const MorseSmaleComplex whole = simplify(found.complex(), value, threshold, options);
  options.paths = Paths::joined;
  const MorseSmaleComplex joined = simplify(found.complex(), value, threshold, options);
  expect_same(joined.descending, whole.descending);
  expect_same(joined.ascending, whole.ascending);
  expect_same(joined.connectors, whole.connectors);
  const auto cells = [](const MorseSmaleComplex& complex) {
    return complex.descending.cells.size() + complex.ascending.cells.size() + complex.connectors.cells.size();
  };
  EXPECT_EQ(joined.critical.counts(), whole.critical.counts());
  EXPECT_LE(cells(joined), cells(whole));
  return cells(whole) - cells(joined);
}

}  // namespace

class JoinedPathsOf : public testing::TestWithParam<std::string> {};

TEST_P(JoinedPathsOf, every_field_are_the_whole_ones) {
  const InputMesh& input = mesh_named(GetParam());
  auto fields = fields_on(input);
  fields.push_back({"noise", random_field(input, 7)});
  for (const Field& field : fields) {
    const ComplexOf found(input, field.values);
    for (const double threshold : {0.0, 0.1 * input.vertices(), std::numeric_limits<double>::infinity()}) {
      for (const bool extrema_only : {false, true}) {
        SCOPED_TRACE(field.name + ", threshold " + std::to_string(threshold));
        expect_joined(found, threshold, extrema_only);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tests, JoinedPathsOf,
                         testing::Values("the_papers", "slivers", "ball", "seven_on_one_triangle"),
                         [](const auto& info) { return info.param; });

TEST(JoinedPaths, of_noise_are_few) {
  const InputMesh input = holed_grid(12);
  const ComplexOf found(input, random_field(input, 3));
  const auto value = [&](Id v) { return found.field().at(v); };
  EXPECT_GT(expect_joined(found, 0.2 * input.vertices(), true), 5u * input.vertices());
  SimplifyOptions options;
  options.extrema_only = true;
  options.paths = Paths::joined;
  const MorseSmaleComplex left = simplify(found.complex(), value, 0.2 * input.vertices(), options);
  EXPECT_LE(left.descending.cells.size(), static_cast<std::size_t>(input.vertices() + left.descending.count()));
}

}  // namespace gale::test
