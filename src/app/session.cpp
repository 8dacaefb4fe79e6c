#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include <gale/algorithms/excerpt/whole_mesh.hpp>
#include <gale/app/output_names.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/app/session.hpp>
#include <gale/base/error.hpp>
#include <gale/io/read.hpp>
#include <gale/io/write.hpp>
#include <gale/outputs/excerpt.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

namespace {

namespace fs = std::filesystem;

void write_to(const io::AtomicFile& file, const io::PointSet& points) { io::write_points(file, points); }
void write_to(const io::AtomicFile& file, const io::Surface& surface) { io::write_surface(file, surface); }
void write_to(const io::AtomicFile& file, const io::Dataset& piece) { io::write_piece(file, piece); }

/// Does what detail::together does, but for UsageError: all ranks throw that then.
template <class Action>
void use_together(const Ranks& ranks, const Action& action) {
  std::string wrong;
  detail::together(ranks, [&] {
    try {
      action();
    } catch (const UsageError& error) {
      wrong = error.what();
    }
  });
  const std::int64_t first = ranks.least(std::int64_t(wrong.empty() ? ranks.size() : ranks.rank()));
  if (first < ranks.size()) throw UsageError(ranks.broadcast(wrong, static_cast<int>(first)));
}

}  // namespace

Session::Session(const InputOptions& input, const CommonOptions& common, std::vector<std::string> files,
                 Outputs outputs)
    : input_(input),
      common_(common),
      ranks_(Launch::ranks()),
      has_outputs_(std::any_of(files.begin(), files.end(), [](const auto& file) { return !file.empty(); })),
      console_(common.quiet || !Launch::is_first()),
      files_(common.encoding) {
  report_.input = input.inputs.front();
  report_.threads = host_threads();
  report_.wall.start = process_age();
  files.erase(std::remove(files.begin(), files.end(), ""), files.end());
  use_together(ranks_, [&] {
    InputOptions::Steps steps = input.steps();
    is_series_ = steps.are_series;
    numbers_files_ = is_series_ && outputs == Outputs::of_each_step;
    steps_ = std::move(steps.all);
    std::vector<std::string> inputs = input.inputs;
    inputs.insert(inputs.end(), steps.not_chosen.begin(), steps.not_chosen.end());
    for (const io::Step& step : steps_) inputs.push_back(step.file);
    WrittenFiles written = files_written(files, numbers_files_ ? steps_.size() : 0, ranks_);
    if (!common.report.empty()) written.all.push_back(common.report);
    if (!common.report.empty() && Launch::is_first()) written.own.push_back(common.report);
    if (Launch::is_first()) require_distinct(written.all, inputs);
    for (const std::string& file : written.own) io::AtomicFiles().add(file);  // throws if it can't be made there now
    input_.read.outputs = std::move(written.all);
  });
  begin_reading();
}

void Session::say_input() {
  if (!is_series_) return console_.say("input", input_.input);
  console_.say("step", std::to_string(step_ + 1) + " of " + std::to_string(steps_.size()) + ", time " +
                           nlohmann::json(steps_[step_].time).dump() + ": " + input_.input);
}

bool Session::next_step(const Computed& computed) {
  if (!is_series_) return false;
  Seconds now = report_.seconds;
  now.initialize += computed.seconds_preparing;
  now.run += computed.seconds_running;
  report_.add_step(steps_[step_], now - seconds_before_);
  seconds_before_ = now;
  if (++step_ == steps_.size()) return false;
  begin_reading();
  return true;
}

void Session::begin_reading() {
  input_.input = steps_[step_].file;
  input_.read.time = steps_[step_].at;
}

void Session::warm_up(const StructureOption& option, std::function<void(const VertexOrder&)> run) {
  const ComputeOptions& options = option.options;
  const bool on_device =
      options.consumers != ConsumerPlace::host && !options.make_structure && options.structure.way == Way::gale;
  if (on_device) warm_up_.begin(std::move(run));
}

io::Dataset Session::read_any() {
  begin_step("reading", input_.input);
  io::Dataset dataset = timed(report_.seconds.read, [&] { return io::read(input_.input, input_.read); });
  if (input_.height) outputs::add_height(dataset, *input_.height);
  say_input();
  note(dataset.notices);
  tell_size(static_cast<std::int64_t>(dataset.vertices()), static_cast<std::int64_t>(dataset.cells()),
            dataset.dimension());
  return dataset;
}

