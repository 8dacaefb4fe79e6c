#include <charconv>
#include <filesystem>
#include <random>

#include <gale/app/machine.hpp>
#include <gale/app/output_file.hpp>
#include <gale/app/session.hpp>
#include <gale/base/error.hpp>
#include <gale/io/read.hpp>
#include <gale/io/vtk/vtk_files.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

namespace {

constexpr int default_capacity = 100;

/// Throws UsageError if two of the files, those that aren't empty, are one.
void require_distinct(const std::vector<std::string>& files) {
  const auto plain = [](const std::string& file) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file));
  };
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!files[i].empty() && !files[j].empty() && plain(files[i]) == plain(files[j]))
        throw UsageError("'" + files[i] + "' is named for two files");
    }
  }
}

/// K of "random:K", or nothing. Throws UsageError if there is something else in its place.
std::optional<std::int64_t> random_segments(const std::string& segments) {
  const std::string prefix = "random:";
  if (segments.rfind(prefix, 0) != 0) return std::nullopt;
  std::int64_t count = 0;
  const char* const end = segments.data() + segments.size();
  const auto parsed = std::from_chars(segments.data() + prefix.size(), end, count);
  if (parsed.ec != std::errc() || parsed.ptr != end || count < 1)
    throw UsageError("--segments " + segments + ": random:K takes a whole number K of at least 1");
  return count;
}

/// Each vertex in one of `count` segments, by no rule: the worst that a segmentation can be.
Segmentation scattered(std::size_t vertices, std::int64_t count) {
  std::vector<std::int64_t> labels(vertices);
  std::mt19937_64 random(1);
  for (auto& label : labels) label = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(count));
  return given_segmentation(Array<const std::int64_t, HostMemory>(labels.data(), labels.size()));
}

std::size_t point_count(const io::Dataset& dataset) {
  return std::visit([](const auto& points) { return points.extent(0); }, dataset.points);
}

Segmentation octree(const io::Dataset& dataset, int capacity) {
  return std::visit(
      [&](const auto& points) {
        using Coordinate = typename std::decay_t<decltype(points)>::non_const_value_type;
        return octree_segmentation<Coordinate, HostMemory>(Points<Coordinate, HostMemory>(points), capacity);
      },
      dataset.points);
}

}  // namespace

Session::Session(const Options& options, const std::vector<std::string>& files)
    : options_(options), console_(options.quiet) {
  report_.input = options.input;
  random_segments(options.segments);
  std::vector<std::string> all = files;
  all.insert(all.end(), {options.input, options.dump, options.report});
  require_distinct(all);
  report_.threads = host_threads();
  // Found out now rather than after the work.
  for (const auto& file : files) {
    if (file.empty()) continue;
    if (!io::detail::has_vtk()) throw Error("this gale was built without VTK: it cannot write '" + file + "'");
    require_writable(file);
  }
  if (!options.dump.empty()) require_writable(options.dump);
  if (!options.report.empty()) require_writable(options.report);
}

io::Dataset Session::read() {
  io::Dataset dataset;
  {
    const Stopwatch watch(report_.seconds.read);
    dataset = io::read(options_.input, options_.read);
  }
  report_.vertices = static_cast<std::int64_t>(point_count(dataset));
  report_.tetrahedra = static_cast<std::int64_t>(dataset.tetrahedra.extent(0));
  console_.say("input", options_.input);
  for (const auto& notice : dataset.notices) console_.say("note", notice);
  console_.say("vertices", grouped(*report_.vertices));
  console_.say("tetrahedra", grouped(*report_.tetrahedra));
  if (!options_.array.empty()) select_field(dataset, options_.array);  // whoever uses it: it must be there
  return dataset;
}

