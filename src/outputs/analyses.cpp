#include <algorithm>
#include <utility>

#include <gale/base/error.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/outputs/analyses.hpp>
#include <gale/outputs/arrows.hpp>
#include <gale/outputs/critical_points.hpp>
#include <gale/outputs/critical_simplices.hpp>
#include <gale/outputs/excerpt.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/merge_tree.hpp>
#include <gale/outputs/morse_smale.hpp>
#include <gale/outputs/simplified_field.hpp>

namespace gale::outputs {

namespace {

using Found = std::map<std::string, Outcome>;
using Kind = AnalysisOption::Kind;
using Shape = AnalysisResult::Shape;

const AnalysisArray on_boundary{"IsOnBoundary", "int8"}, vertex{"ttkVertexScalarField", "int32"},
    dimension{"CellDimension", "int8"}, cell{"CellId", "int32"};

const std::vector<AnalysisArray> critical_arrays{dimension, cell, on_boundary, vertex};

/// Cell arrays of separatrices: lines have a destination, polygons none.
std::vector<AnalysisArray> separatrix_arrays(bool has_destination) {
  std::vector<AnalysisArray> arrays{{"SourceId", "int32"},
                                    {"DestinationId", "int32"},
                                    {"SeparatrixId", "int32"},
                                    {"SeparatrixType", "int8"},
                                    {"SeparatrixFunctionMaximum", "field"},
                                    {"SeparatrixFunctionMinimum", "field"},
                                    {"SeparatrixFunctionDifference", "field"},
                                    {"NumberOfCriticalPointsOnBoundary", "int32"}};
  if (!has_destination) arrays.erase(arrays.begin() + 1);
  return arrays;
}

void await_values(const AnalysisInput& input) {
  if (input.await) input.await();
}

Analysis critical_points() {
  Analysis analysis{"critical-points", "Finds the critical points of a scalar field", {}, {}, {}};
  analysis.results = {{"critical_points",
                       Shape::points,
                       "vertices, by type: 0 minimum, 1 and 2 saddles, 3 maximum, 4 degenerate",
                       {{"CriticalType", "int8"}, on_boundary, vertex},
                       {},
                       {}}};
  analysis.find = [](const AnalysisInput& input, const Settings&, Computed& computed) -> Found {
    const ComputeOptions options = input.next("Finding critical points", 0, 1);
    const CriticalPoints points = find_critical_points(input.order, options, &computed);
    await_values(input);
    return {{"critical_points", to_point_set(input.dataset, points, input.order.mesh().exchange())}};
  };
  return analysis;
}

Analysis discrete_gradient() {
  Analysis analysis{"discrete-gradient",
                    "Pairs the simplices of a mesh along a scalar field; finds those that are left, the critical ones",
                    {},
                    {},
                    {}};
  analysis.options = {{"arrows", Kind::flag, false, "",
                       "The gradient's arrows, from the barycentre of each simplex to that of the one it is paired "
                       "with: .vtp. Large: a point a pair, some 13 a vertex",
                       true}};
  analysis.results = {{"critical_simplices",
                       Shape::points,
                       "the simplices that are paired with no other, at their middles",
                       critical_arrays,
                       {},
                       {}},
                      {"arrows",
                       Shape::points,
                       "the pairs, at the middles of their lower simplices",
                       {dimension, {"Vector", "points", 3}},
                       {},
                       "arrows"}};
  analysis.find = [](const AnalysisInput& input, const Settings& settings, Computed& computed) {
    const DiscreteGradient gradient =
        find_discrete_gradient(input.order, input.next("Pairing simplices", 0, 0.7), &computed);
    const CriticalSimplices& critical = gradient.critical();
    const SimplexNumbers numbers = number_simplices(gradient.mesh(), {critical.edges, critical.triangles},
                                                    input.next("Numbering simplices", 0.7, 1), &computed);
    await_values(input);
    Found found;
    found["critical_simplices"] =
        to_point_set(input.dataset, known_simplices(gradient, critical, numbers), gradient.mesh().exchange());
    if (settings.flags.at("arrows")) found["arrows"] = arrows_of(input.dataset, gradient);
    return found;
  };
  return analysis;
}

/// The threshold that is given; none: 0.
double threshold_in(const AnalysisInput& input, const Settings& settings) {
  const auto given = settings.thresholds.find("persistence");
  if (given == settings.thresholds.end()) return 0;
  await_values(input);
  return threshold_of(given->second, input.field, input.order.mesh().exchange().ranks());
}

Analysis persistence_diagrams() {
  Analysis analysis{"persistence-diagram",
                    "Pairs the critical simplices of a scalar field: which topological features it has, and how "
                    "persistent they are",
                    {},
                    {},
                    {}};
  analysis.options = {{"persistence", Kind::threshold, false, "Persistence",
                       "Leave out pairs whose values differ by less than this; with a % of the field's range"}};
  analysis.results = {{"diagram",
                       Shape::diagram,
                       "a line for each pair and each class that never ends, and the diagonal",
                       {{"Coordinates", "points", 3}, vertex, {"CriticalType", "int8"}},
                       {{"PairIdentifier", "int32"},
                        {"PairType", "int8"},
                        {"Persistence", "field"},
                        {"Birth", "field"},
                        {"IsFinite", "uint8"}},
                       {}}};
  analysis.find = [](const AnalysisInput& input, const Settings& settings, Computed& computed) -> Found {
    const double threshold = threshold_in(input, settings);
    input.order.bring_keys_to_host();
    const DiscreteGradient gradient =
        find_discrete_gradient(input.order, input.next("Pairing simplices", 0, 0.6), &computed);
    const PersistencePairs pairs = find_persistence_pairs(gradient, input.next("Finding pairs", 0.6, 1));
    await_values(input);
    return {{"diagram", persistence_diagram(gradient, pairs, input.field, threshold)}};
  };
  return analysis;
}

std::vector<AnalysisResult> results_of_complexes() {
  std::vector<AnalysisArray> critical = critical_arrays;
  critical.push_back({"ManifoldSize", "int32"});
  const std::vector<AnalysisArray> manifolds{
      {"AscendingManifold", "int32"}, {"DescendingManifold", "int32"}, {"MorseSmaleManifold", "int32"}};
  return {{"critical_points", Shape::points, "the critical simplices, at their middles", critical, {}, {}},
          {"separatrices1",
           Shape::lines,
           "the lines that join them",
           {{"ttkMaskScalarField", "int8"}, dimension, cell},
           separatrix_arrays(true),
           {}},
          {"separatrices2", Shape::polygons, "the walls of saddles", {}, separatrix_arrays(false), "separatrices2"},
          {"manifolds", Shape::mesh, "the numbers of each vertex's manifolds, -1 where it has none", manifolds, {}, {}},
          {"kept_below", Shape::count, "pairs of saddles below the threshold that could not be cancelled", {}, {}, {}}};
}

Analysis morse_smale_complexes() {
  Analysis analysis{"morse-smale",
                    "Finds the Morse-Smale complex of a scalar field: critical simplices, separatrices, segmentation",
                    {},
                    results_of_complexes(),
                    {}};
  for (const PartOfComplex& part : parts_of_complexes)
    analysis.options.push_back({part.option, Kind::flag, MorseSmaleParts().*part.is_wanted, part.property, part.help});
  analysis.options.push_back({"persistence", Kind::threshold, false, "Persistence",
                              "Cancel pairs of critical simplices whose values differ by less than this; with a % of "
                              "the field's range"});
  analysis.options.push_back({"extrema_only", Kind::flag, false, "ExtremaOnly",
                              "With persistence: cancel minima and maxima, but no saddles with one another"});
  analysis.find = [](const AnalysisInput& input, const Settings& settings, Computed& computed) {
    MorseSmaleRequest request;
    for (const PartOfComplex& part : parts_of_complexes) request.parts.*part.is_wanted = settings.flags.at(part.option);
    request.extrema_only = settings.flags.at("extrema_only");
    const auto threshold = settings.thresholds.find("persistence");
    if (threshold != settings.thresholds.end()) request.persistence = threshold->second;
    const DiscreteGradient gradient =
        find_discrete_gradient(input.order, input.next("Pairing simplices", 0, 0.6), &computed);
    await_values(input);
    MorseSmaleOutputs all = morse_smale(gradient, input.dataset, input.field, request,
                                        input.next("Tracing the complex", 0.6, 1), &computed);
    Found found;
    found["critical_points"] = std::move(all.critical_points);
    found["separatrices1"] = std::move(all.separatrices1);
    if (request.parts.separatrices2) found["separatrices2"] = std::move(all.separatrices2);
    found["manifolds"] = std::move(all.manifolds);
    found["kept_below"] = all.kept_below.count();
    return found;
  };
  return analysis;
}

std::vector<AnalysisResult> results_of_trees() {
  const AnalysisArray size{"RegionSize", "int32"}, span{"RegionSpan", "points"}, scalar{"Scalar", "field"},
      segment{"SegmentationId", "int32"};
  return {
      {"nodes",
       Shape::points,
       "the vertices where arcs begin, meet and end",
       {{"NodeId", "int32"}, scalar, {"VertexId", "int32"}, {"CriticalType", "int8"}, size, span},
       {},
       {}},
      {"arcs",
       Shape::lines,
       "the lines between them",
       {scalar, {"RegularMask", "int8"}},
       {segment, {"upNodeId", "int32"}, {"downNodeId", "int32"}, size, span},
       {}},
      {"segmentation", Shape::mesh, "the arc of each vertex", {segment, {"RegionType", "int8"}, size, span}, {}, {}}};
}

Analysis merge_trees() {
  Analysis analysis{
      "merge-tree",
      "Finds the join, split or contour tree of a scalar field: how components of what is below, above or "
      "at a value appear, meet and end",
      {},
      results_of_trees(),
      {}};
  analysis.options = {{"type",
                       Kind::choice,
                       false,
                       "TreeType",
                       "Which tree: of level sets (contour), of what is below a value (join) or above it (split)",
                       false,
                       {"contour", "join", "split"}},
                      {"persistence", Kind::threshold, false, "Persistence",
                       "Leave out branches whose values differ by less than this; with a % of the field's range"},
                      {"arc_samples", Kind::number, false, "ArcSamples",
                       "Draw arcs over at most so many points between their ends: barycentres of their vertices"}};
  analysis.find = [](const AnalysisInput& input, const Settings& settings, Computed& computed) -> Found {
    await_values(input);
    MergeTreeOptions options;
    static_cast<ComputeOptions&>(options) = input.next("Finding the tree", 0, 1);
    options.threshold = threshold_in(input, settings);
    options.value = [&](Id vertex) { return value_at(input.field, vertex); };
    const MergeTree tree = find_merge_tree(input.order, tree_named(settings.choices.at("type")), options, &computed);
    const Mesh& mesh = input.order.mesh();
    const AtExcerpt at(tree.excerpt ? *tree.excerpt : mesh, mesh, input.dataset, input.field);
    const int samples = settings.numbers.at("arc_samples");
    const auto gathered = gather_arc_vertices(mesh, input.dataset, input.field, tree, samples);
    MergeTree nothing;  // what the others have of nodes and arcs
    nothing.excerpt = tree.excerpt;
    const MergeTree& told = mesh.exchange().ranks().rank() == 0 ? tree : nothing;
    return {{"nodes", tree_nodes(at.dataset(), at.field(), told)},
            {"arcs", tree_arcs(at.dataset(), at.field(), told, samples, gathered)},
            {"segmentation", tree_segmentation(at.dataset(), tree)}};
  };
  return analysis;
}

Analysis simplified_fields() {
  Analysis analysis{
      "simplify-field", "Removes the minima and maxima of a scalar field that are of little persistence", {}, {}, {}};
  analysis.options = {{"persistence", Kind::threshold, false, "Persistence",
                       "Remove minima and maxima of less persistence than this; with a % of the field's range"}};
  analysis.results = {
      {"field", Shape::mesh, "the field without them", {{"NAME", "field"}, {"NAME_Order", "int32"}}, {}, {}},
      {"minima", Shape::count, "minima that are left", {}, {}, {}},
      {"maxima", Shape::count, "maxima that are left", {}, {}, {}},
      {"kept_below", Shape::count, "extrema below the threshold that could not be removed", {}, {}, {}}};
  analysis.find = [](const AnalysisInput& input, const Settings& settings, Computed& computed) -> Found {
    await_values(input);
    const SimplifiedField simplified = simplify_field(
        input.order, [&](Id vertex) { return value_at(input.field, vertex); }, threshold_in(input, settings),
        input.next("Simplifying the field", 0, 1), &computed);
    const Mesh& mesh = input.order.mesh();
    const AtExcerpt at(simplified.excerpt ? *simplified.excerpt : mesh, mesh, input.dataset, input.field, true);
    return {{"field", simplified_arrays(at.field(), simplified)},
            {"minima", simplified.minima},
            {"maxima", simplified.maxima},
            {"kept_below", simplified.kept_below}};
  };
  return analysis;
}

}  // namespace

const std::vector<Analysis>& analyses() {
  static const std::vector<Analysis> all{critical_points(),      discrete_gradient(), morse_smale_complexes(),
                                         persistence_diagrams(), merge_trees(),       simplified_fields()};
  return all;
}

const Analysis& analysis_named(const std::string& name) {
  for (const Analysis& analysis : analyses()) {
    if (analysis.name == name) return analysis;
  }
  throw Error("there is no analysis '" + name + "'");
}

const Analysis& tracking() {
  static const Analysis analysis{
      "track",
      "Follows the minima and maxima of a scalar field through the steps of a series",
      {{"persistence", Kind::threshold, false, "",
        "Leave out extrema whose persistence in a step is less than this; with a % of that step's range"},
       {"table", Kind::flag, false, "", "Write how each track begins and ends", true},
       {"lift", Kind::axis, false, "", "Add the time, or SCALE times that, to a coordinate of the lines"}},
      {{"lines",
        Shape::lines,
        "a line through time for each track, merge and split",
        {{"TrackId", "int32"},
         {"Step", "int32"},
         {"Time", "double"},
         {"CriticalType", "int8"},
         vertex,
         {"NAME", "field"},
         {"Persistence", "field"}},
        {{"TrackId", "int32"}, {"CriticalType", "int8"}, {"LinkType", "int8"}},
        {}},
       {"table",
        Shape::table,
        "how each track begins and ends",
        {{"TrackId", "int32"},
         {"CriticalType", "int8"},
         {"FirstStep", "int32"},
         {"LastStep", "int32"},
         {"FirstTime", "double"},
         {"LastTime", "double"},
         {"Begin", "int8"},
         {"BeginTrack", "int32"},
         {"End", "int8"},
         {"EndTrack", "int32"},
         {"FirstVertex", "int32"},
         {"LastVertex", "int32"},
         {"Persistence", "double"}},
        {},
        {}}},
      {}};
  return analysis;
}

const AnalysisOption& Analysis::option(const std::string& option_name) const {
  for (const AnalysisOption& option : options) {
    if (option.name == option_name) return option;
  }
  throw Error(name + " has no option '" + option_name + "'");
}

std::map<std::string, Outcome> Analysis::run(const AnalysisInput& input, Settings settings) const {
  const auto require = [this](const std::string& given, Kind kind) -> const AnalysisOption& {
    static const char* const names[] = {"switch", "threshold", "choice", "number"};
    const AnalysisOption& known = option(given);
    if (known.kind != kind) throw Error(name + "'s option '" + given + "' is no " + names[static_cast<int>(kind)]);
    return known;
  };
  for (const auto& [given, is_on] : settings.flags) require(given, Kind::flag);
  for (const auto& [given, threshold] : settings.thresholds) require(given, Kind::threshold);
  for (const auto& [given, chosen] : settings.choices) {
    const auto& choices = require(given, Kind::choice).choices;
    if (std::find(choices.begin(), choices.end(), chosen) != choices.end()) continue;
    throw Error(name + "'s option '" + given + "' is one of " + io::detail::joined(choices, ", ") + ", not '" + chosen +
                "'");
  }
  for (const auto& [given, number] : settings.numbers) {
    require(given, Kind::number);
    if (number < 0) throw Error(name + "'s option '" + given + "' is at least 0, not " + std::to_string(number));
  }
  for (const AnalysisOption& one : options) {
    if (one.kind == Kind::flag) settings.flags.emplace(one.name, one.is_on);
    if (one.kind == Kind::choice) settings.choices.emplace(one.name, one.choices.front());
    if (one.kind == Kind::number) settings.numbers.emplace(one.name, 0);
  }
  if (!find) throw Error(name + " has several fields, one after the other: ExtremumTracker takes them");
  Computed computed;
  return find(input, settings, computed);
}

}  // namespace gale::outputs
