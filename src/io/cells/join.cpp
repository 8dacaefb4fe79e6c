#include <algorithm>
#include <tuple>
#include <utility>

#include <gale/base/sort.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/join.hpp>
#include <gale/io/dataset.hpp>

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

ArrayKind kind_of(const PointArray& array) { return {array.name, array.components, array.values.index()}; }

ArraysByKind by_kind(std::vector<PointArray>& arrays) {
  ArraysByKind result;
  for (PointArray& array : arrays) result.emplace(kind_of(array), &array);
  return result;
}

PointArray* find_alike(const ArraysByKind& arrays, const PointArray& array) {
  const auto found = arrays.find(kind_of(array));
  return found == arrays.end() ? nullptr : found->second;
}

std::string note_missing(const PointArray& array) { return note_array(array.name, "not all pieces have it"); }

void JoinedPieces::add_arrays(std::vector<PointArray>& from) {
  if (!has_arrays_) {
    arrays_ = std::move(from);
    has_arrays_ = true;
    return;
  }
  const ArraysByKind known = by_kind(arrays_), others = by_kind(from);
  for (const PointArray& array : from) {
    if (find_alike(known, array) == nullptr) notices_.add(note_missing(array));
  }
  const auto is_missing = [&](PointArray& array) {
    const PointArray* const more = find_alike(others, array);
    if (more == nullptr) {
      notices_.add(note_missing(array));
      return true;
    }
    std::visit(
        [&](auto& values) {
          const auto& behind = std::get<std::decay_t<decltype(values)>>(more->values);
          values.insert(values.end(), behind.begin(), behind.end());
        },
        array.values);
    return false;
  };
  arrays_.erase(std::remove_if(arrays_.begin(), arrays_.end(), is_missing), arrays_.end());
}

void JoinedPieces::add(MeshParts piece, bool has_own_numbers, bool has_points) {
  const auto begin = static_cast<std::int64_t>(connectivity_.size()), first_point = static_cast<std::int64_t>(points()),
             own_points = static_cast<std::int64_t>(count_of(piece.points) / 3);
  is_double_ |= std::holds_alternative<std::vector<double>>(piece.points);
  append(piece.points, 0.0, points_);
  const std::size_t first_cell = std::min(types_.size(), ends_.size());
  append(piece.cells.types, std::int64_t(0), types_);
  append(piece.cells.ends, begin, ends_);
  append(piece.cells.connectivity, std::int64_t(0), connectivity_);
  if (has_own_numbers) {
    for_each_point(types_, ends_, first_cell, connectivity_, [&](std::size_t cell, std::int64_t& point) {
      if (point < 0 || point >= own_points)
        refuse("cell ", cell, " names point ", point, " of the ", own_points, " of its piece");
      point += first_point;
    });
  }
  if (has_points) add_arrays(piece.arrays);  // an empty piece may leave out arrays
  notices_.add(piece.notices);
}

MeshParts JoinedPieces::take() {
  MeshParts all;
  if (is_double_) {
    all.points = std::move(points_);
  } else {
    all.points = std::vector<float>(points_.begin(), points_.end());
  }
  all.cells = {std::move(types_), std::move(ends_), std::move(connectivity_)};
  all.arrays = std::move(arrays_);
  all.notices = notices_.take();
  return all;
}

void number_points(Numbers& ids, MeshParts& parts) {
  if (std::is_sorted(ids.begin(), ids.end())) return;
  const Numbers places = sort(ids);
  PointArray points{"", 3, std::move(parts.points)};
  parts.points = gather(points, places).values;
  for (PointArray& array : parts.arrays) array = gather(array, places);
  Numbers number(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) number[places[i]] = static_cast<std::int64_t>(i);
  for_each_point(std::get<Numbers>(parts.cells.types), std::get<Numbers>(parts.cells.ends), 0,
                 std::get<Numbers>(parts.cells.connectivity),
                 [&](std::size_t, std::int64_t& point) { point = number[point]; });
}

void number_cells(Numbers& ids, FileCells& cells) {
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
