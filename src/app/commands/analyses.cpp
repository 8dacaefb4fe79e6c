#include <nlohmann/json.hpp>

#include <gale/app/commands/command.hpp>
#include <gale/outputs/analyses.hpp>

namespace gale::app {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const outputs::AnalysisOption& option) {
  static const char* const kinds[] = {"flag", "threshold", "choice", "number", "axis"};
  return {{"name", option.name},         {"kind", kinds[static_cast<int>(option.kind)]},
          {"is_on", option.is_on},       {"choices", option.choices},
          {"property", option.property}, {"has_own_file", option.has_own_file},
          {"help", option.help}};
}

Json to_json(const std::vector<outputs::AnalysisArray>& arrays) {
  Json all = Json::array();
  for (const auto& array : arrays)
    all.push_back({{"name", array.name}, {"type", array.type}, {"components", array.components}});
  return all;
}

Json to_json(const outputs::AnalysisResult& result) {
  static const char* const shapes[] = {"points", "lines", "polygons", "diagram", "mesh", "count", "table"};
  return {{"name", result.name},
          {"shape", shapes[static_cast<int>(result.shape)]},
          {"help", result.help},
          {"only_with", result.only_with},
          {"point_arrays", to_json(result.point_arrays)},
          {"cell_arrays", to_json(result.cell_arrays)}};
}

Json to_json(const outputs::Analysis& analysis) {
  Json one{{"name", analysis.name}, {"help", analysis.help}, {"options", Json::array()}, {"results", Json::array()}};
  for (const auto& option : analysis.options) one["options"].push_back(to_json(option));
  for (const auto& result : analysis.results) one["results"].push_back(to_json(result));
  return one;
}

}  // namespace

std::string analyses_as_json() {
  Json all = Json::array();
  for (const outputs::Analysis& analysis : outputs::analyses()) all.push_back(to_json(analysis));
  all.push_back(to_json(outputs::tracking()));
  return all.dump(2);
}

}  // namespace gale::app
