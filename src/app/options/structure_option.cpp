#include <CLI/CLI.hpp>

#include <gale/app/options/parse.hpp>
#include <gale/app/options/structure_option.hpp>
#include <gale/runtime/explicit/explicit_structure.hpp>
#include <gale/runtime/runtime.hpp>

namespace gale::app {

namespace {

void add_size(CLI::App& command, std::size_t& size, const std::string& name, const std::string& what) {
  const auto set = [&size, name](const std::string& text) { size = parse_size(name, text); };
  command.add_option_function<std::string>(name, set, what)->type_name("SIZE");
}

const char* name_of(Way way) {
  switch (way) {
    case Way::leaders:
      return "leaders";
    case Way::helpers:
      return "helpers";
    case Way::task_parallel:
      return "pairs";
    default:
      return "consumers";
  }
}

std::optional<std::int64_t> known(Id count) {
  return count == no_id ? std::nullopt : std::optional<std::int64_t>(count);
}

}  // namespace

void StructureOption::add_to(CLI::App& command) {
  command
      .add_option("--structure", name,
                  "gale (cores beyond --threads compute ahead), explicit (everything at once), inline (no leaders, no "
                  "helpers) or task-parallel (a worker thread for each consumer)")
      ->check(CLI::IsMember({"gale", "explicit", "inline", "task-parallel"}));
  const CLI::Range launches(1, 1048576);
  command.add_option("--blocks-per-request", runtime.blocks_per_request, "n_b")->check(launches);
  command.add_option("--threads-per-block", runtime.threads_per_block, "t_b")->check(launches);
  command.add_option("--threads-per-segment", runtime.threads_per_segment, "t_s")->check(CLI::Range(1, 1024));
  add_size(command, runtime.host_memory, "--host-memory", "Budget for blocks on the host, e.g. 512MiB");
  add_size(command, runtime.device_memory, "--device-memory", "Budget for batches on the device");
}

std::unique_ptr<Structure> StructureOption::make(const Mesh& mesh, RelationSet relations) const {
  if (is_explicit()) return std::make_unique<ExplicitStructure>(mesh, relations);
  RuntimeOptions options = runtime;
  if (name == "inline") options.way = Way::inline_;
  if (name == "task-parallel") options.way = Way::task_parallel;
  return std::make_unique<Runtime>(mesh, relations, options);
}

void report_structure(const Structure& structure, Report& report) {
  report.edges = known(structure.mesh().known_edges());
  report.triangles = known(structure.mesh().known_triangles());
  if (const auto* const all = dynamic_cast<const ExplicitStructure*>(&structure)) {
    report.edges = known(all->count(1));
    report.triangles = known(all->count(2));
  } else if (const auto* const runtime = dynamic_cast<const Runtime*>(&structure)) {
    report.production = name_of(runtime->way());
    report.statistics = runtime->statistics();
  }
}

}  // namespace gale::app
