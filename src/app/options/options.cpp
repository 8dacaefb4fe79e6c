#include <CLI/CLI.hpp>

#include <gale/app/options/options.hpp>
#include <gale/app/options/parse.hpp>
#include <gale/io/formats.hpp>
#include <gale/mesh/segmentation.hpp>

namespace gale::app {

void InputOptions::add_to(CLI::App& command) {
  command
      .add_option("INPUT", input,
                  "A mesh (" + io::extensions_of(io::Input::mesh) + "), a volume (" +
                      io::extensions_of(io::Input::volume) +
                      ") or grid:N, smooth:N, noisy:N, ball:N, shells:N, dense:N")
      ->required();
  command.add_option("--above", read.above, "Volumes: keep the voxels with values above this");
  command.add_option(
      "-a,--array", read.array,
      "The point array to analyse, NAME or NAME_K for its component K; of volumes, also what --above is about");
  command.add_flag("--tetrahedralize", read.tetrahedralize, "Meshes: split other 3D cells into tetrahedra");
  command.add_flag("--outside-files", read.outside_files,
                   "Volumes: let .mhd and .nrrd headers name data files outside of their own folder");
}

void CommonOptions::add_to(CLI::App& command) {
  command.add_option("-t,--threads", threads, "Threads (default: all cores)")->check(CLI::Range(1, 1024));
  command.add_option("--report", report, "Write times, memory and results to this JSON file");
  command.add_flag("--quiet", quiet, "Print nothing but errors");
}

void CommonOptions::add_encoding_to(CLI::App& command) {
  const auto set = [this](const std::string& name) {
    encoding = name == "base64" ? io::Encoding::base64 : io::Encoding::appended;
  };
  command
      .add_option_function<std::string>("--encoding", set,
                                        "How .vtu and .vtp have their arrays: appended (default), or base64 for "
                                        "readers that want all to be XML, such "
                                        "as ParaView 5.11 in Debian 12")
      ->check(CLI::IsMember({"appended", "base64"}));
}

void SegmentationOptions::add_to(CLI::App& command) {
  CLI::Option* const largest = command.add_option(
      "--capacity", capacity, "Most vertices of a segment (default: " + std::to_string(default_capacity) + ")");
  largest->check(CLI::Range(1, 2147483647));
  const auto set = [this](const std::string& text) {
    random_count = parse_random("--segments", text);
    if (!random_count) array = text;
  };
  command
      .add_option_function<std::string>(
          "--segments", set,
          "A point array that says which segment a vertex is in, instead of an octree; random:K for K segments by no "
          "rule")
      ->excludes(largest);
}

}  // namespace gale::app
