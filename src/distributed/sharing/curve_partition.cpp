#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include <gale/base/parallel.hpp>
#include <gale/distributed/sharing/vertex_directory.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/mesh/octree.hpp>

namespace gale::detail {

namespace {

/// A place on the curve.
using CurvePlace = std::pair<std::uint64_t, GlobalId>;

/// Samples of each rank's share: so many that shares differ by a few percent.
constexpr Offset samples_a_rank = 4096;

template <class Rows>
using CoordinateOf = typename Rows::non_const_value_type;

Box box_of_all(const Communicator& ranks, const HostPoints& points) {
  Box box{};
  together(ranks, [&] {
    box = points.visit([](const auto& rows) {
      return bounding_box<CoordinateOf<std::decay_t<decltype(rows)>>>(HostExecutionSpace(), rows);
    });
  });
  for (double& low : box.low) low = ranks.least(low);
  for (double& high : box.high) high = -ranks.least(-high);
  return box;
}

/// Some of this rank's stops, as many of the samples as it has points among all; sent to every rank.
EntriesByRank<CurvePlace> sampled(const Communicator& ranks, const std::vector<std::int64_t>& points_by_rank,
                                  const std::vector<CurvePlace>& stops) {
  double all = 0;
  for (const std::int64_t points : points_by_rank) all += static_cast<double>(points);
  const auto count = stops.empty() ? Offset(0)
                                   : static_cast<Offset>(static_cast<double>(samples_a_rank * ranks.size()) *
                                                         (static_cast<double>(stops.size()) / all)) +
                                         1;
  const EntriesByRank<CurvePlace> sent =
      room_by_rank<CurvePlace>("GALE::samples", std::vector<std::int64_t>(ranks.size(), count));
  std::mt19937_64 random(static_cast<std::uint64_t>(ranks.rank()));
  for (Offset i = 0; i < count; ++i) {
    const CurvePlace stop = stops[random() % stops.size()];
    for (int rank = 0; rank < ranks.size(); ++rank) sent.entries(sent.begin[rank] + i) = stop;
  }
  return sent;
}

}  // namespace

Array<int, HostMemory> curve_partition(const Communicator& ranks, const Array<const GlobalId, HostMemory>& ids,
                                       const HostPoints& points) {
  const Cube cube = cube_around(box_of_all(ranks, points));
  const auto points_by_rank = ranks.all(points.count());
  std::vector<CurvePlace> stops;
  EntriesByRank<CurvePlace> samples;
  together(ranks, [&] {
    const auto codes = points.visit([&](const auto& rows) {
      return morton_codes<CoordinateOf<std::decay_t<decltype(rows)>>>(HostExecutionSpace(), rows, cube);
    });
    stops.resize(points.count());
    parallel_for("GALE::curve_stops", HostExecutionSpace(), points.count(), [&](Offset i) {
      stops[i] = {codes(i), ids(i)};
    });
    samples = sampled(ranks, points_by_rank, stops);
  });
  const EntriesByRank<CurvePlace> all = exchange(ranks, "GALE::all_samples", samples);
  Array<int, HostMemory> owners;
  together(ranks, [&] {
    std::sort(all.entries.data(), all.entries.data() + all.count());
    std::vector<CurvePlace> last;  // where each rank but the last one ends
    for (int rank = 1; rank < ranks.size() && all.count() > 0; ++rank)
      last.push_back(all.entries(part_begin(all.count(), ranks.size(), rank)));
    owners = tabulated<int>("GALE::curve_owners", points.count(), [&](Offset i) {
      return static_cast<int>(std::lower_bound(last.begin(), last.end(), stops[i]) - last.begin());
    });
  });
  return owners;
}

}  // namespace gale::detail
