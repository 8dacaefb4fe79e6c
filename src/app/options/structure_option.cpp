#include <CLI/CLI.hpp>

#include <gale/app/options/parse.hpp>
#include <gale/app/options/structure_option.hpp>
#include <gale/app/usage_error.hpp>
#include <gale/base/error.hpp>
#include <gale/baselines/task_parallel_structure.hpp>
#include <gale/runtime/make_structure.hpp>

namespace gale::app {

namespace {

void add_size(CLI::App& command, std::size_t& size, const std::string& name, const std::string& what) {
  const auto set = [&size, name](const std::string& text) { size = parse_size(name, text); };
  command.add_option_function<std::string>(name, set, what)->type_name("SIZE");
}

std::optional<std::int64_t> known(Id count) {
  return count == no_id ? std::nullopt : std::optional<std::int64_t>(count);
}

}  // namespace

void StructureOption::set(const std::string& named) {
  name = named;
  if (const auto way = way_named(name))
    options.structure.way = *way;
  else
    options.make_structure = baselines::make_task_parallel_structure;
}

void StructureOption::add_to(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--structure", [this](const std::string& named) { set(named); },
          "gale (leaders on a device, else helpers), leaders (threads that have batches computed ahead), helpers "
          "(cores beyond --threads compute ahead), inline (no leaders, no helpers), explicit (everything at "
          "once) or task-parallel (a worker thread for each consumer)")
      ->check(CLI::IsMember({"gale", "leaders", "helpers", "inline", "explicit", "task-parallel"}));
  command
      .add_option("--cores", options.structure.cores,
                  "Cores that threads and helpers share (default: as many as threads)")
      ->check(CLI::Range(1, 1024));
  command
      .add_option_function<std::string>(
          "--queues",
          [this](const std::string& one) {
            options.structure.queues = one == "relation" ? Queues::per_relation : Queues::per_kernel;
          },
          "Of leaders: one for each kernel (default), which may make several relations, or for each relation")
      ->check(CLI::IsMember({"kernel", "relation"}));
  const CLI::Range launches(1, 1048576);
  command.add_option("--blocks-per-request", options.structure.blocks_per_request, "n_b")->check(launches);
  command.add_option("--threads-per-block", options.structure.threads_per_block, "t_b")->check(launches);
  command.add_option("--threads-per-segment", options.structure.threads_per_segment, "t_s")->check(CLI::Range(1, 1024));
  add_size(command, options.structure.host_memory, "--host-memory", "Budget for blocks on the host, e.g. 512MiB");
  add_size(command, options.structure.device_memory, "--device-memory", "Budget for batches on the device");
}

void StructureOption::add_consumers_to(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--consumers",
          [this](const std::string& place) {
            options.consumers = place == "device" ? ConsumerPlace::device : ConsumerPlace::host;
          },
          "Where rows are read: by threads of the host, or by kernels on the device, where they are made "
          "(default: the device if there is one, with --structure gale)")
      ->check(CLI::IsMember({"host", "device"}));
}

void StructureOption::require_consumers() const {
  try {
    gale::require_consumers(options);
  } catch (const Error& error) {
    throw UsageError(std::string("--consumers device: ") + error.what());
  }
}

std::unique_ptr<Structure> StructureOption::make(const Mesh& mesh, RelationSet relations) const {
  return options.make_structure ? options.make_structure(mesh, relations)
                                : make_structure(mesh, relations, options.structure);
}

void report_structure(const Structure& structure, Report& report) {
  report.edges = known(structure.count(1));
  report.triangles = known(structure.count(2));
  report.way = structure.name();
  const StructureStatistics statistics = structure.statistics();
  if (structure.way() != Way::explicit_) report.statistics = statistics;
}

}  // namespace gale::app
