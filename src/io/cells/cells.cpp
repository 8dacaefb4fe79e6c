#include <limits>
#include <string>
#include <type_traits>

#include <gale/base/error.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/types.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/cells.hpp>

namespace gale::io::detail {
namespace {

using Host = Kokkos::DefaultHostExecutionSpace;
using Tetrahedra = decltype(Dataset::tetrahedra);

/// Calls use(vector) with the values if they are whole numbers; throws gale::Error otherwise. `what` they are.
template <class Use>
auto with_integers(const PointArray::Values& values, const char* what, const Use& use) {
  using Result = decltype(use(std::vector<std::int64_t>()));
  return std::visit(
      [&](const auto& v) -> Result {
        if constexpr (std::is_integral_v<typename std::decay_t<decltype(v)>::value_type>) {
          return use(v);
        } else {
          damaged("its ", what, " are no whole numbers");
        }
      },
      values);
}

void require_ids(std::size_t count, const char* of_what) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<Id>::max());
  if (count <= most) return;
  refuse("it has ", count, " ", of_what, ", more than the ", most, " that 32-bit ids can number");
}

[[noreturn]] void refuse_point(std::size_t cell, std::int64_t point, std::size_t points) {
  refuse("cell ", cell, " names point ", point, " of ", points);
}

/// The values as T, without a copy if they are. Throws gale::Error for one that T doesn't hold. `what` they are.
template <class T>
std::vector<T> taken_as(PointArray::Values& values, const char* what) {
  if (auto* const same = std::get_if<std::vector<T>>(&values)) return std::move(*same);
  return with_integers(values, what, [&](const auto& from) {
    std::vector<T> to(from.size());
    for (std::size_t k = 0; k < from.size(); ++k) {
      gale::detail::stop_if_asked_at(static_cast<Offset>(k));
      to[k] = static_cast<T>(from[k]);
      const bool fits = static_cast<std::decay_t<decltype(from[k])>>(to[k]) == from[k] && (to[k] < 0) == (from[k] < 0);
      if (!fits) damaged("one of its ", what, " is ", from[k]);
    }
    return to;
  });
}

using Types = std::vector<std::uint8_t>;

/// How many cells of each kind there are.
struct Census {
  std::size_t tetrahedra = 0, lower = 0, other = 0, first_other = 0;
};

/// Checks the types and where each cell lies.
template <class Ends>
Census take_census(const Types& types, const Ends& ends, std::size_t connectivity) {
  Census census;
  const CellType* known[256];
  for (int number = 0; number < 256; ++number) known[number] = find_cell_type(number);
  std::uint64_t begin = 0;
  for (std::size_t c = 0; c < types.size(); ++c) {
    gale::detail::stop_if_asked_at(static_cast<Offset>(c));
    const int number = types[c];
    const CellType* const type = known[number];
    if (type == nullptr) damaged("cell ", c, " has the unknown type ", number);
    const auto end = static_cast<std::uint64_t>(ends[c]);  // below 0 becomes a huge one
    if (end < begin || end > connectivity)
      damaged("cell ", c, " ends at ", ends[c], " in a connectivity of ", connectivity, ", and the one before it at ",
              begin);
    if (type->dimension == 3 && type->points > 0 && end - begin != static_cast<std::uint64_t>(type->points)) {
      damaged(
          (number == tetrahedron_type ? "the tetrahedron in cell " : std::string("the ") + type->name + " in cell "), c,
          " has ", end - begin, " points");
    }
    begin = end;
    if (number == tetrahedron_type) {
      ++census.tetrahedra;
    } else if (type->dimension < 3) {
      ++census.lower;
    } else if (census.other++ == 0) {
      census.first_other = c;
    }
  }
  return census;
}

/// Copies all cells, which are tetrahedra, in parallel.
template <class Connectivity>
void copy_all(const Connectivity& from, std::size_t points, const Tetrahedra& to) {
  const Offset count = to.extent(0);
  const auto wrong = [&](Offset t) {
    bool any = false;
    for (int k = 0; k < 4; ++k) {
      const auto id = from[4 * t + k];
      any |= static_cast<std::uint64_t>(id) >= points;
      to(t, k) = static_cast<Id>(id);
    }
    return any ? t : count;
  };
  const Offset first = reduce_min("GALE::copy_tetrahedra", Host(), count, count, wrong);
  if (first == count) return;
  for (int k = 0; k < 4; ++k) {
    const auto id = from[4 * first + k];
    if (static_cast<std::uint64_t>(id) >= points)
      refuse_point(static_cast<std::size_t>(first), static_cast<std::int64_t>(id), points);
  }
}

template <class Ends, class Connectivity>
void copy_some(const Types& types, const Ends& ends, const Connectivity& from, std::size_t points,
               const Tetrahedra& to) {
  std::size_t t = 0;
  for (std::size_t c = 0; c < types.size(); ++c) {
    gale::detail::stop_if_asked_at(static_cast<Offset>(c));
    if (types[c] != tetrahedron_type) continue;
    for (int k = 0; k < 4; ++k) {
      const auto id = from[static_cast<std::size_t>(ends[c]) - 4 + k];
      if (static_cast<std::uint64_t>(id) >= points) refuse_point(c, static_cast<std::int64_t>(id), points);
      to(t, k) = static_cast<Id>(id);
    }
    ++t;
  }
}

