#include <algorithm>
#include <utility>

#include <gale/io/bytes/value_type.hpp>
#include <gale/io/cells/join.hpp>

namespace gale::io::detail {

void JoinedPieces::add_arrays(std::vector<PointArray>& from) {
  if (!has_arrays_) {
    arrays_ = std::move(from);
    has_arrays_ = true;
    return;
  }
  const auto same = [](const PointArray& a, const PointArray& b) {
    return a.name == b.name && a.components == b.components && a.values.index() == b.values.index();
  };
  for (auto array = arrays_.begin(); array != arrays_.end();) {
    const auto more = std::find_if(from.begin(), from.end(), [&](const PointArray& a) { return same(*array, a); });
    if (more == from.end()) {
      notices_.push_back("left out the point array '" + array->name + "': not all pieces have it");
      array = arrays_.erase(array);
      continue;
    }
    std::visit(
        [&](auto& values) {
          const auto& others = std::get<std::decay_t<decltype(values)>>(more->values);
          values.insert(values.end(), others.begin(), others.end());
        },
        array->values);
    ++array;
  }
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
    if (std::find(notices_.begin(), notices_.end(), notice) == notices_.end()) notices_.push_back(std::move(notice));
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
