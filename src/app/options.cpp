#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <gale/app/options.hpp>
#include <gale/base/error.hpp>
#include <gale/baselines/task_parallel_structure.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/formats.hpp>
#include <gale/mesh/segmentation.hpp>
#include <gale/runtime/make_structure.hpp>

namespace gale::app {

namespace {

/// What a unit stands for, in either case; nothing if it is none. Units are powers of 1024: K, KB and KiB are one.
std::optional<double> factor_of(const std::string& text) {
  const std::string unit = io::detail::lower_case(text);
  if (unit.empty() || unit == "b") return 1;
  static const std::string prefixes = "kmgt";
  const auto power = prefixes.find(unit[0]);
  const std::string rest = unit.substr(1);
  if (power == std::string::npos || (!rest.empty() && rest != "b" && rest != "ib")) return std::nullopt;
  return std::pow(1024.0, static_cast<double>(power + 1));
}

std::optional<double> bytes_of(const std::string& text) {
  const auto end = std::min(text.find_first_not_of("0123456789."), text.size());
  const std::string number = text.substr(0, end);
  if (number.find_first_of("0123456789") == std::string::npos || number.find('.') != number.rfind('.'))
    return std::nullopt;
  const auto unit = text.find_first_not_of(' ', end);
  const auto factor = factor_of(unit == std::string::npos ? "" : text.substr(unit));
  if (!factor) return std::nullopt;
  return std::strtod(number.c_str(), nullptr) * *factor;
}

// Each throws UsageError, with the option and the text, for a text that means nothing.

/// At least one byte: "1000000", "512MiB", "1.5GiB", "8G".
std::size_t parse_size(const std::string& option, const std::string& text) {
  constexpr double limit = 9.2e18;  // below 2^63
  const auto bytes = bytes_of(text);
  if (bytes && *bytes >= 1 && *bytes <= limit) return static_cast<std::size_t>(*bytes);
  throw UsageError(option + ": '" + text + "' is no size of memory, such as 512MiB, 1.5GiB, 8G or 1000000 (bytes)");
}

/// A finite decimal number; nothing for what is none.
std::optional<double> number_in(const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789.eE+-") != std::string::npos) return std::nullopt;
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (*end != '\0' || !std::isfinite(number)) return std::nullopt;
  return number;
}

/// "-0.5", "1e3".
double parse_above(const std::string& text) {
  if (const auto number = number_in(text)) return *number;
  throw UsageError("--above: '" + text + "' is no finite number");
}

/// "0.5" or "20%", at least 0.
outputs::Persistence parse_persistence(const std::string& text) {
  const bool is_percent = !text.empty() && text.back() == '%';
  const auto number = number_in(is_percent ? text.substr(0, text.size() - 1) : text);
  if (number && *number >= 0) return {*number, is_percent};
  throw UsageError("--persistence: '" + text +
                   "' is no difference of values of at least 0, such as 0.5, nor a part of their range, such as 20%");
}

/// K of "random:K", a whole number of at least 1; nothing if the text begins otherwise.
std::optional<std::int64_t> parse_random(const std::string& text) {
  const std::string prefix = "random:";
  if (text.rfind(prefix, 0) != 0) return std::nullopt;
  std::int64_t count = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data() + prefix.size(), end, count);
  if (parsed.ec != std::errc() || parsed.ptr != end || count < 1)
    throw UsageError("--segments " + text + ": random:K takes a whole number K of at least 1");
  return count;
}

/// "all", "first", "last", or "I:J" with 0 <= I <= J.
Times parse_times(const std::string& text) {
  if (text == "all") return {};
  if (text == "first") return {0, 0, text};
  if (text == "last") return {-1, -1, text};
  Times times{0, 0, text};
  const char *const begin = text.data(), *const end = begin + text.size();
  const auto first = std::from_chars(begin, end, times.first);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == ':') {
    const auto last = std::from_chars(first.ptr + 1, end, times.last);
    if (last.ec == std::errc() && last.ptr == end && 0 <= times.first && times.first <= times.last) return times;
  }
  throw UsageError("--times: '" + text + "' is not all, first, last or I:J with 0 <= I <= J");
}

