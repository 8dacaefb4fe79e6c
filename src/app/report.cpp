#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <gale/app/machine.hpp>
#include <gale/app/report.hpp>
#include <gale/base/device.hpp>
#include <gale/base/kokkos.hpp>
#include <gale/io/formats.hpp>
#include <gale/version.hpp>

namespace gale::app {

namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json to_json(const Seconds& seconds) {
  return {{"read", seconds.read}, {"segment", seconds.segment}, {"initialize", seconds.initialize},
          {"run", seconds.run},   {"write", seconds.write},     {"total", seconds.total()}};
}

/// Parts that add up to the age of the process.
Json to_json(const WallClock& wall, const Seconds& seconds) {
  const double all = std::max(process_age(), wall.start), make = seconds.write - wall.compress - wall.store;
  const double other = all - wall.start - seconds.read - seconds.total() - seconds.write;
  return {{"start", wall.start},
          {"read", seconds.read},
          {"compute", seconds.total()},
          {"make", make},
          {"compress", wall.compress},
          {"store", wall.store},
          {"other", std::max(other, 0.0)},
          {"total", all},
          {"processor", processor_seconds()}};
}

Json to_json(const WaitingTimes& waiting) {
  return {{"push", waiting.push},
          {"queue", waiting.queue},
          {"preparation", waiting.preparation},
          {"kernel_and_transfer", waiting.kernel_and_transfer},
          {"integration", waiting.integration},
          {"total", waiting.total()}};
}

Json to_json(const LeaderStatistics& leader) {
  return {
      {"relations", name_of(leader.relations)},
      {"batches", leader.batches},
      {"segments_computed", leader.segments_computed},
      {"segments_per_batch",
       leader.batches > 0 ? static_cast<double>(leader.segments_computed) / static_cast<double>(leader.batches) : 0.0},
      {"segments_recomputed", leader.segments_recomputed},
      {"bytes", leader.bytes},
      {"blocks_evicted", leader.blocks_evicted},
      {"batches_split", leader.batches_split},
      {"queue_lengths",
       {{"mean", leader.queue_lengths.mean()},
        {"median", leader.queue_lengths.median()},
        {"deviation", leader.queue_lengths.deviation()}}}};
}

Json to_json(const StructureStatistics& statistics) {
  const ConsumerStatistics all = statistics.all_consumers();
  Json each = Json::array(), stages_of_each = Json::array();
  double longest = 0;
  for (const auto& one : statistics.consumers) {
    each.push_back(one.waiting.total());
    stages_of_each.push_back(to_json(one.waiting));
    longest = std::max(longest, one.waiting.total());
  }
  Json leaders = Json::array();
  for (const auto& leader : statistics.leaders) leaders.push_back(to_json(leader));
  return {{"consumers", statistics.consumers.size()},
          {"hits", all.hits},
          {"requests", all.requests},
          {"seconds", to_json(all.waiting)},
          {"longest_seconds", longest},
          {"seconds_of_each", each},
          {"stages_of_each", stages_of_each},
          {"segments_computed_by_consumers", all.segments_computed},
          {"seconds_computing_by_consumers", all.seconds_computing},
          {"segments_computed_by_helpers", statistics.helpers.segments_computed},
          {"seconds_computing_by_helpers", statistics.helpers.seconds_computing},
          {"leaders", leaders},
          {"host_block_bytes", statistics.host_bytes}};
}

/// By rank the least, the median and the most.
Json spread_of(std::vector<std::int64_t> by_rank, double unit) {
  std::sort(by_rank.begin(), by_rank.end());
  const auto value = [&](std::size_t at) { return unit == 1 ? Json(by_rank[at]) : Json(unit * double(by_rank[at])); };
  return {{"least", value(0)}, {"median", value(by_rank.size() / 2)}, {"most", value(by_rank.size() - 1)}};
}

}  // namespace

