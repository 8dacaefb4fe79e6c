#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <gale/algorithms/persistence.hpp>
#include <gale/outputs/persistence.hpp>

#include "outputs/outputs_of.hpp"
#include "support/message_of.hpp"

namespace gale::test {

using outputs::threshold_of;

TEST(Persistence, a_difference_of_values_is_the_threshold_itself) {
  const io::PointArray field{"field", 1, std::vector<double>{2, 12, -std::numeric_limits<double>::infinity()}};
  EXPECT_EQ(threshold_of({0.5, false}, field), 0.5);
}

TEST(Persistence, percents_are_of_the_range) {
  EXPECT_EQ(threshold_of({20, true}, {"field", 1, std::vector<double>{2, 12, 7}}), 2);
  EXPECT_EQ(threshold_of({50, true}, {"field", 1, std::vector<std::uint8_t>{200, 100, 255}}), 77.5);
  EXPECT_EQ(threshold_of({50, true}, {"field", 1, std::vector<std::int8_t>{-128, 127}}), 127.5);
  EXPECT_EQ(threshold_of({100, true}, {"field", 1, std::vector<float>{3, 3}}), 0) << "constant";
}

TEST(Persistence, nan_is_no_part_of_the_range) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(threshold_of({10, true}, {"field", 1, std::vector<double>{nan, 1, 11, nan}}), 1);
}

TEST(Persistence, there_are_no_percents_of_an_infinite_range) {
  const io::PointArray field{"height", 1, std::vector<double>{0, std::numeric_limits<double>::infinity()}};
  EXPECT_EQ(message_of([&] {
              threshold_of({10, true}, field);
            }),
            "there are no percents of the range of 'height', which isn't finite");
}

TEST(Persistence, thresholds_are_0_or_more) {
  const io::PointArray field{"field", 1, std::vector<double>{0, 1}};
  for (const bool is_percent : {false, true}) {
    EXPECT_EQ(message_of([&] { threshold_of({-1, is_percent}, field); }), "the persistence -1 is not 0 or more");
    EXPECT_EQ(message_of([&] {
                threshold_of({std::nan(""), is_percent}, field);
              }),
              "the persistence nan is not 0 or more");
  }
}

using outputs::DiagramPoint;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Three tetrahedra in a row: two minima, 0 (value 0) and 5 (value 1), and the saddle (1, 4) of value 3 between them.
InputMesh row_of_tetrahedra() {
  InputMesh mesh;
  for (Id v = 0; v < 6; ++v) mesh.points.push_back({0.5 * v, double(v % 2), double(v % 3)});
  for (Id v = 0; v + 3 < 6; ++v) mesh.tetrahedra.push_back({v, v + 1, v + 2, v + 3});
  return mesh;
}

std::vector<DiagramPoint> diagram_of(const OutputsOf& of, double least = 0) {
  return outputs::persistence_diagram(of.complex.gradient, find_persistence_pairs(of.complex.gradient), of.field,
                                      least);
}

}  // namespace

TEST(PersistenceDiagram, of_two_minima) {
  const OutputsOf of = outputs_of(row_of_tetrahedra(), {0, 2, 4, 5, 3, 1});
  const auto diagram = diagram_of(of);
  ASSERT_EQ(diagram.size(), 2u);
  EXPECT_EQ(diagram[0].type, 0);
  EXPECT_TRUE(diagram[0].is_finite);
  EXPECT_EQ((std::vector<Id>{diagram[0].begin, diagram[0].end}), (std::vector<Id>{5, 4}));
  EXPECT_EQ(diagram[0].persistence(), 2);
  EXPECT_FALSE(diagram[1].is_finite);
  EXPECT_EQ((std::vector<Id>{diagram[1].begin, diagram[1].end}), (std::vector<Id>{0, 3})) << "the highest vertex";
  const auto counts = outputs::counts_of(diagram);
  EXPECT_EQ(counts.pairs[0], 1);
  EXPECT_EQ(counts.essential[0], 1);
  EXPECT_EQ(diagram_of(of, 2).size(), 2u);
  EXPECT_EQ(diagram_of(of, 2.1).size(), 1u) << "what never ends stays";
  EXPECT_EQ(message_of([&] { diagram_of(of, std::nan("")); }), "the persistence nan is not 0 or more");
}