void Session::tell_size(std::int64_t vertices, std::int64_t cells, int dimension) {
  std::optional<std::int64_t>& told = dimension == 3 ? report_.tetrahedra : report_.triangles;
  if (report_.vertices == vertices && told == cells) return;
  told = cells;
  report_.vertices = vertices;
  console_.say("vertices", grouped(vertices));
  console_.say(dimension == 3 ? "tetrahedra" : "triangles", grouped(cells));
}

io::Dataset Session::read() {
  io::Dataset dataset = read_any();
  if (!input_.read.array.empty()) select_field(dataset);
  return dataset;
}

io::PointArray select_field(const io::Dataset& dataset, const InputOptions& input) {
  if (dataset.arrays.empty() && input.read.array.empty())
    throw Error("'" + input.input + "' has no point array to analyse: --height x, y or z takes a coordinate");
  return outputs::select_field(dataset, input.read.array);
}

io::PointArray Session::select_field(const io::Dataset& dataset) {
  io::PointArray field = app::select_field(dataset, input_);
  if (step_ == 0) console_.say("field", field.name);
  if (outputs::is_rounded(field)) note_rounded(field.name);
  return field;
}

Mesh Session::encode(io::Dataset& dataset, const SegmentationOptions& segmentation, Keep keep) {
  const bool is_there =
      mesh_ && timed(report_.seconds.initialize, [&] { return outputs::is_mesh_of(*mesh_, dataset); });
  if (!is_there) {
    mesh_.reset();
    mesh_ = encode_anew(dataset, segmentation);
  }
  const Stopwatch watch(report_.seconds.initialize);
  if (keep != Keep::cells) {
    dataset.tetrahedra = {};
    dataset.triangles = {};
    dataset.grid.reset();
    dataset.cell_arrays.clear();
  }
  return *mesh_;
}

Mesh Session::encode_anew(io::Dataset& dataset, const SegmentationOptions& segmentation) {
  std::vector<std::string> notices;
  begin_step("dividing the mesh into segments");
  std::optional<Segmentation> segments = timed(report_.seconds.segment, [&] {
    warm_up_.wait();
    auto given = segmentation_given(dataset, segmentation, console_, notices);
    if (!given && !dataset.grid) given = make_octree(dataset, segmentation);
    return given;
  });
  note(notices);
  const Stopwatch watch(report_.seconds.initialize);
  begin_step("encoding the mesh");
  const auto encode = [&] {
    if (!segments) return Mesh(*dataset.grid, segmentation.capacity.value_or(default_capacity));
    io::write_out_cells(dataset);
    return outputs::mesh_of(dataset, *segments);
  };
  Mesh mesh = encode();
  report_.segments = mesh.segments();
  if (!mesh.notice().empty()) note({mesh.notice()});
  console_.say("segments", grouped(mesh.segments()));
  return mesh;
}

FieldOnMesh Session::read_part(const SegmentationOptions& segmentation, Keep keep) {
  if (!segmentation.array.empty() || segmentation.random_count)
    throw UsageError("--segments: not on several ranks, where segments are those of an octree");
  std::optional<Stopwatch> watch(std::in_place, report_.seconds.read);
  const auto was_read = [&](const std::vector<std::string>& notices) {
    watch.emplace(report_.seconds.initialize);
    warm_up_.wait();
    say_input();
    if (step_ == 0)
      console_.say("ranks", std::to_string(ranks_.size()) + " of " + std::to_string(report_.threads) + " threads");
    note(notices);
  };
  const WantedOfInput wanted{has_outputs_ || keep == Keep::values || keep == Keep::owned_values, has_outputs_,
                             has_outputs_ && keep == Keep::cells, keep == Keep::owned_values && !has_outputs_};
  FieldOnMesh on = read_on_ranks(input_, segmentation.capacity.value_or(default_capacity), wanted, was_read);
  tell_size(on.mesh.all_vertices(), on.mesh.all_cells(), on.mesh.dimension());
  std::int64_t sums[] = {on.mesh.owned_segments().size(), on.is_rounded};
  ranks_.sum(sums, 2);
  report_.segments = sums[0];
  if (step_ == 0) console_.say("field", on.field.name);
  if (sums[1] > 0) note_rounded(on.field.name);
  if (!on.note.empty()) note({on.note});
  part_ = on.mesh;
  return on;
}

