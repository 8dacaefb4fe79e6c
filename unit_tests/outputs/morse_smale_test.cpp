#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/manifolds.hpp>
#include <gale/outputs/morse_smale.hpp>
#include <gale/outputs/separatrices1.hpp>
#include <gale/outputs/separatrices2.hpp>

#include "outputs/outputs_of.hpp"

namespace gale::test {

using outputs::MorseSmaleRequest;

namespace {

constexpr MorseSmaleParts everything{true, true, true, true, true, true};
const std::vector<double> up_to_the_centre{10, 5, -5, 1, 2, 3, 4};  ///< of the octahedron

outputs::MorseSmaleOutputs all_of(const OutputsOf& of, const MorseSmaleRequest& request) {
  return outputs::morse_smale(of.complex.gradient, of.dataset, of.field, request);
}

}  // namespace

TEST(MorseSmaleRequest, needs_connectors_for_walls_and_to_cancel_saddles) {
  MorseSmaleRequest request;
  request.parts.saddle_connectors = false;
  EXPECT_FALSE(request.needed_parts().saddle_connectors);
  request.persistence = outputs::Persistence{3, true};
  EXPECT_TRUE(request.needed_parts().saddle_connectors);
  request.extrema_only = true;
  EXPECT_FALSE(request.needed_parts().saddle_connectors);
  request.parts.separatrices2 = true;
  EXPECT_TRUE(request.needed_parts().saddle_connectors);
}

TEST(MorseSmaleOutputs, are_those_of_each_function) {
  const OutputsOf of = outputs_of(octahedron(), up_to_the_centre);
  const auto all = all_of(of, {everything, {}, false});
  const auto lines = outputs::separatrices1(of.dataset, of.field, of.complex, of.named, of.numbers, of.critical);
  const auto walls = outputs::separatrices2(of.dataset, of.field, of.complex, of.complex.connectors, of.critical);
  EXPECT_EQ(all.separatrices1.lines.points, lines.lines.points);
  EXPECT_EQ(all.separatrices2.polygons.points, walls.polygons.points);
  EXPECT_EQ(values_of<Id>(all.critical_points.arrays, "ManifoldSize"), (std::vector<Id>{7, 0, 7}));
  EXPECT_EQ(values_of<Id>(all.critical_points.arrays, "CellId"),
            values_of<Id>(outputs::to_point_set(of.dataset, of.critical).arrays, "CellId"));
  EXPECT_EQ(all.manifolds.size(), 3u);
  EXPECT_EQ(all.kept_below.count(), 0);
}

TEST(MorseSmaleOutputs, leave_out_what_is_not_wanted) {
  const OutputsOf of = outputs_of(octahedron(), up_to_the_centre);
  MorseSmaleRequest request{everything, {}, false};
  request.parts.saddle_connectors = request.parts.descending_separatrices = request.parts.ascending_separatrices =
      false;
  request.parts.ascending_manifolds = false;
  const auto all = all_of(of, request);
  EXPECT_TRUE(all.separatrices1.lines.points.empty());
  EXPECT_EQ(all.separatrices2.polygons.points, all_of(of, {everything, {}, false}).separatrices2.polygons.points)
      << "walls are where they are without connectors";
  EXPECT_EQ(names_of(all.manifolds), (std::vector<std::string>{"DescendingManifold"}));
}

TEST(MorseSmaleOutputs, of_what_persists) {
  const OutputsOf of = outputs_of(octahedron(), up_to_the_centre);
  const auto dimensions_at = [&](const outputs::Persistence& persistence) {
    const auto all = all_of(of, {everything, persistence, false});
    return values_of<std::int8_t>(all.critical_points.arrays, "CellDimension");
  };
  const std::vector<std::int8_t> all{0, 2, 3}, simple{0};  // the maximum's value is 10, that of its saddle 5, of 15
  EXPECT_EQ(dimensions_at({5, false}), all);
  EXPECT_EQ(dimensions_at({5.5, false}), simple);
  EXPECT_EQ(dimensions_at({33, true}), all);
  EXPECT_EQ(dimensions_at({34, true}), simple);
}

}  // namespace gale::test
