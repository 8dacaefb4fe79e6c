#include <algorithm>
#include <tuple>
#include <utility>

#include <gale/base/parallel_sort.hpp>
#include <gale/io/arrays.hpp>
#include <gale/io/cells/number_by_ids.hpp>

namespace gale::io::detail {

namespace {

using Numbers = std::vector<std::int64_t>;

/// Sorts ids; returns where each was.
Numbers sort(Numbers& ids) {
  std::vector<std::pair<std::int64_t, std::int64_t>> sorted(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) sorted[i] = {ids[i], static_cast<std::int64_t>(i)};
  parallel_sort("GALE::sort_input_ids", sorted.begin(), sorted.end());
  Numbers places(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) std::tie(ids[i], places[i]) = sorted[i];
  return places;
}

}  // namespace

void number_points(Numbers& ids, MeshParts& parts) {
  if (std::is_sorted(ids.begin(), ids.end())) return;
  const Numbers places = sort(ids);
  PointArray points{"", 3, std::move(parts.points)};
  parts.points = gather(points, places).values;
  for (PointArray& array : parts.arrays) array = gather(array, places);
  Numbers number(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) number[places[i]] = static_cast<std::int64_t>(i);
  for (std::int64_t& point : std::get<Numbers>(parts.cells.connectivity)) point = number[point];
}

void number_cells(Numbers& ids, Cells& cells) {
  if (std::is_sorted(ids.begin(), ids.end())) return;
  const Numbers places = sort(ids), types = std::get<Numbers>(std::move(cells.types)),
                ends = std::get<Numbers>(std::move(cells.ends)),
                connectivity = std::get<Numbers>(std::move(cells.connectivity));
  Numbers new_types, new_ends, new_connectivity;
  new_types.reserve(types.size());
  new_ends.reserve(ends.size());
  new_connectivity.reserve(connectivity.size());
  for (const std::int64_t cell : places) {
    const auto begin = connectivity.begin() + (cell == 0 ? 0 : ends[cell - 1]);
    new_connectivity.insert(new_connectivity.end(), begin, connectivity.begin() + ends[cell]);
    new_types.push_back(types[cell]);
    new_ends.push_back(static_cast<std::int64_t>(new_connectivity.size()));
  }
  cells = {std::move(new_types), std::move(new_ends), std::move(new_connectivity)};
}

}  // namespace gale::io::detail