FieldOnMesh Session::read_field(const SegmentationOptions& segmentation, Keep keep) {
  if (Launch::are_several()) return read_part(segmentation, keep);
  const bool has_use_for_points = has_outputs_ || input_.height;
  if (input_.read.grids == io::GridCells::computed && !has_use_for_points)
    input_.read.grids = io::GridCells::computed_alone;
  io::Dataset dataset = read_any();
  io::PointArray field = select_field(dataset);
  const Mesh mesh = encode(dataset, segmentation, keep);
  const Stopwatch watch(report_.seconds.initialize);
  begin_step("ordering the vertices");
  std::string contradiction;
  const VertexOrder order = outputs::order_of(mesh, dataset, field, &contradiction);
  if (!contradiction.empty()) note({contradiction});
  return {std::move(dataset), mesh, std::move(field), order};
}

FieldOnMesh Session::whole(const FieldOnMesh& on) const {
  if (!Launch::are_several()) return on;
  const detail::WholeMesh gathered(on.order, "the mesh of a picture");
  const Mesh& mesh = gathered.mesh();
  return {outputs::dataset_of(mesh, on.mesh, on.dataset), mesh, outputs::array_of(mesh, on.mesh, on.field, on.values),
          gathered.order()};
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
  if (!Launch::are_several()) sweep.progress = console_.progress(title);
  return sweep;
}

void Session::note_rounded(const std::string& field) {
  note({"'" + field +
        "' has whole numbers beyond 2^53: they are ordered exactly, but differences are of rounded values"});
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

std::string Session::named(const std::string& path) {
  if (!numbers_files_) return path;
  const std::string name = name_of_step(path, step_), series = name_of_series(path);
  if (!series.empty()) series_[series].push_back({steps_[step_].time, fs::path(name).filename().string()});
  return name;
}

void Session::write_series() {
  for (const auto& [name, steps] : series_) {
    store(name, [&, &of = steps](const io::AtomicFile& file) { io::write_series(file, of); });
  }
}

template <class Result>
void Session::write_one(const std::string& path, const Result& result) {
  detail::together(ranks_, [&] {
    store(Launch::are_several() ? piece_of(path, ranks_.rank()) : path,
          [&](const io::AtomicFile& mine) { write_to(mine, result); });
    if (!Launch::are_several() || !Launch::is_first()) return;
    std::vector<std::string> pieces;
    for (int rank = 0; rank < ranks_.size(); ++rank)
      pieces.push_back(fs::path(piece_of(path, rank)).filename().string());
    store(path, [&](const io::AtomicFile& all) { io::write_pieces(all, pieces, result); });
  });
}

template void Session::write_one(const std::string&, const io::PointSet&);
template void Session::write_one(const std::string&, const io::Surface&);
template void Session::write_one(const std::string&, const io::Dataset&);

void Session::finish(const Structure* structure) {
  if (part_) {
    report_.ranks = differences_of_ranks(ranks_, *part_, report_.seconds);
  } else if (structure != nullptr) {
    report_structure(*structure, report_);
    note(structure->statistics().notices);
  }
  if (report_.edges) console_.say("edges", grouped(*report_.edges));
  if (report_.triangles && report_.tetrahedra) console_.say("triangles", grouped(*report_.triangles));
  tell_costs();
  detail::together(ranks_, [&] {
    if (Launch::is_first()) write_series();
  });
  const std::size_t results = files_.all().size();
  detail::together(ranks_, [&] {
    if (!common_.report.empty() && Launch::is_first()) write_report(files_.add(common_.report), report_);
  });
  begin_step("writing", "the files");
  appear(results);
  end_steps();
}

void Session::tell_costs() {
  const Seconds& times = report_.seconds;
  const std::string segment = part_ ? "" : "segment " + seconds(times.segment) + ", ";
  console_.say("time", seconds(times.total()) + " (" + segment + "initialize " + seconds(times.initialize) + ", run " +
                           seconds(times.run) + "); read " + seconds(times.read));
  console_.say("memory", part_ ? bytes(report_.ranks["host_peak_bytes"]["most"].get<double>()) + " at most, of one rank"
                               : bytes(static_cast<double>(host_peak_bytes())) + " at most");
}

void Session::appear(std::size_t results) {
  bool are_there = false;
  const auto say = [&] {
    are_there = true;
    detail::together(ranks_, [] {});  // the files of others are there, too
    detail::together(ranks_, [&] {
      for (std::size_t i = 0; i < results; ++i) {
        const std::string& name = files_.all()[i]->path();
        if (!numbers_files_ || name_of_series(name).empty()) console_.say("wrote", name);
      }
    });
  };
  try {
    files_.commit(say);
  } catch (...) {
    if (are_there) throw;
    detail::together(ranks_, [] { throw; });
  }
}

}  // namespace gale::app