const io::PointArray* Session::given_segments(const io::Dataset& dataset) const {
  if (!options_.segments.empty()) return &select_segments(dataset, options_.segments);
  if (options_.capacity) return nullptr;
  std::vector<std::string> ignored;
  const io::PointArray* const segments = find_segments(dataset, ignored);
  for (const auto& name : ignored)
    console_.say("note", "array " + name + " isn't one whole number a point: not used as segments");
  return segments;
}

Segmentation Session::segment(const io::Dataset& dataset) {
  if (const auto count = random_segments(options_.segments)) return scattered(point_count(dataset), *count);
  const io::PointArray* const given = given_segments(dataset);
  if (given == nullptr) return octree(dataset, options_.capacity.value_or(default_capacity));
  const auto labels = labels_of(*given);
  console_.say("segments from", "array " + given->name);
  return given_segmentation(Array<const std::int64_t, HostMemory>(labels.data(), labels.size()));
}

Mesh Session::encode(io::Dataset& dataset, Keep keep) {
  Segmentation segmentation;
  {
    const Stopwatch watch(report_.seconds.segment);
    segmentation = segment(dataset);
  }
  const Stopwatch watch(report_.seconds.initialize);
  Mesh mesh(Tetrahedra<Id, HostMemory>(dataset.tetrahedra), segmentation);
  if (keep == Keep::nothing) dataset.tetrahedra = {};
  report_.segments = mesh.segments();
  console_.say("segments", grouped(mesh.segments()));
  return mesh;
}

FieldOnMesh Session::read_field(Keep keep) {
  io::Dataset dataset = read();
  const io::PointArray field = select_field(dataset, options_.array);
  console_.say("field", field.name);
  const Mesh mesh = encode(dataset, keep);
  const Stopwatch watch(report_.seconds.initialize);
  const VertexOrder order = order_of(mesh, dataset, field);
  return {std::move(dataset), mesh, order};
}

std::unique_ptr<Structure> Session::make_structure(const Mesh& mesh, RelationSet relations) {
  const Stopwatch watch(report_.seconds.initialize);
  report_.structure = options_.structure;
  StructureOptions structure = options_.runtime;
  structure.way = *way_named(options_.structure);
  return gale::make_structure(mesh, relations, structure);
}

SweepOptions Session::sweep(const std::string& title) const {
  SweepOptions sweep;
  sweep.threads = report_.threads;
  sweep.progress = console_.progress(title);
  return sweep;
}

void Session::count_simplices(const Structure& structure) {
  const auto tell = [this](const char* name, Id count, std::optional<std::int64_t>& reported) {
    if (count == no_id) return;
    reported = count;
    console_.say(name, grouped(count));
  };
  tell("edges", structure.count(1), report_.edges);
  tell("triangles", structure.count(2), report_.triangles);
}

void Session::finish(const Structure* structure) {
  if (structure != nullptr) {
    report_.way = name_of(structure->way());
    if (structure->way() != Way::explicit_) report_.statistics = structure->statistics();
    count_simplices(*structure);
  }
  const Seconds& times = report_.seconds;
  console_.say("time", seconds(times.total()) + " (segment " + seconds(times.segment) + ", initialize " +
                           seconds(times.initialize) + ", run " + seconds(times.run) + "); read " +
                           seconds(times.read));
  console_.say("memory", bytes(static_cast<double>(host_peak_bytes())) + " at most");
  if (!options_.report.empty()) write_report(options_.report, report_);
}

void require_extension(const Options& options, const std::string& option, const std::string& file,
                       std::initializer_list<const char*> extensions) {
  if (file.empty()) return;
  std::string list;
  for (const std::string extension : extensions) {
    if (io::detail::format_of(file) == io::detail::format_of("any" + extension)) return;
    list += (list.empty() ? "" : " or ") + extension;
  }
  throw UsageError(option + ' ' + file + ": gale " + options.command + " writes " + list);
}

void require_extension(const Options& options, std::initializer_list<const char*> extensions) {
  require_extension(options, "--output", options.output, extensions);
}

}  // namespace gale::app