TEST(PersistenceDiagram, as_lines_has_the_names_of_ttk) {
  const OutputsOf of = outputs_of(row_of_tetrahedra(), {0, 2, 4, 5, 3, 1});
  const io::Surface lines = outputs::to_lines(of.dataset, of.field, diagram_of(of));
  EXPECT_EQ(names_of(lines.point_arrays),
            (std::vector<std::string>{"Coordinates", "ttkVertexScalarField", "CriticalType"}));
  EXPECT_EQ(names_of(lines.cell_arrays),
            (std::vector<std::string>{"PairIdentifier", "PairType", "Persistence", "Birth", "IsFinite"}));
  expect_points(lines.points, {{1, 1, 0}, {1, 3, 0}, {0, 0, 0}, {0, 5, 0}});
  EXPECT_EQ(lines.lines.begin, (std::vector<std::int64_t>{0, 2, 4, 6}));
  EXPECT_EQ(lines.lines.points, (std::vector<Id>{0, 1, 2, 3, 2, 0})) << "the diagonal from the first birth to the last";
  EXPECT_EQ(values_of<Id>(lines.point_arrays, "ttkVertexScalarField"), (std::vector<Id>{5, 4, 0, 3}));
  EXPECT_EQ(values_of<std::int8_t>(lines.point_arrays, "CriticalType"), (std::vector<std::int8_t>{0, 1, 0, 3}));
  EXPECT_EQ(values_of<Id>(lines.cell_arrays, "PairIdentifier"), (std::vector<Id>{0, 1, -1}));
  EXPECT_EQ(values_of<std::int8_t>(lines.cell_arrays, "PairType"), (std::vector<std::int8_t>{0, 0, -1}));
  EXPECT_EQ(values_of<double>(lines.cell_arrays, "Persistence"), (std::vector<double>{2, 5, 4}));
  EXPECT_EQ(values_of<double>(lines.cell_arrays, "Birth"), (std::vector<double>{1, 0, 0}));
  EXPECT_EQ(values_of<std::uint8_t>(lines.cell_arrays, "IsFinite"), (std::vector<std::uint8_t>{1, 0, 0}));
  const io::PointArray floats{"field", 1, std::vector<float>{0, 2, 4, 5, 3, 1}};
  EXPECT_EQ(values_of<float>(outputs::to_lines(of.dataset, floats, diagram_of(of)).cell_arrays, "Birth"),
            (std::vector<float>{1, 0, 0}));
}

TEST(PersistenceDiagram, of_infinities_has_no_nan) {
  const OutputsOf of = outputs_of(row_of_tetrahedra(), {-infinity, 2, 4, infinity, infinity, -infinity});
  for (const DiagramPoint& point : diagram_of(of)) EXPECT_EQ(point.persistence(), infinity);
}

TEST(PersistenceCurve, counts_what_persists) {
  const auto point = [](std::int8_t type, double birth, double death, bool is_finite = true) {
    return DiagramPoint{type, is_finite, 0, 0, birth, death, 0};
  };
  const auto curve = outputs::persistence_curve(
      {point(0, 1, 3), point(0, 0, 9, false), point(1, 2, 4), point(1, 2, 2.5), point(2, 7, 7)});
  EXPECT_EQ(curve.persistence, (std::vector<double>{0, 0.5, 2}));
  EXPECT_EQ(curve.pairs[0], (std::vector<Id>{1, 1, 1}));
  EXPECT_EQ(curve.pairs[1], (std::vector<Id>{2, 2, 1}));
  EXPECT_EQ(curve.pairs[2], (std::vector<Id>{1, 0, 0}));
  EXPECT_EQ(outputs::to_csv(curve),
            "Persistence,MinimumSaddle,SaddleSaddle,SaddleMaximum,All\n0,1,2,1,4\n0.5,1,2,0,3\n2,1,1,0,2\n");
}

}  // namespace gale::test
