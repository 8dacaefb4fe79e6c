#include <algorithm>
#include <utility>

#include <gale/io/bytes/value_type.hpp>
#include <gale/io/cells/join.hpp>

namespace gale::io::detail {

ArraysByKind by_kind(std::vector<PointArray>& arrays) {
  ArraysByKind result;
  for (PointArray& array : arrays)
    result.emplace(std::tuple(array.name, array.components, array.values.index()), &array);
  return result;
}

PointArray* find_alike(const ArraysByKind& arrays, const PointArray& array) {
  const auto found = arrays.find(std::tuple(array.name, array.components, array.values.index()));
  return found == arrays.end() ? nullptr : found->second;
}

void JoinedPieces::add_arrays(std::vector<PointArray>& from) {
  if (!has_arrays_) {
    arrays_ = std::move(from);
    has_arrays_ = true;
    return;
  }
  const ArraysByKind others = by_kind(from);
  const auto is_missing = [&](PointArray& array) {
    const PointArray* const more = find_alike(others, array);
    if (more == nullptr) {
      notices_.push_back("left out the point array '" + array.name + "': not all pieces have it");
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

void JoinedPieces::add(MeshParts piece, std::int64_t first_point) {
  const auto begin = static_cast<std::int64_t>(connectivity_.size());
  is_double_ |= std::holds_alternative<std::vector<double>>(piece.points);
  append(piece.points, 0.0, points_);
  append(piece.cells.types, std::int64_t(0), types_);
  append(piece.cells.ends, begin, ends_);
  append(piece.cells.connectivity, first_point, connectivity_);
  if (count_of(piece.points) > 0) add_arrays(piece.arrays);  // an empty piece may leave out arrays
  for (std::string& notice : piece.notices) {
    if (known_notices_.insert(notice).second) notices_.push_back(std::move(notice));
  }
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
  all.notices = std::move(notices_);
  return all;
}

}  // namespace gale::io::detail
