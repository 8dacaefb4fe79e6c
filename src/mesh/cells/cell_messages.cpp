#include <algorithm>

#include <gale/base/atomic.hpp>
#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/mesh/cells/cell_messages.hpp>
#include <gale/mesh/cells/split_cell.hpp>

namespace gale {

namespace detail {

namespace {

/// "12 hexahedra, 4 pyramids and 3 wedges", of the types that are wanted.
template <class IsWanted>
std::string list_of(const Census& census, const IsWanted& is_wanted) {
  std::vector<std::string> all;
  for (int number = 0; number < 256; ++number) {
    const CellType* const type = find_cell_type(number);
    if (census[number] == 0 || type == nullptr || !is_wanted(*type)) continue;
    all.push_back(grouped(census[number]) + ' ' + (type->plural != nullptr ? type->plural : type->name));
  }
  std::string list;
  for (std::size_t k = 0; k < all.size(); ++k) list += (k == 0 ? "" : k + 1 == all.size() ? " and " : ", ") + all[k];
  return list;
}

/// Counts the types of a piece of the cells, those of one type that follow each other at once.
template <class Memory>
struct CountTypes {
  Array<const std::uint8_t, Memory> types;
  Array<Offset, Memory> counts;
  Offset cells_of_piece;

  KOKKOS_FUNCTION void operator()(Offset piece) const {
    const Offset cells = types.extent(0),
                 end = (piece + 1) * cells_of_piece < cells ? (piece + 1) * cells_of_piece : cells;
    for (Offset cell = piece * cells_of_piece; cell < end;) {
      const int type = types(cell);
      const Offset first = cell;
      while (cell < end && types(cell) == type) ++cell;
      atomic_add(&counts(type), cell - first);
    }
  }
};

}  // namespace

template <class Memory>
Census census_of(const Array<const std::uint8_t, Memory>& types) {
  constexpr Offset cells_of_piece = 256;
  const Offset pieces = (static_cast<Offset>(types.extent(0)) + cells_of_piece - 1) / cells_of_piece;
  const Array<Offset, Memory> counts("GALE::census", std::tuple_size_v<Census>);
  parallel_for("GALE::census", SpaceOf<Memory>(), pieces, CountTypes<Memory>{types, counts, cells_of_piece});
  const auto counted = Kokkos::create_mirror_view_and_copy(HostMemory(), counts);
  Census census;
  std::copy_n(counted.data(), census.size(), census.begin());
  return census;
}

template Census census_of(const Array<const std::uint8_t, HostMemory>&);
#if defined(GALE_HAS_DEVICE)
template Census census_of(const Array<const std::uint8_t, WorkerMemory>&);
#endif

void refuse_cell(Offset cell, int number, Offset begin, Offset end, Offset connectivity, Offset points,
                 const CellRules& rules, const std::vector<std::int64_t>& entries) {
  const std::string name = "cell " + std::to_string(cell);
  const CellType* const type = find_cell_type(number);
  if (type == nullptr) throw Error(name + " has the unknown type " + std::to_string(number));
  if (begin < 0 || end < begin || end > connectivity) {
    throw Error(name + " ends at " + std::to_string(end) + " in a connectivity of " + std::to_string(connectivity) +
                ", and the one before it at " + std::to_string(begin));
  }
  const std::string what = name + " is a " + type->name;
  if (rules.rule[number] == CellRule::refuse)
    throw Error(what + ", which isn't split" + (type->plural == nullptr ? "" : " into triangles"));
  const auto require_points = [&](std::int64_t point) {
    if (point < 0 || point >= points)
      throw Error(name + " names point " + std::to_string(point) + " of " + std::to_string(points));
  };
  if (rules.rule[number] == CellRule::polyhedron) {
    const FaceFault fault = fault_of_polyhedron(entries.data(), static_cast<Offset>(entries.size()), points);
    if (fault == FaceFault::open) throw Error(what + " whose faces don't close: one of its edges is in one face only");
    if (fault == FaceFault::point) {
      for (std::size_t face = 1; face < entries.size(); face += static_cast<std::size_t>(entries[face]) + 1) {
        for (std::int64_t k = 1; k <= entries[face]; ++k) require_points(entries[face + static_cast<std::size_t>(k)]);
      }
    }
    throw Error(what + " whose faces aren't " +
                (entries.empty() ? "there"
                                 : "what its " + std::to_string(entries.size()) +
                                       " entries say: how many, and of each how many corners, and these"));
  }
  const std::string size = std::to_string(entries.size());
  if (type->points != 0 && static_cast<std::size_t>(type->points) != entries.size())
    throw Error(what + " of " + size + " points, not " + std::to_string(type->points));
  if (type->points == 0 && entries.size() < 3) throw Error(what + " of " + size + " points");
  for (const std::int64_t point : entries) require_points(point);
  throw Error(what + " that is not valid");
}

}  // namespace detail

std::vector<std::string> notices_of_split(const std::array<Offset, 256>& cells, Offset simplices, int corners) {
  const auto& rule = detail::cell_rules(corners).rule;
  Offset lower = 0, as_they_are = 0;
  for (int type = 0; type < 256; ++type) {
    lower += rule[type] == detail::CellRule::skip ? cells[type] : 0;
    as_they_are += rule[type] == detail::CellRule::simplex ? cells[type] : 0;
  }
  const std::string split = detail::list_of(cells, [&](const CellType& type) {
    return rule[type.number] != detail::CellRule::skip && rule[type.number] != detail::CellRule::simplex;
  });
  std::vector<std::string> notices;
  if (!split.empty()) {
    notices.push_back("split " + split + " into " + detail::grouped(simplices - as_they_are) +
                      (corners == 4 ? " tetrahedra" : " triangles"));
  }
  if (lower > 0)
    notices.push_back("left out " + std::to_string(lower) + " cells of a dimension below " +
                      std::to_string(corners - 1));
  return notices;
}

std::string other_cells(const Array<const std::uint8_t, HostMemory>& types, int dimension) {
  const int simplex = dimension == 3 ? cell_type::tetrahedron : cell_type::triangle;
  return detail::list_of(detail::census_of(types),
                         [=](const CellType& type) { return type.dimension == dimension && type.number != simplex; });
}

int highest_dimension(const Array<const std::uint8_t, HostMemory>& types) {
  std::array<int, 256> dimensions{};
  for (int number = 0; number < 256; ++number) {
    const CellType* const type = find_cell_type(number);
    dimensions[static_cast<std::size_t>(number)] = type == nullptr ? 0 : type->dimension;
  }
  int highest = 0;
  for (std::size_t cell = 0; cell < types.extent(0) && highest < 3; ++cell)
    highest = std::max(highest, dimensions[types(cell)]);
  return highest;
}

int highest_dimension(const std::array<Offset, 256>& cells) {
  int highest = 0;
  for (int number = 0; number < 256; ++number) {
    const CellType* const type = find_cell_type(number);
    if (cells[static_cast<std::size_t>(number)] > 0 && type != nullptr) highest = std::max(highest, type->dimension);
  }
  return highest;
}

}  // namespace gale
