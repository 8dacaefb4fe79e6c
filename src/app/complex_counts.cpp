#include <string>
#include <vector>

#include <gale/app/complex_counts.hpp>

namespace gale::app {

namespace {

using Json = nlohmann::ordered_json;

/// How many there are of something; reported as null where that is switched off.
struct Count {
  const char *name, *key;
  bool is_on;
  std::int64_t count;
};

/// Says the counts of one kind in one line, and reports them under `key`.
void tell(const std::string& title, const char* key, const std::vector<Count>& counts, const Console& console,
          Report& report) {
  Json json = Json::object();  // at once: the library crashes where memory for a later one lacks
  std::string said;
  for (const Count& one : counts) {
    json[one.key] = one.is_on ? Json(one.count) : Json(nullptr);
    if (one.is_on) said += (said.empty() ? "" : ", ") + grouped(one.count) + ' ' + one.name;
  }
  if (!said.empty()) console.say(title, said);
  report.result[key] = json;
}

}  // namespace

void tell(const ComplexCounts& counts, const MorseSmaleParts& wanted, const Console& console, Report& report) {
  tell("1-separatrices", "separatrices",
       {{"descending", "descending", wanted.descending_separatrices, counts.descending},
        {"ascending", "ascending", wanted.ascending_separatrices, counts.ascending},
        {"saddle connectors", "saddle_connectors", wanted.saddle_connectors, counts.connectors}},
       console, report);
  tell("manifolds", "manifolds",
       {{"ascending", "ascending", wanted.ascending_manifolds, counts.ascending_manifolds},
        {"descending", "descending", wanted.descending_manifolds, counts.descending_manifolds},
        {"Morse-Smale", "morse_smale", wanted.ascending_manifolds && wanted.descending_manifolds,
         counts.morse_smale_manifolds}},
       console, report);
}

}  // namespace gale::app
