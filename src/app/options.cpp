#include <CLI/CLI.hpp>

#include <gale/app/options.hpp>
#include <gale/app/sizes.hpp>
#include <gale/relations/relation.hpp>
#include <gale/version.hpp>

namespace gale::app {

namespace {

void add_input(CLI::App& command, Options& options) {
  command
      .add_option("INPUT", options.input, "A mesh (.vtu .vtk), a volume (.vti .nii .nii.gz .mha .mhd .nrrd) or grid:N")
      ->required();
  command.add_option("--above", options.read.above, "Volumes: keep the voxels with values above this");
  command.add_option(
      "-a,--array", options.array,
      "The point array to analyse, NAME or NAME_K for its component K; of volumes, also what --above is about");
  command.add_flag("--tetrahedralize", options.read.tetrahedralize, "Meshes: split other 3D cells into tetrahedra");
}

void add_common(CLI::App& command, Options& options) {
  command.add_option("-t,--threads", options.threads, "Threads (default: all cores)")->check(CLI::Range(1, 1024));
  command.add_option("--report", options.report, "Write times, memory and results to this JSON file");
  command.add_flag("--quiet", options.quiet, "Print nothing but errors");
}

void add_segmentation(CLI::App& command, Options& options) {
  CLI::Option* const capacity =
      command.add_option("--capacity", options.capacity, "Most vertices of a segment (default: 100)");
  capacity->check(CLI::Range(1, 2147483647));
  command
      .add_option("--segments", options.segments,
                  "A point array that says which segment a vertex is in, instead of an octree; random:K for K segments "
                  "by no rule")
      ->excludes(capacity);
}

void add_size(CLI::App& command, std::size_t& size, const std::string& name, const std::string& what) {
  const auto set = [&size, name](const std::string& text) { size = parse_size(name, text); };
  command.add_option_function<std::string>(name, set, what)->type_name("SIZE");
}

void add_runtime(CLI::App& command, Options& options) {
  command
      .add_option("--structure", options.structure,
                  "gale (cores beyond --threads compute ahead), explicit (everything at once), inline (no leaders, no "
                  "helpers) or task-parallel (a worker thread for each consumer)")
      ->check(CLI::IsMember({"gale", "explicit", "inline", "task-parallel"}));
  const CLI::Range launches(1, 1048576);
  command.add_option("--blocks-per-request", options.runtime.blocks_per_request, "n_b")->check(launches);
  command.add_option("--threads-per-block", options.runtime.threads_per_block, "t_b")->check(launches);
  command.add_option("--threads-per-segment", options.runtime.threads_per_segment, "t_s")->check(CLI::Range(1, 1024));
  add_size(command, options.runtime.host_memory, "--host-memory", "Budget for blocks on the host, e.g. 512MiB");
  add_size(command, options.runtime.device_memory, "--device-memory", "Budget for batches on the device");
}

void add_morse_smale(CLI::App& command, Options& options) {
  command
      .add_option(
          "-o,--output", options.output,
          "Write P_critical_points.vtp, P_separatrices1.vtp, P_segmentation.vtu and, if wanted, P_separatrices2.vtp")
      ->type_name("P");
  const auto add_switch = [&](const std::string& name, bool& is_on, const std::string& what) {
    command.add_flag_callback(
        name, [&is_on] { is_on = false; }, what);
  };
  add_switch("--no-descending-separatrices", options.parts.descending_separatrices,
             "Without the 1-separatrices from 1-saddles to minima");
  add_switch("--no-ascending-separatrices", options.parts.ascending_separatrices,
             "Without the 1-separatrices from 2-saddles to maxima");
  add_switch("--no-saddle-connectors", options.parts.saddle_connectors,
             "Without the 1-separatrices from 1-saddles to 2-saddles");
  add_switch("--no-descending-segmentation", options.parts.descending_manifolds,
             "Without the minimum that each vertex falls to");
  add_switch("--no-ascending-segmentation", options.parts.ascending_manifolds,
             "Without the maximum that each vertex rises to");
  command.add_flag("--separatrices2", options.parts.separatrices2,
                   "Also the 2-separatrices, the walls of saddles. Large");
  const auto set = [&](const std::string& text) { options.persistence = parse_persistence("--persistence", text); };
  command
      .add_option_function<std::string>(
          "--persistence", set,
          "Cancel pairs of critical simplices whose values differ by less than this; with a % of the field's range")
      ->type_name("X[%]");
  command
      .add_option(
          "--render", options.render,
          "Draw the complex to this .png: an octant cut out of the segmented mesh, and there the 1-separatrices")
      ->type_name("FILE.png");
}

void add_relation(CLI::App& command, Options& options) {
  std::vector<std::string> names;
  for (const Relation relation : members_of(all_relations - Relation::link)) names.push_back(name_of(relation));
  command
      .add_option("--relation", options.relation,
                  "XY: for each X the Ys that touch it; V vertex, E edge, F triangle, T tetrahedron")
      ->required()
      ->check(CLI::IsMember(names));
  command.add_flag(
      "--verify", options.verify,
      "Compare every row with the explicit structure (with brute force if it is that one, or without Kokkos-Kernels)");
  command.add_option("--dump", options.dump, "Write all rows to this text file");
}

CLI::App* add_command(CLI::App& app, Options& options, const std::string& name, const std::string& what) {
  CLI::App* const command = app.add_subcommand(name, what);
  command->callback([&options, name] { options.command = name; });
  add_input(*command, options);
  add_common(*command, options);
  return command;
}

void add_output(CLI::App& command, Options& options, const std::string& what, bool required) {
  CLI::Option* const output = command.add_option("-o,--output", options.output, what);
  if (required) output->required();
}

std::string commands_of(const CLI::App& app) {
  std::string names;
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  return "the commands are " + names;
}

/// What is wrong where no command was recognized.
std::string without_command(const CLI::App& app, int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first.empty()) return "no command: " + commands_of(app);
  if (first[0] == '-') return "no command before '" + first + "': " + commands_of(app);
  return "unknown command '" + first + "': " + commands_of(app);
}

}  // namespace