void add_size(CLI::App& command, std::size_t& size, const std::string& name, const std::string& what) {
  const auto set = [&size, name](const std::string& text) { size = parse_size(name, text); };
  command.add_option_function<std::string>(name, set, what)->type_name("SIZE");
}

/// Adds an option that takes one of these names, and sets `chosen` to the value beside it.
template <class Value>
void add_choice(CLI::App& command, Value& chosen, const std::string& name,
                const std::vector<std::pair<std::string, Value>>& choices, const std::string& what) {
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  const auto set = [&chosen, choices, names](const std::string& named) {
    chosen = choices[std::find(names.begin(), names.end(), named) - names.begin()].second;
  };
  command.add_option_function<std::string>(name, set, what)->check(CLI::IsMember(names));
}

}  // namespace

void InputOptions::add_to(CLI::App& command) {
  read.grids = io::GridCells::computed;
  command
      .add_option("INPUT", inputs,
                  "A mesh (" + io::extensions_of(io::Input::mesh) + "), a volume (" +
                      io::extensions_of(io::Input::volume) + "), a series of these (" +
                      io::extensions_of(io::Input::series) +
                      ") or grid:N, plane:N, smooth:N, noisy:N, ball:N, shells:N, dense:N")
      ->required()
      ->expected(1)
      ->type_name("TEXT");
  command
      .add_option_function<std::string>(
          "--above", [this](const std::string& text) { read.above = parse_above(text); },
          "Volumes: keep the voxels with values above this")
      ->type_name("FLOAT");
  CLI::Option* const array = command.add_option(
      "-a,--array", read.array,
      "The point array to analyse, NAME or NAME_K for its component K; of volumes, also what --above is about");
  command
      .add_option_function<std::string>(
          "--height", [this](const std::string& axis) { height = static_cast<int>(axis[0] - 'x'); },
          "Analyse this coordinate of the points, as the array Height")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->excludes(array);
  command
      .add_option_function<std::string>(
          "--cells", [this](const std::string& cells) { read.simplices_alone = cells != "any"; },
          "Meshes: simplices (or tetrahedra) refuses cells that are neither tetrahedra nor, where there are no 3D "
          "cells, triangles; any (default) splits them into these")
      ->check(CLI::IsMember({"any", "simplices", "tetrahedra"}));
  command
      .add_option_function<std::string>(
          "--mesh",
          [this](const std::string& mesh) {
            read.grids = mesh == "computed" ? io::GridCells::computed : io::GridCells::written;
          },
          "Volumes and grids: computed (default) stays a grid; written writes out its tetrahedra or triangles first")
      ->check(CLI::IsMember({"computed", "written"}));
  command.add_flag("--outside-files", read.outside_files,
                   "Volumes: let .mhd and .nrrd headers name data files outside of their own folder");
}

void InputOptions::add_times_to(CLI::App& command) {
  times = Times();
  CLI::Option* const input = command.get_option("INPUT");
  input->expected(1, -1);
  input->description(input->get_description() + "; several are the steps of a series");
  command.add_option_function<std::string>(
      "--times", [this](const std::string& text) { times = parse_times(text); },
      "Of a series these steps: all (default), first, last, or I:J, those from I to J, counted from 0");
}

InputOptions::Steps InputOptions::steps() const {
  Steps chosen{false, {{0, inputs.front()}}, {}};
  const io::Format* const format = io::format_of(inputs.front());
  const bool names_steps = format != nullptr && format->input == io::Input::series;
  if (!times && !names_steps) return chosen;
  const std::vector<io::Step> steps = io::steps_of(inputs, read);
  if (!times) {
    for (const io::Step& step : steps) chosen.not_chosen.push_back(step.file);
    return chosen;
  }
  if (!names_steps && steps.size() == 1) {
    if (times->text != "all") throw UsageError("--times: '" + inputs.front() + "' is no series");
    return chosen;
  }
  const auto count = static_cast<std::int64_t>(steps.size());
  const auto at = [&](std::int64_t step) { return step < 0 ? step + count : step; };
  if (at(times->last) >= count)
    throw UsageError("--times " + times->text + ": there are " + std::to_string(count) + " steps, counted from 0");
  const auto begin = at(times->first), end = at(times->last) + 1;
  chosen = {true, {steps.begin() + begin, steps.begin() + end}, {}};
  for (std::int64_t step = 0; step < count; ++step) {
    if (step < begin || step >= end) chosen.not_chosen.push_back(steps[step].file);
  }
  return chosen;
}

