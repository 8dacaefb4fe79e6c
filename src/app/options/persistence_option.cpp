#include <CLI/CLI.hpp>

#include <gale/app/options/parse.hpp>
#include <gale/app/options/persistence_option.hpp>
#include <gale/base/error.hpp>

namespace gale::app {

void add_persistence(CLI::App& app, std::optional<outputs::Persistence>& persistence, const std::string& what) {
  const auto set = [&persistence](const std::string& text) { persistence = parse_persistence("--persistence", text); };
  app.add_option_function<std::string>("--persistence", set, what)->type_name("X[%]");
}

double threshold_of_option(const outputs::Persistence& persistence, const io::PointArray& field) {
  try {
    return outputs::threshold_of(persistence, field);
  } catch (const Error& error) {
    throw Error(std::string("--persistence: ") + error.what());
  }
}

}  // namespace gale::app
