#include <set>

#include <gtest/gtest.h>

#include <gale/outputs/analyses.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/tracks.hpp>

#include "outputs/outputs_of.hpp"
#include "support/message_of.hpp"

/// Analyses find what their descriptions say.
namespace gale::test {

namespace {

using outputs::Analysis;
using outputs::AnalysisArray;
using outputs::AnalysisOption;
using outputs::AnalysisResult;
using outputs::Settings;

OutputsOf of_octahedron() { return outputs_of(octahedron(), {10, 5, -5, 1, 2, 3, 4}); }

/// On values that come when they are waited for, and not before.
std::map<std::string, outputs::Outcome> run(const Analysis& analysis, const Settings& settings) {
  const OutputsOf of = of_octahedron();
  io::Dataset dataset = of.dataset;
  io::PointArray field = of.field;
  const auto await = [&] {
    dataset.arrays = of.dataset.arrays;
    field = of.field;
  };
  for (io::PointArray& array : dataset.arrays) array.values = {};
  field.values = {};
  const auto next = [](const char*, double begin, double end) {
    EXPECT_LT(begin, end);
    return ComputeOptions();
  };
  return analysis.run({dataset, field, of.complex.gradient.order(), next, await}, settings);
}

/// With all that can be asked for.
Settings all_settings_of(const Analysis& analysis) {
  Settings settings;
  for (const AnalysisOption& option : analysis.options) {
    if (option.kind == AnalysisOption::Kind::flag) settings.flags[option.name] = true;
    if (option.kind == AnalysisOption::Kind::threshold) settings.thresholds[option.name] = {0.5, false};
    if (option.kind == AnalysisOption::Kind::choice) settings.choices[option.name] = option.choices.back();
    if (option.kind == AnalysisOption::Kind::number) settings.numbers[option.name] = 3;
  }
  return settings;
}

template <class T>
bool holds(const io::PointArray& array) {
  return std::holds_alternative<std::vector<T>>(array.values);
}

/// Field and points of the octahedron are of double.
void expect_as_described(const std::vector<io::PointArray>& arrays, const std::vector<AnalysisArray>& described) {
  ASSERT_GE(arrays.size(), described.size());
  const std::size_t before = arrays.size() - described.size();  // arrays of the input
  for (std::size_t i = 0; i < described.size(); ++i) {
    const io::PointArray& array = arrays[before + i];
    const std::string& type = described[i].type;
    const std::string& name = described[i].name;
    EXPECT_EQ(array.name, name.rfind("NAME", 0) == 0 ? "field" + name.substr(4) : name);
    EXPECT_EQ(array.components, described[i].components) << array.name;
    EXPECT_TRUE(type == "int8"    ? holds<std::int8_t>(array)
                : type == "uint8" ? holds<std::uint8_t>(array)
                : type == "int32" ? holds<Id>(array)
                                  : holds<double>(array))
        << array.name << " isn't of " << type;
  }
}

void expect_as_described(const outputs::Outcome& outcome, const AnalysisResult& result) {
  using Shape = AnalysisResult::Shape;
  switch (result.shape) {
    case Shape::points:
      return expect_as_described(std::get<io::PointSet>(outcome).arrays, result.point_arrays);
    case Shape::lines:
    case Shape::polygons:
      expect_as_described(std::get<io::Surface>(outcome).point_arrays, result.point_arrays);
      return expect_as_described(std::get<io::Surface>(outcome).cell_arrays, result.cell_arrays);
    case Shape::diagram: {
      const auto& diagram = std::get<std::vector<outputs::DiagramPoint>>(outcome);
      const OutputsOf of = of_octahedron();
      const io::Surface lines = outputs::to_lines(of.dataset, of.field, diagram);
      expect_as_described(lines.point_arrays, result.point_arrays);
      return expect_as_described(lines.cell_arrays, result.cell_arrays);
    }
    case Shape::mesh:
    case Shape::table:
      return expect_as_described(std::get<std::vector<io::PointArray>>(outcome), result.point_arrays);
    case Shape::count:
      EXPECT_GE(std::get<Id>(outcome), 0);
  }
}

}  // namespace

TEST(Analyses, have_names_of_their_own_and_help) {
  std::set<std::string> names;
  for (const Analysis& analysis : outputs::analyses()) {
    EXPECT_TRUE(names.insert(analysis.name).second) << analysis.name;
    EXPECT_EQ(&outputs::analysis_named(analysis.name), &analysis);
    EXPECT_GT(analysis.help.size(), 20u);
    for (const AnalysisOption& option : analysis.options) EXPECT_GT(option.help.size(), 20u) << option.name;
    for (std::size_t i = 1; i < analysis.results.size(); ++i) {
      if (analysis.results[i - 1].shape == AnalysisResult::Shape::count)
        EXPECT_EQ(analysis.results[i].shape, AnalysisResult::Shape::count) << "counts have no ports: they come last";
    }
  }
  EXPECT_EQ(message_of([] { outputs::analysis_named("pairs"); }), "there is no analysis 'pairs'");
}

TEST(Analyses, find_all_results_that_they_describe) {
  for (const Analysis& analysis : outputs::analyses()) {
    SCOPED_TRACE(analysis.name);
    const auto found = run(analysis, all_settings_of(analysis));
    EXPECT_EQ(found.size(), analysis.results.size());
    for (const AnalysisResult& result : analysis.results) {
      ASSERT_EQ(found.count(result.name), 1u) << result.name;
      expect_as_described(found.at(result.name), result);
    }
  }
}

TEST(Analyses, of_steps_are_as_described) {
  const OutputsOf of = of_octahedron();
  ExtremumTracker tracker;
  outputs::TrackLines lines;
  for (const double time : {0.0, 1.0}) {
    tracker.add(time, of.complex.gradient, [&](Id v) { return outputs::value_at(of.field, v); });
    lines.add(of.dataset, of.field, tracker.tracks());
  }
  const Analysis& tracking = outputs::tracking();
  ASSERT_EQ(tracking.results.size(), 2u);
  expect_as_described(lines.lines(tracker.tracks()), tracking.results[0]);
  const auto table = outputs::track_table(tracker.tracks());
  EXPECT_EQ(table.size(), tracking.results[1].point_arrays.size());
  expect_as_described(table, tracking.results[1]);
}

TEST(Analyses, find_by_default_what_no_flag_asks_for) {
  for (const Analysis& analysis : outputs::analyses()) {
    const auto found = run(analysis, {});
    for (const AnalysisResult& result : analysis.results) {
      const bool is_expected = result.only_with.empty() || analysis.option(result.only_with).is_on;
      EXPECT_EQ(found.count(result.name) == 1, is_expected) << result.name;
    }
  }
}

TEST(Analyses, refuse_options_that_they_have_not) {
  const Analysis& complexes = outputs::analysis_named("morse-smale");
  EXPECT_EQ(message_of([&] { run(complexes, {{{"arrows", true}}, {}}); }), "morse-smale has no option 'arrows'");
  EXPECT_EQ(message_of([&] {
              run(complexes, {{{"persistence", true}}, {}});
            }),
            "morse-smale's option 'persistence' is no switch");
  EXPECT_EQ(message_of([&] {
              run(complexes, {{}, {{"extrema_only", {1, false}}}});
            }),
            "morse-smale's option 'extrema_only' is no threshold");
  const Analysis& trees = outputs::analysis_named("merge-tree");
  EXPECT_EQ(message_of([&] {
              run(trees, {{}, {}, {{"type", "oak"}}, {}});
            }),
            "merge-tree's option 'type' is one of contour, join, split, not 'oak'");
  EXPECT_EQ(message_of([&] {
              run(trees, {{}, {}, {}, {{"arc_samples", -1}}});
            }),
            "merge-tree's option 'arc_samples' is at least 0, not -1");
}

}  // namespace gale::test