void CommonOptions::add_to(CLI::App& command) {
  command.add_option("-t,--threads", threads, "Threads (default: all cores)")->check(CLI::Range(1, most_threads));
  command.add_option("--report", report, "Write times, memory and results to this JSON file")->type_name("FILE");
  command.add_flag("--quiet", quiet, "Print nothing but errors");
}

void CommonOptions::add_encoding_to(CLI::App& command) {
  add_choice(
      command, encoding, "--encoding", {{"appended", io::Encoding::appended}, {"base64", io::Encoding::base64}},
      "How .vtu and .vtp have their arrays: appended (default), or base64 for readers that want all to be XML, such "
      "as ParaView 5.11 in Debian 12");
}

void CommonOptions::add_format_to(CLI::App& command) {
  add_choice(command, extension, "--format", {{"xml", ""}, {"vtkhdf", ".vtkhdf"}},
             "Write .vtp and .vtu (xml, default), or each as .vtkhdf, whose surfaces VTK 9.3 or later reads");
}

void SegmentationOptions::add_to(CLI::App& command) {
  CLI::Option* const largest = command.add_option(
      "--capacity", capacity, "Most vertices of a segment (default: " + std::to_string(default_capacity) + ")");
  largest->check(CLI::Range(1, 2147483647));
  const auto set = [this](const std::string& text) {
    random_count = parse_random(text);
    if (!random_count) array = text;
  };
  command
      .add_option_function<std::string>(
          "--segments", set,
          "A point array that says which segment a vertex is in, instead of an octree; random:K for K segments by no "
          "rule")
      ->excludes(largest);
}

void StructureOption::add_to(CLI::App& command) {
  const auto set = [this](const std::string& named) {
    name = named;
    if (const auto way = way_named(name))
      options.structure.way = *way;
    else
      options.make_structure = baselines::make_task_parallel_structure;
  };
  command
      .add_option_function<std::string>(
          "--structure", set,
          "gale (leaders on a device, else helpers), leaders (threads that have batches computed ahead), helpers "
          "(cores beyond --threads compute ahead), inline (no leaders, no helpers), explicit (everything at "
          "once) or task-parallel (a worker thread for each consumer)")
      ->check(CLI::IsMember({"gale", "leaders", "helpers", "inline", "explicit", "task-parallel"}));
  command
      .add_option("--cores", options.structure.cores,
                  "Cores that threads and helpers share (default: as many as threads)")
      ->check(CLI::Range(1, 1024));
  add_choice(command, options.structure.queues, "--queues",
             {{"kernel", Queues::per_kernel}, {"relation", Queues::per_relation}},
             "Of leaders: one for each kernel (default), which may make several relations, or for each relation");
  const CLI::Range launches(1, 1048576);
  command.add_option("--blocks-per-request", options.structure.blocks_per_request, "n_b")->check(launches);
  command.add_option("--threads-per-block", options.structure.threads_per_block, "t_b")->check(launches);
  command.add_option("--threads-per-segment", options.structure.threads_per_segment, "t_s")->check(CLI::Range(1, 1024));
  add_size(command, options.structure.host_memory, "--host-memory", "Budget for blocks on the host, e.g. 512MiB");
  add_size(command, options.structure.device_memory, "--device-memory", "Budget for batches on the device");
}

void StructureOption::add_consumers_to(CLI::App& command) {
  add_choice(command, options.consumers, "--consumers",
             {{"host", ConsumerPlace::host}, {"device", ConsumerPlace::device}},
             "Where rows are read: by threads of the host, or by kernels on the device, where they are made "
             "(default: the device if there is one, with --structure gale)");
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

void add_persistence(CLI::App& app, std::optional<outputs::Persistence>& persistence, const std::string& what) {
  const auto set = [&persistence](const std::string& text) { persistence = parse_persistence(text); };
  app.add_option_function<std::string>("--persistence", set, what)->type_name("X[%]");
}

}  // namespace gale::app
