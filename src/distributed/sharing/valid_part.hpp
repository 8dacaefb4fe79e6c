#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <gale/base/error.hpp>
#include <gale/base/parallel.hpp>
#include <gale/distributed/mesh_part.hpp>
#include <gale/distributed/sharing/id_interval.hpp>
#include <gale/mesh/ranks.hpp>

// What is refused of a part by itself, and of all ranks' parts together, before anything of them is sent.

namespace gale::detail {

/// Sums of an id and a count, and of two ids, are ids.
inline constexpr GlobalId greatest_id = (GlobalId(1) << 62) - 1;

/// Throws gale::Error for an id that is none.
inline void require_global_ids(const Array<const GlobalId, HostMemory>& ids) {
  const Offset count = ids.extent(0);
  const Offset bad = reduce_min("GALE::bad_id", HostExecutionSpace(), count, count,
                                [&](Offset i) { return ids(i) < 0 || ids(i) > greatest_id ? i : count; });
  if (bad == count) return;
  const std::string bounds = ids(bad) < 0 ? "0 or more" : "at most " + std::to_string(greatest_id);
  throw Error("ids are " + bounds + ", not " + std::to_string(ids(bad)));
}

/// The interval of a part's vertices if they are one, in order. Throws gale::Error for an id that is none.
inline std::optional<IdInterval> valid_interval(const Array<const GlobalId, HostMemory>& ids) {
  const auto interval = counted_interval(ids);
  const auto is_id = [&](Offset i) { return ids(i) >= 0 && ids(i) <= greatest_id; };
  const Offset count = ids.extent(0);
  if (!interval || (count > 0 && !(is_id(0) && is_id(count - 1)))) require_global_ids(ids);
  return interval;
}

/// Throws gale::Error for what one rank can see is wrong with its part but for vertices.
template <class Index>
void require_part(const MeshPart<Index>& part) {
  require_ids("vertices", static_cast<Offset>(part.vertex_ids.extent(0)));
  require_ids("cells", static_cast<Offset>(part.cells.extent(0)));
  const std::size_t corners = part.cells.extent(1);
  if (part.cells.extent(0) > 0 && corners != 3 && corners != 4)
    throw Error("cells have 3 vertices or 4, not " + std::to_string(corners));
  require_global_ids(part.cell_ids);
}

/// How many vertices the cells of all ranks have. Collective; throws SharedError where they differ, for cells that have
/// ids of their own on some ranks alone, and for no cells.
template <class Index>
int corners_of_all(const Ranks& ranks, const MeshPart<Index>& part) {
  using Kind = std::array<std::int64_t, 2>;  // corners of cells, and whether these have ids; of no cells 0
  const bool has_cells = part.cells.extent(0) > 0;
  const auto kinds = all_numbers(ranks, has_cells ? Kind{static_cast<std::int64_t>(part.cells.extent(1)),
                                                         std::int64_t(part.cell_ids.extent(0) > 0)}
                                                  : Kind{});
  const int none = ranks.size();
  const auto first_with = [&](std::size_t which, std::int64_t one) {
    return std::find_if(kinds.begin(), kinds.end(),
                        [&](const Kind& kind) { return kind[0] > 0 && kind[which] == one; }) -
           kinds.begin();
  };
  const auto triangles = first_with(0, 3), tetrahedra = first_with(0, 4);
  const auto given = first_with(1, 1), counted = first_with(1, 0);
  if (std::min(triangles, tetrahedra) == none) throw SharedError("the mesh has no cells");
  if (std::max(triangles, tetrahedra) < none) {
    throw SharedError("cells are of one dimension on all ranks: rank " + std::to_string(triangles) +
                      " has triangles, rank " + std::to_string(tetrahedra) + " tetrahedra");
  }
  if (std::max(given, counted) < none) {
    throw SharedError("cells have ids on all ranks or on none: rank " + std::to_string(given) +
                      " has ids of cells, rank " + std::to_string(counted) + " has none");
  }
  return triangles < none ? 3 : 4;
}

}  // namespace gale::detail
