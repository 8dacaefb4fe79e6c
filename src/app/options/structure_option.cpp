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

void StructureOption::add_to(CLI::App& command) {
  command
      .add_option(
          "--structure", name,
          "gale (leaders on a device, else helpers), leaders (threads that have batches computed ahead), helpers "
          "(cores beyond --threads compute ahead), inline (no leaders, no helpers), explicit (everything at "
          "once) or task-parallel (a worker thread for each consumer)")
      ->check(CLI::IsMember({"gale", "leaders", "helpers", "inline", "explicit", "task-parallel"}));
  command.add_option("--cores", options.cores, "Cores that threads and helpers share (default: as many as threads)")
      ->check(CLI::Range(1, 1024));
  command
      .add_option_function<std::string>(
          "--queues",
          [this](const std::string& one) {
            options.queues = one == "relation" ? Queues::per_relation : Queues::per_kernel;
          },
          "Of leaders: one for each kernel (default), which may make several relations, or for each relation")
      ->check(CLI::IsMember({"kernel", "relation"}));
  const CLI::Range launches(1, 1048576);
  command.add_option("--blocks-per-request", options.blocks_per_request, "n_b")->check(launches);
  command.add_option("--threads-per-block", options.threads_per_block, "t_b")->check(launches);
  command.add_option("--threads-per-segment", options.threads_per_segment, "t_s")->check(CLI::Range(1, 1024));
  add_size(command, options.host_memory, "--host-memory", "Budget for blocks on the host, e.g. 512MiB");
  add_size(command, options.device_memory, "--device-memory", "Budget for batches on the device");
}

void StructureOption::add_consumers_to(CLI::App& command) {
  command
      .add_option("--consumers", consumers,
                  "Where rows are read: by threads of the host, or by kernels on the device, where they are made "
                  "(default: the device if there is one, with --structure gale)")
      ->check(CLI::IsMember({"host", "device"}));
}

void StructureOption::require_consumers() const {
  if (consumers != "device") return;
  if (!have_device) throw UsageError("--consumers device: this gale has no device");
  if (way_named(name) != Way::gale)
    throw UsageError("--consumers device: --structure " + name + " computes rows for the host");
}

bool StructureOption::on_device(const Mesh& mesh) const {
  if (consumers != "device") return consumers.empty() && way_named(name) == Way::gale && mesh.on_device();
  if (!mesh.on_device()) throw Error("--consumers device: " + mesh.notice());
  return true;
}

DeviceSweepOptions StructureOption::device_sweep() const {
  DeviceSweepOptions sweep;
  sweep.memory = options.device_memory;
  sweep.threads_per_segment = options.threads_per_segment;
  return sweep;
}

std::unique_ptr<Structure> StructureOption::make(const Mesh& mesh, RelationSet relations) const {
  if (name == "task-parallel") return baselines::make_task_parallel_structure(mesh, relations);
  StructureOptions chosen = options;
  chosen.way = *way_named(name);
  if (chosen.cores == 0) chosen.cores = host_threads();
  return make_structure(mesh, relations, chosen);
}

void report_structure(const Structure& structure, Report& report) {
  report.edges = known(structure.count(1));
  report.triangles = known(structure.count(2));
  report.way = structure.name();
  const StructureStatistics statistics = structure.statistics();
  if (structure.way() != Way::explicit_) report.statistics = statistics;
}

}  // namespace gale::app