Json to_json(const Report& report) {
  return {{"gale", gale::version},
          {"kokkos", kokkos_version()},
          {"backend", WorkerSpace::name()},
          {"device", or_null(device_name())},
          {"threads", report.threads},
          {"structure", or_null(report.structure)},
          {"way", or_null(report.way)},
          {"consumers", or_null(report.consumers)},
          {"input", report.input},
          {"notices", report.notices},
          {"mesh",
           {{"vertices", or_null(report.vertices)},
            {"edges", or_null(report.edges)},
            {"triangles", or_null(report.triangles)},
            {"tetrahedra", or_null(report.tetrahedra)},
            {"segments", or_null(report.segments)}}},
          {"seconds", to_json(report.seconds)},
          {"wall", to_json(report.wall, report.seconds)},
          {"memory", {{"host_peak_bytes", host_peak_bytes()}, {"device_peak_bytes", or_null(device_peak_bytes())}}},
          {"ranks", report.ranks},
          {"waiting", report.statistics ? to_json(*report.statistics) : Json(nullptr)},
          {"result", report.result},
          {"steps", report.steps}};
}

void Report::add_step(const io::Step& step, const Seconds& took) {
  steps.push_back({{"time", step.time}, {"input", step.file}, {"seconds", to_json(took)}, {"result", result}});
  result = Json::object();
}

void report_structure(const Structure& structure, Report& report) {
  const auto known = [](Id count) { return count == no_id ? std::nullopt : std::optional<std::int64_t>(count); };
  report.edges = known(structure.count(1));
  report.triangles = known(structure.count(2));
  report.way = structure.name();
  if (structure.way() != Way::explicit_) report.statistics = structure.statistics();
}

void write_text(const io::AtomicFile& file, const std::function<void(std::ostream&)>& write) {
  errno = 0;
  try {
    std::ofstream out;
    out.exceptions(std::ios::badbit | std::ios::failbit);  // which keeps errno as the failed write left it
    out.open(file.temporary());
    write(out);
    out.close();
  } catch (const std::ios::failure&) {
    io::refuse_to_write(file.path(), errno != 0 ? std::strerror(errno) : "not all of it could be written");
  }
}

void write_table(const io::AtomicFile& file, const std::vector<io::PointArray>& columns) {
  const auto write = std::get<io::detail::TableWriter*>(io::format_of(file.path())->writer);
  write_text(file, [&](std::ostream& out) { out << write(columns); });
}

void write_report(const io::AtomicFile& file, const Report& report) {
  // Names of files and arrays need not be UTF-8, as JSON must be.
  const std::string text = to_json(report).dump(2, ' ', false, Json::error_handler_t::replace);
  write_text(file, [&](std::ostream& out) { out << text << '\n'; });
}

Json differences_of_ranks(const Ranks& ranks, const Mesh& part, const Seconds& seconds) {
  const auto by_rank = [&](double value, double unit = 1) {
    return spread_of(ranks.all(static_cast<std::int64_t>(value / unit)), unit);
  };
  constexpr double microsecond = 1e-6;
  const auto on_device = device_peak_bytes();
  return {{"count", ranks.size()},
          {"owned_vertices", by_rank(part.owned_vertices().size())},
          {part.dimension() == 3 ? "tetrahedra" : "triangles", by_rank(part.cells())},
          {"host_peak_bytes", by_rank(static_cast<double>(host_peak_bytes()))},
          {"device_peak_bytes", on_device ? by_rank(static_cast<double>(*on_device)) : Json(nullptr)},
          {"sent_messages", by_rank(static_cast<double>(ranks.sent().messages))},
          {"sent_bytes", by_rank(static_cast<double>(ranks.sent().bytes))},
          {"gathered_bytes", by_rank(static_cast<double>(ranks.sent().gathered))},
          {"reading", by_rank(seconds.read, microsecond)},
          {"initializing", by_rank(seconds.initialize, microsecond)},
          {"running", by_rank(seconds.run, microsecond)},
          {"writing", by_rank(seconds.write, microsecond)},
          {"waiting", by_rank(ranks.sent().seconds_waiting, microsecond)}};
}

}  // namespace gale::app