std::optional<Options> parse_command_line(int argc, char** argv) {
  Options options;
  CLI::App app("Topological analysis of large tetrahedral meshes", "gale");
  app.set_version_flag("--version", std::string("gale ") + gale::version);
  app.require_subcommand(1);

  CLI::App* command = add_command(app, options, "info", "Says what a mesh is: sizes, extent, arrays");

  command = add_command(app, options, "segment", "Divides a mesh into segments");
  add_segmentation(*command, options);
  add_output(*command, options, "The mesh with its segments as a point array: .vtu or .vtk", false);

  command = add_command(app, options, "critical-points", "Finds the critical points of a scalar field");
  add_segmentation(*command, options);
  add_runtime(*command, options);
  add_output(*command, options, "The critical points: .vtp", false);

  command =
      add_command(app, options, "discrete-gradient",
                  "Pairs the simplices of a mesh along a scalar field; finds those that are left, the critical ones");
  add_segmentation(*command, options);
  add_runtime(*command, options);
  add_output(*command, options, "The critical simplices: .vtp", false);
  command
      ->add_option(
          "--formulation", options.formulation,
          "stars (from VV, VT and link) or cells (from VE, VF and VT, as other programs do; slower): the same result")
      ->check(CLI::IsMember({"stars", "cells"}));
  command->add_option("--arrows", options.arrows,
                      "The gradient's arrows, from the barycentre of each simplex to that of the one it is paired "
                      "with: .vtp. Large: a point a pair, some 13 a vertex");

  command =
      add_command(app, options, "morse-smale",
                  "Finds the Morse-Smale complex of a scalar field: critical simplices, separatrices, segmentation");
  add_segmentation(*command, options);
  add_runtime(*command, options);
  add_morse_smale(*command, options);

  command =
      add_command(app, options, "relations", "Computes a relation of the whole mesh: its size, and how fast it comes");
  add_segmentation(*command, options);
  add_runtime(*command, options);
  add_relation(*command, options);

  command = add_command(app, options, "generate", "Writes the tetrahedral mesh that an input stands for");
  add_output(*command, options, ".vtu or .vtk", true);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    app.exit(success);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw UsageError(app.get_subcommands().empty() ? without_command(app, argc, argv) : error.what());
  }
  options.read.array = options.array;
  return options;
}

}  // namespace gale::app
