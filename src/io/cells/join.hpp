#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <gale/export.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/cells.hpp>

namespace gale::io::detail {

/// All values behind those of `to`, in its type, with `offset` added.
template <class To>
void append(const PointArray::Values& from, To offset, std::vector<To>& to) {
  std::visit(
      [&](const auto& values) {
        const std::size_t wanted = to.size() + values.size();
        if (wanted > to.capacity()) to.reserve(std::max(wanted, 2 * to.capacity()));  // pieces may be many and small
        for (const auto value : values) {
          if constexpr (std::is_integral_v<To>) {
            // What is no such place may be any number: their sum goes around, as signed ones may not.
            to.push_back(static_cast<To>(static_cast<std::uint64_t>(static_cast<To>(value)) +
                                         static_cast<std::uint64_t>(offset)));
          } else {
            to.push_back(static_cast<To>(value) + offset);
          }
        }
      },
      from);
}

/// What arrays of several pieces have in common that become one: name, components, type.
using ArrayKind = std::tuple<std::string, int, std::size_t>;
ArrayKind kind_of(const PointArray& array);

/// Arrays by their kinds. Of two alike the first counts. The arrays must stay.
using ArraysByKind = std::map<ArrayKind, PointArray*>;
GALE_EXPORT ArraysByKind by_kind(std::vector<PointArray>& arrays);
GALE_EXPORT PointArray* find_alike(const ArraysByKind& arrays, const PointArray& array);

/// Texts in the order in which they come, each once.
class DistinctTexts {
 public:
  void add(const std::string& text) {
    if (known_.insert(text).second) all_.push_back(text);
  }
  void add(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) add(text);
  }

  std::vector<std::string> take() { return std::move(all_); }

 private:
  std::vector<std::string> all_;
  std::set<std::string> known_;
};

/// The notice about a point array that is left out as not all pieces have it.
GALE_EXPORT std::string note_missing(const PointArray& array);

/// Calls visit(cell, point) for each point that the cells from `first` on name: what polyhedra have besides are counts.
/// Cells may be unchecked: it ends where one leaves the connectivity.
template <class Visit>
void for_each_point(const std::vector<std::int64_t>& types, const std::vector<std::int64_t>& ends, std::size_t first,
                    std::vector<std::int64_t>& connectivity, const Visit& visit) {
  const auto size = static_cast<std::int64_t>(connectivity.size());
  std::int64_t at = first == 0 ? 0 : ends[first - 1];
  for (std::size_t cell = first; cell < std::min(types.size(), ends.size()); ++cell) {
    const std::int64_t end = ends[cell];
    if (at < 0 || at > end || end > size) return;
    if (types[cell] != cell_type::polyhedron) {
      for (; at < end; ++at) visit(cell, connectivity[static_cast<std::size_t>(at)]);
    } else if (at < end) {
      for (++at; at < end;) {
        const std::int64_t corners = connectivity[static_cast<std::size_t>(at++)];
        for (std::int64_t k = 0; k < corners && at < end; ++k, ++at)
          visit(cell, connectivity[static_cast<std::size_t>(at)]);
      }
    }
  }
}

/// Pieces of a mesh, one behind the other. Of their arrays those stay that all pieces have which have points, with a
/// notice about each other one. Nothing else of the cells is checked.
class JoinedPieces {
 public:
  /// A piece whose points are numbered from 0 on, behind the points before. Throws gale::Error for a cell that names
  /// another one: it could be the next piece's.
  void add(MeshParts piece) {
    const bool has_points = count_of(piece.points) > 0;
    add(std::move(piece), true, has_points);
  }

  /// A piece whose cells name all points by their places among the joined ones. Its arrays count where it `has_points`,
  /// even if pieces before have all of these.
  void add_numbered(MeshParts piece, bool has_points) { add(std::move(piece), false, has_points); }

  std::size_t points() const { return points_.size() / 3; }

  MeshParts take();

 private:
  void add(MeshParts piece, bool has_own_numbers, bool has_points);
  void add_arrays(std::vector<PointArray>& from);

  // One type for all that pieces may have in different ones.
  std::vector<double> points_;
  std::vector<std::int64_t> types_, ends_, connectivity_;
  std::vector<PointArray> arrays_;
  DistinctTexts notices_;
  bool is_double_ = false, has_arrays_ = false;
};

/// Puts points and their arrays in the order of their ids, which differ, and has cells name them by their new places.
/// Cells are numbers of type int64 that were checked. `ids` are in that order then, too.
void number_points(std::vector<std::int64_t>& ids, MeshParts& parts);

/// Puts cells in the order of their ids; where these are equal, cells stay in the order in which they are. Types, ends
/// and connectivity are of type int64 and were checked.
void number_cells(std::vector<std::int64_t>& ids, FileCells& cells);

}  // namespace gale::io::detail
