#include <algorithm>
#include <utility>

#include <gale/app/machine.hpp>
#include <gale/app/make_segmentation.hpp>
#include <gale/app/output_file.hpp>
#include <gale/app/session.hpp>
#include <gale/base/error.hpp>
#include <gale/io/read.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

Session::Session(const InputOptions& input, const CommonOptions& common, std::vector<std::string> files)
    : input_(input), common_(common), console_(common.quiet), files_(common.encoding) {
  report_.input = input.input;
  report_.threads = host_threads();
  files.push_back(common.report);
  files.erase(std::remove(files.begin(), files.end(), ""), files.end());
  require_distinct(files, input.input);
  for (const auto& file : files) require_writable(file);
  input_.read.outputs = std::move(files);
}

void Session::warm_up(const StructureOption& option, std::function<void(const VertexOrder&)> run) {
  const ComputeOptions& options = option.options;
  if (options.consumers != ConsumerPlace::host && !options.make_structure && options.structure.way == Way::gale)
    warm_up_.begin(std::move(run));
}

io::Dataset Session::read_any() {
  io::Dataset dataset;
  {
    const Stopwatch watch(report_.seconds.read);
    begin_step("reading", input_.input);
    dataset = io::read(input_.input, input_.read);
  }
  report_.vertices = std::visit([](const auto& points) { return std::int64_t(points.extent(0)); }, dataset.points);
  report_.tetrahedra = static_cast<std::int64_t>(dataset.tetrahedra.extent(0));
  console_.say("input", input_.input);
  note(dataset.notices);
  console_.say("vertices", grouped(*report_.vertices));
  console_.say("tetrahedra", grouped(*report_.tetrahedra));
  return dataset;
}

io::Dataset Session::read() {
  io::Dataset dataset = read_any();
  if (!input_.read.array.empty()) select_field(dataset);
  return dataset;
}

io::PointArray Session::select_field(const io::Dataset& dataset) {
  io::PointArray field = outputs::select_field(dataset, input_.read.array);
  console_.say("field", field.name);
  return field;
}

Mesh Session::encode(io::Dataset& dataset, const SegmentationOptions& segmentation, Keep keep) {
  Segmentation segments;
  std::vector<std::string> notices;
  {
    const Stopwatch watch(report_.seconds.segment);
    begin_step("dividing the mesh into segments");
    warm_up_.wait();
    segments = make_segmentation(dataset, segmentation, console_, notices);
  }
  note(notices);
  const Stopwatch watch(report_.seconds.initialize);
  begin_step("encoding the mesh");
  Mesh mesh(Tetrahedra<Id, HostMemory>(dataset.tetrahedra), segments);
  if (keep == Keep::nothing) dataset.tetrahedra = {};
  report_.segments = mesh.segments();
  if (!mesh.notice().empty()) note({mesh.notice()});
  console_.say("segments", grouped(mesh.segments()));
  return mesh;
}

FieldOnMesh Session::read_field(const SegmentationOptions& segmentation, Keep keep) {
  io::Dataset dataset = read_any();
  io::PointArray field = select_field(dataset);
  const Mesh mesh = encode(dataset, segmentation, keep);
  const Stopwatch watch(report_.seconds.initialize);
  begin_step("ordering the vertices");
  const VertexOrder order = outputs::order_of(mesh, dataset, field);
  return {std::move(dataset), mesh, std::move(field), order};
}

std::unique_ptr<Structure> Session::make_structure(const StructureOption& option, const Mesh& mesh,
                                                   RelationSet relations) {
  const Stopwatch watch(report_.seconds.initialize);
  begin_step("preparing the structure");
  report_.structure = option.name;
  return option.make(mesh, relations);
}

ComputeOptions Session::compute(const StructureOption& option, const std::string& title) const {
  ComputeOptions options = option.options;
  static_cast<SweepOptions&>(options) = sweep(title);
  return options;
}

SweepOptions Session::sweep(const std::string& title) const {
  begin_step("computing", title);
  SweepOptions sweep;
  sweep.threads = report_.threads;
  sweep.progress = console_.progress(title);
  return sweep;
}

void Session::note(const std::vector<std::string>& notices) {
  for (const std::string& notice : notices) {
    if (std::find(report_.notices.begin(), report_.notices.end(), notice) != report_.notices.end()) continue;
    report_.notices.push_back(notice);
    console_.say("note", notice);
  }
}

void Session::finish(const StructureOption& option, const Computed& computed) {
  report_.structure = option.name;
  report_.consumers = computed.on_device ? "device" : "host";
  report_.seconds.initialize += computed.seconds_preparing;
  report_.seconds.run += computed.seconds_running;
  note(computed.notices);
  finish(computed.structure.get());
}

void Session::finish(const Structure* structure) {
  if (structure != nullptr) {
    report_structure(*structure, report_);
    note(structure->statistics().notices);
  }
  if (report_.edges) console_.say("edges", grouped(*report_.edges));
  if (report_.triangles) console_.say("triangles", grouped(*report_.triangles));
  const Seconds& times = report_.seconds;
  console_.say("time", seconds(times.total()) + " (segment " + seconds(times.segment) + ", initialize " +
                           seconds(times.initialize) + ", run " + seconds(times.run) + "); read " +
                           seconds(times.read));
  console_.say("memory", bytes(static_cast<double>(host_peak_bytes())) + " at most");
  appear();
}

void Session::appear() {
  const std::size_t results = files_.all().size();
  if (!common_.report.empty()) write_report(files_.add(common_.report), report_);
  begin_step("writing", "the files");
  files_.commit([&] {
    for (std::size_t i = 0; i < results; ++i) console_.say("wrote", files_.all()[i]->path());
  });
  end_steps();
}

}  // namespace gale::app