/// Checks the cells of dimension 3, and splits them into tetrahedra.
template <class Ends, class Connectivity>
Tetrahedra split(const MeshParts& parts, const Types& types, const Ends& ends, const Connectivity& connectivity,
                 std::size_t points) {
  std::vector<std::uint8_t> solid_types;
  std::vector<std::int64_t> solid_ends, solid_points;
  std::size_t begin = 0;
  for (std::size_t c = 0; c < types.size(); ++c) {
    gale::detail::stop_if_asked_at(static_cast<Offset>(c));
    const auto end = static_cast<std::size_t>(ends[c]);
    const CellType& type = *find_cell_type(types[c]);
    if (type.dimension == 3) {
      if (type.points == 0) refuse("cell ", c, " is a ", type.name, ", which isn't split");
      for (std::size_t k = begin; k < end; ++k) {
        const auto id = connectivity[k];
        if (static_cast<std::uint64_t>(id) >= points) refuse_point(c, static_cast<std::int64_t>(id), points);
        solid_points.push_back(static_cast<std::int64_t>(id));
      }
      solid_types.push_back(types[c]);
      solid_ends.push_back(static_cast<std::int64_t>(solid_points.size()));
    }
    begin = end;
  }
  const std::vector<std::int32_t> ids = split_cells(parts.points, solid_types, solid_ends, solid_points);
  if (ids.empty()) throw Error("it has no tetrahedra: its cells have no volume");
  require_ids(ids.size() / 4, "tetrahedra");
  const auto tetrahedra = allocate<Tetrahedra>("GALE::tetrahedra", ids.size() / 4);
  copy_all(ids, points, tetrahedra);
  return tetrahedra;
}

template <class Ends>
Tetrahedra to_tetrahedra(const MeshParts& parts, const Types& types, const Ends& ends, bool tetrahedralize,
                         bool may_be_empty, std::size_t points, Census& census) {
  if (types.size() != ends.size()) damaged("it has types of ", types.size(), " cells and offsets of ", ends.size());
  return with_integers(parts.cells.connectivity, "connectivities", [&](const auto& connectivity) {
    census = take_census(types, ends, connectivity.size());
    if (census.other > 0 && tetrahedralize) return split(parts, types, ends, connectivity, points);
    if (census.other > 0) refuse_solid(census.first_other, types[census.first_other]);
    if (census.tetrahedra == 0 && !may_be_empty) throw Error("it has no tetrahedra");
    require_ids(census.tetrahedra, "tetrahedra");
    const auto tetrahedra = allocate<Tetrahedra>("GALE::tetrahedra", census.tetrahedra);
    if (census.tetrahedra == types.size()) {
      copy_all(connectivity, points, tetrahedra);
    } else {
      copy_some(types, ends, connectivity, points, tetrahedra);
    }
    return tetrahedra;
  });
}

Tetrahedra to_tetrahedra(MeshParts& parts, bool tetrahedralize, bool may_be_empty, std::size_t points, Census& census) {
  const Types types = taken_as<std::uint8_t>(parts.cells.types, "types");
  if (std::holds_alternative<std::vector<std::int32_t>>(parts.cells.ends)) {
    const auto ends = taken_as<std::int32_t>(parts.cells.ends, "offsets");
    return to_tetrahedra(parts, types, ends, tetrahedralize, may_be_empty, points, census);
  }
  const auto ends = taken_as<std::int64_t>(parts.cells.ends, "offsets");
  return to_tetrahedra(parts, types, ends, tetrahedralize, may_be_empty, points, census);
}

template <class Coordinate>
Dataset::Points<Coordinate> to_points(const PointArray::Values& values) {
  const auto points = allocate<Dataset::Points<Coordinate>>("GALE::points", count_of(values) / 3);
  std::visit(
      [&](const auto& from) {
        parallel_for("GALE::copy_points", Host(), points.extent(0), [&](Offset i) {
          for (int d = 0; d < 3; ++d) points(i, d) = static_cast<Coordinate>(from[3 * i + d]);
        });
      },
      values);
  return points;
}

}  // namespace

void refuse_solid(std::size_t cell, int type) {
  refuse("cell ", cell, " is a ", find_cell_type(type)->name, ", not a tetrahedron (tetrahedralize splits such cells)");
}

std::string note_array(const std::string& name, const std::string& why) {
  return "left out the point array '" + name + "': " + why;
}

std::string note_cell_arrays(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
  return "left out the cell arrays " + list;
}

Dataset to_mesh(MeshParts& parts, bool tetrahedralize, bool may_be_empty) {
  const std::size_t points = count_of(parts.points) / 3;
  require_ids(points, "points");
  for (const PointArray& array : parts.arrays) require_size(array, points);
  Dataset mesh;
  Census census;
  mesh.tetrahedra = to_tetrahedra(parts, tetrahedralize, may_be_empty, points, census);
  parts.cells = {};
  if (std::holds_alternative<std::vector<double>>(parts.points)) {
    mesh.points = to_points<double>(parts.points);
  } else {
    mesh.points = to_points<float>(parts.points);
  }
  parts.points = std::vector<float>();
  mesh.arrays = std::move(parts.arrays);
  if (census.lower > 0)
    mesh.notices.push_back("left out " + std::to_string(census.lower) + " cells of a dimension below 3");
  mesh.notices.insert(mesh.notices.end(), parts.notices.begin(), parts.notices.end());
  return mesh;
}

}  // namespace gale::io::detail
