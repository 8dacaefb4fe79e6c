#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gale/base/threads.hpp>
#include <gale/runtime/defaults.hpp>
#include <gale/ttk/connectivity.hpp>

namespace gale::ttk {

namespace {

/// The part of all segments that whoever goes through `n` simplices by their numbers has to keep at one time, so that
/// few are met again after they were let go. in(segment): where input[] has the numbers of a segment's simplices.
///
/// A segment is kept from one of its simplices to the next, but for the longest waits, one for every eight segments.
template <class In>
double kept_at_one_time(Id segments, Id n, const In& in, const Id* input) {
  constexpr Id looked_at = 256, met_again = 8;
  const Id step = segments / looked_at + 1, sample = (segments + step - 1) / step;
  std::vector<Id> numbers, waits;
  for (Id segment = 0; segment < segments; segment += step) {
    const Interval held = in(segment);
    numbers.assign(input + held.first, input + held.last);
    std::sort(numbers.begin(), numbers.end());
    for (std::size_t i = 1; i < numbers.size(); ++i) waits.push_back(numbers[i] - numbers[i - 1]);
  }
  const std::size_t too_long = sample / met_again;
  if (waits.size() <= too_long) return 0;
  const auto longest = waits.end() - 1 - static_cast<std::ptrdiff_t>(too_long);
  std::nth_element(waits.begin(), longest, waits.end());
  double kept = double(*longest) * sample;  // after a segment's last simplex
  for (const Id wait : waits) kept += std::min(wait, *longest);
  return kept / sample / n;
}

}  // namespace

/// Whether numbers follow places, more or less: those of vertices, or those of cells, which those of edges and
/// triangles follow.
bool Connectivity::is_by_place(int dimension) const {
  constexpr double most = 0.25;
  auto& known = by_place_[dimension == 0 ? 0 : 1];
  if (!known) {
    const auto in_cells = [&](Id segment) {
      const auto& begin = mesh_->interval_begin(mesh_->dimension());
      return Interval{begin(segment), begin(segment + 1)};
    };
    const auto in_vertices = [&](Id segment) { return segments_.vertices(segment); };
    const Id segments = segments_.count();
    known = (dimension == 0 ? kept_at_one_time(segments, counts_[0], in_vertices, vertex_input_)
                            : kept_at_one_time(segments, counts_[3], in_cells, mesh_->cell_input().data())) < most;
  }
  return *known;
}

/// For blocks. VV and VT of a regular mesh take 192 bytes a vertex, and one sweep makes them all. Of other rows, those
/// that TTK's threads go through at one time suffice: each has a part of the vertices, in the caller's order, hence
/// comes by the segments of some layers again and again. More made nothing faster. Where that order has nothing to do
/// with places, each row is in another segment than the last: what is dropped would be made again at once, so that all
/// stays, which is what an explicit triangulation holds.
std::size_t Connectivity::default_memory() const {
  for (const Relation relation : members_of(wanted_rows_)) {
    if (!is_by_place(row_dimension(relation))) return std::numeric_limits<std::size_t>::max();
  }
  const Id vertices = counts_[0];
  const auto stars = std::size_t(192) * vertices;
  if ((RelationSet(Relation::VV) | Relation::VT).contains(wanted_rows_))
    return std::max(stars, 16 * gale::detail::mebibyte);
  constexpr double layers = 5.3, bytes_of_vertex = 300;
  const double side = std::cbrt(vertices), passed = layers * bytes_of_vertex * side * side * host_threads();
  const auto most = std::min(static_cast<std::size_t>(passed), stars);
  return std::max({most, std::size_t(40) * vertices, 16 * gale::detail::mebibyte});
}

}  // namespace gale::ttk
