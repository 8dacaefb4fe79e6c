#include <algorithm>
#include <filesystem>

#include <gale/app/machine.hpp>
#include <gale/app/output_file.hpp>
#include <gale/app/ranks/pieces_input.hpp>
#include <gale/app/ranks/rank_session.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/app/ranks/shared_input.hpp>
#include <gale/app/step.hpp>
#include <gale/app/usage_error.hpp>
#include <gale/base/threads.hpp>
#include <gale/distributed/together.hpp>

namespace gale::app {

namespace {

/// By rank the least, the median and the most.
nlohmann::ordered_json spread_of(std::vector<std::int64_t> by_rank, double unit) {
  std::sort(by_rank.begin(), by_rank.end());
  const auto value = [&](std::size_t at) {
    return unit == 1 ? nlohmann::ordered_json(by_rank[at]) : nlohmann::ordered_json(unit * double(by_rank[at]));
  };
  return {{"least", value(0)}, {"median", value(by_rank.size() / 2)}, {"most", value(by_rank.size() - 1)}};
}

/// Whether it is a .pvtu.
bool is_mesh(const std::string& path) { return !path.empty() && (path.back() == 'u' || path.back() == 'U'); }

/// NAME_RANK.vtp for NAME.pvtp, NAME_RANK.vtu for NAME.pvtu.
std::string piece_of(const std::string& path, int rank) {
  return std::filesystem::path(path).replace_extension().string() + '_' + std::to_string(rank) +
         (is_mesh(path) ? ".vtu" : ".vtp");
}

void write_one(const io::AtomicFile& file, const io::PointSet& points) { io::write_points(file, points); }
void write_one(const io::AtomicFile& file, const io::Surface& surface) { io::write_surface(file, surface); }
void write_one(const io::AtomicFile& file, const io::MeshPiece& piece) { io::write_piece(file, piece); }

/// Points and arrays of what this rank holds. Collective.
io::Dataset local_dataset(const DistributedMesh& mesh, const SharedInput& shared) {
  io::Dataset local;
  detail::together(mesh.ranks(), [&] {
    const auto fill = [&](auto coordinate) {
      using Coordinate = decltype(coordinate);
      const auto points = allocate<io::Dataset::Points<Coordinate>>("GALE::local_points", mesh.points().extent(0));
      parallel_for("GALE::local_points", HostExecutionSpace(), points.extent(0), [&](Offset i) {
        for (int axis = 0; axis < 3; ++axis) points(i, axis) = static_cast<Coordinate>(mesh.points()(i, axis));
      });
      local.points = points;
    };
    shared.is_in_float ? fill(float()) : fill(double());
  });
  for (const io::PointArray& array : shared.arrays) local.arrays.push_back(local_values(mesh, array));
  return local;
}

}  // namespace

RankSession::Outputs RankSession::kind_of(const std::vector<std::string>& files) {
  if (std::any_of(files.begin(), files.end(), is_mesh)) return Outputs::with_mesh;
  const bool any = std::any_of(files.begin(), files.end(), [](const auto& file) { return !file.empty(); });
  return any ? Outputs::points : Outputs::none;
}

RankSession::RankSession(const InputOptions& input, const CommonOptions& common,
                         const std::vector<std::string>& outputs)
    : input_(input),
      common_(common),
      outputs_(kind_of(outputs)),
      ranks_(MPI_COMM_WORLD),
      console_(common.quiet || !Ranks::is_first()),
      files_(common.encoding) {
  report_.input = input.input;
  report_.threads = host_threads();
  detail::together(ranks_, [&] {
    std::vector<std::string> mine, all;
    const auto add = [&](const std::string& file, int writer) {
      all.push_back(file);
      if (writer == ranks_.rank()) mine.push_back(file);
    };
    if (!common.report.empty()) add(common.report, 0);
    for (const std::string& file : outputs) {
      if (file.empty()) continue;
      add(file, 0);
      for (int rank = 0; rank < ranks_.size(); ++rank) add(piece_of(file, rank), rank);
    }
    if (ranks_.rank() == 0) require_distinct(all, input.input);
    for (const std::string& file : mine) require_writable(file);
    input_.read.outputs = std::move(all);
  });
}

FieldOnRanks RankSession::read_field(const SegmentationOptions& segmentation) {
  if (!segmentation.array.empty() || segmentation.random_count)
    throw UsageError("--segments: not on several ranks, where segments are those of an octree");
  SharedInput shared;
  {
    const Stopwatch watch(report_.seconds.read);
    shared = read_shared(ranks_, input_);
  }
  console_.say("input", input_.input);
  console_.say("ranks", std::to_string(ranks_.size()) + " of " + std::to_string(report_.threads) + " threads");
  for (const std::string& notice : shared.notices) console_.say("note", notice);
  report_.notices = shared.notices;
  const Stopwatch watch(report_.seconds.initialize);
  begin_step("sharing the mesh");
  PartitionOptions options;
  options.repartition = shared.is_dealt_out;
  options.keep_corners = outputs_ == Outputs::with_mesh;
  options.capacity = segmentation.capacity.value_or(options.capacity);
  const DistributedMesh mesh =
      std::visit([&](const auto& held) { return DistributedMesh(ranks_, held.part, options); }, shared.held);
  shared.held = {};
  report_.vertices = mesh.vertices();
  report_.tetrahedra = mesh.tetrahedra();
  report_.segments = ranks_.sum(mesh.local().owned_segments());
  console_.say("vertices", grouped(mesh.vertices()));
  console_.say("tetrahedra", grouped(mesh.tetrahedra()));
  console_.say("field", shared.field.name);
  begin_step("ordering the vertices");
  if (shared.has_order) require_permutation(mesh, local_values(mesh, shared.order));
  const DistributedOrder order = std::visit(
      [&](const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        return DistributedOrder(mesh, Array<const Value, HostMemory>(values.data(), values.size()));
      },
      shared.order.values);
  FieldOnRanks on{mesh, order, {}, {}, {}, shared.has_ids};
  if (outputs_ == Outputs::none) return on;
  begin_step("sharing the arrays");
  on.local = local_dataset(mesh, shared);
  on.field = local_values(mesh, shared.field);
  on.order_from = local_values(mesh, shared.order);
  return on;
}

/// Where one rank's mesh isn't on a device, nobody's consumers are.
bool RankSession::on_device(const StructureOption& option, const Mesh& local) {
  report_.structure = option.name;
  bool here = false;
  detail::together(ranks_, [&] { here = option.on_device(local); });
  const bool everywhere = ranks_.least(std::int64_t(here)) == 1;
  report_.consumers = everywhere ? "device" : "host";
  return everywhere;
}

std::unique_ptr<Structure> RankSession::make_structure(const StructureOption& option, const Mesh& local,
                                                       RelationSet relations) {
  const Stopwatch watch(report_.seconds.initialize);
  begin_step("preparing the structure");
  std::unique_ptr<Structure> structure;
  detail::together(ranks_, [&] { structure = option.make(local, relations); });
  return structure;
}

DistributedGradient RankSession::find_gradient(const StructureOption& option, const FieldOnRanks& on) {
  return find(
      option, on.mesh.local(), discrete_gradient_relations,
      [&](Structure& local) { return find_discrete_gradient(local, on.order, sweep()); },
      [&] { return find_discrete_gradient(WorkerSpace(), on.order, option.device_sweep()); });
}

DistributedNumbers RankSession::number(const StructureOption& option, const DistributedMesh& mesh,
                                       const DistributedNamedSimplices& named) {
  const auto structure = make_structure(option, mesh.local(), simplex_numbers_relations);
  const Stopwatch watch(report_.seconds.run);
  begin_step("numbering simplices");
  return number_simplices(*structure, mesh, named, sweep());
}

SweepOptions RankSession::sweep() const {
  SweepOptions sweep;
  sweep.threads = report_.threads;
  return sweep;
}

template <class Piece>
void RankSession::write_pieces(const std::string& path, const Piece& piece) {
  if (path.empty()) return;
  const Stopwatch watch(report_.seconds.write);
  begin_step("writing", path);
  detail::together(ranks_, [&] {
    const io::AtomicFile& mine = files_.add(piece_of(path, ranks_.rank()));
    write_one(mine, piece);
    io::AtomicFiles::sync(mine);
    if (ranks_.rank() > 0) return;
    std::vector<std::string> pieces;
    for (int rank = 0; rank < ranks_.size(); ++rank)
      pieces.push_back(std::filesystem::path(piece_of(path, rank)).filename().string());
    const io::AtomicFile& all = files_.add(path);
    io::write_pieces(all, pieces, piece);
    io::AtomicFiles::sync(all);
  });
}

template void RankSession::write_pieces(const std::string&, const io::PointSet&);
template void RankSession::write_pieces(const std::string&, const io::Surface&);
template void RankSession::write_pieces(const std::string&, const io::MeshPiece&);

void RankSession::finish(const DistributedMesh& mesh) {
  const auto by_rank = [&](double value, double unit = 1) {
    return spread_of(ranks_.all(static_cast<std::int64_t>(value / unit)), unit);
  };
  constexpr double microsecond = 1e-6;
  const Seconds& seconds = report_.seconds;
  const double waited = ranks_.sent().seconds_waiting;
  const auto on_device = device_peak_bytes();
  report_.ranks = {
      {"count", ranks_.size()},
      {"owned_vertices", by_rank(mesh.local().owned_vertices())},
      {"tetrahedra", by_rank(mesh.local().tetrahedra())},
      {"host_peak_bytes", by_rank(static_cast<double>(host_peak_bytes()))},
      {"device_peak_bytes", on_device ? by_rank(static_cast<double>(*on_device)) : nlohmann::ordered_json(nullptr)},
      {"sent_messages", by_rank(static_cast<double>(ranks_.sent().messages))},
      {"sent_bytes", by_rank(static_cast<double>(ranks_.sent().bytes))},
      {"reading", by_rank(seconds.read, microsecond)},
      {"initializing", by_rank(seconds.initialize, microsecond)},
      {"running", by_rank(seconds.run, microsecond)},
      {"writing", by_rank(seconds.write, microsecond)},
      {"waiting", by_rank(waited, microsecond)}};
  console_.say("time", gale::app::seconds(seconds.total()) + " (initialize " + gale::app::seconds(seconds.initialize) +
                           ", run " + gale::app::seconds(seconds.run) + "); read " + gale::app::seconds(seconds.read));
  console_.say("memory", bytes(report_.ranks["host_peak_bytes"]["most"].get<double>()) + " at most, of one rank");
  const std::size_t results = files_.all().size();
  detail::together(ranks_, [&] {
    if (!common_.report.empty() && ranks_.rank() == 0) write_report(files_.add(common_.report), report_);
  });
  begin_step("writing", "the files");
  appear(results);
  end_steps();
}

void RankSession::appear(std::size_t results) {
  bool is_there = false;
  const auto agree = [&] {
    is_there = true;
    detail::together(ranks_, [] {});  // the files of others are there, too
    detail::together(ranks_, [&] {
      for (std::size_t i = 0; i < results; ++i) console_.say("wrote", files_.all()[i]->path());
    });
  };
  try {
    files_.commit(agree);
  } catch (...) {
    if (is_there) throw;
    detail::together(ranks_, [] { throw; });
  }
}

}  // namespace gale::app
